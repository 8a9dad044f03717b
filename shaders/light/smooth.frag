#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

// Smooths the edges of the lit picture, and lays over it what was drawn for that.
layout(set = 0, binding = k_binding_picture) uniform sampler2D picture;
layout(set = 0, binding = k_binding_overlay) uniform sampler2D overlay;

layout(constant_id = k_constant_smooth) const int k_smooth = 1;

layout(location = 0) out vec4 out_colour;

float luma_near(int x, int y) {
    return floor(texelFetch(picture, ivec2(gl_FragCoord.xy) + ivec2(x, y), 0).a * 255.0 + 0.5);
}

#include "shaders/light/dialect.glsl"
#include "shaders/light/smooth.h"

vec3 bytes_at(ivec2 at) { return floor(texelFetch(picture, at, 0).rgb * 255.0 + 0.5); }

// The mean of a pixel's samples.
vec4 overlay_at(ivec2 pixel) {
    if (frame.samples.x == 1.0) return texelFetch(overlay, pixel, 0);
    ivec2 at = 2 * pixel;
    return (texelFetch(overlay, at, 0) + texelFetch(overlay, at + ivec2(1, 0), 0) +
            texelFetch(overlay, at + ivec2(0, 1), 0) + texelFetch(overlay, at + 1, 0)) * 0.25;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 bytes = bytes_at(pixel);
    if (k_smooth == 1 && frame.backdrop.w == 0.0) {
        Smoothing taken = smoothing_at(float(pixel.x), float(pixel.y));
        int to = int(taken.to);
        vec3 other = bytes_at(pixel + (taken.is_level ? ivec2(0, to) : ivec2(to, 0)));
        if (taken.share > 0.0) bytes = floor(bytes + (other - bytes) * taken.share + 0.5);
    }
    if (frame.way.w > 0.0) {
        vec4 over = overlay_at(pixel);
        bytes = floor(bytes * (1.0 - over.a) + over.rgb * 255.0 + 0.5);
    }
    out_colour = vec4(bytes * (1.0 / 255.0), 1);
}
