// What every shader may want: bindings, decoding, light, haze and the tone curve.
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"

layout(std140, set = 0, binding = k_binding_frame) uniform Frame { FrameConstants frame; };

layout(constant_id = k_constant_light) const int k_light = k_light_day;

// The sRGB curve within 0.3 %, without a power.
vec3 linear_from_srgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

// Lanes of a CPU that draws run both sides of every branch, but leave a loop that none of them enters.
#define ONLY_IF(condition) for (bool is_left = !(condition); !is_left; is_left = true)

float saturate(float x) { return clamp(x, 0.0, 1.0); }

// Hejl and Burgess-Dawson's filmic curve (2010), its black point left at black; gives display-ready sRGB.
vec3 tone_curve(vec3 light) {
    vec3 x = mix(vec3(dot(light, vec3(0.2126, 0.7152, 0.0722))), light, 0.84);
    return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
}

// As the picture before anti-aliasing is kept: luma in alpha.
vec4 picture(vec3 light) {
    vec3 colour = tone_curve(light);
    return vec4(colour, dot(colour, vec3(0.299, 0.587, 0.114)));
}
