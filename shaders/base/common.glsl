// What every shader may want: what is known of the frame, and decoding.
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"

layout(std140, set = 0, binding = k_binding_frame) uniform Frame { FrameConstants frame; };

// The sRGB curve within 0.3 %, without a power.
vec3 linear_from_srgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

// Lanes of a CPU that draws run both sides of every branch, but leave a loop that none of them enters.
#define ONLY_IF(condition) for (bool is_left = !(condition); !is_left; is_left = true)

float saturate(float x) { return clamp(x, 0.0, 1.0); }
