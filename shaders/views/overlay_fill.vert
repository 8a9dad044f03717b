#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;

layout(location = 0) out vec4 out_colour;

const float k_pull = 0.02, k_far_pull = 0.004;  // nearer to the eye: metres, and a share of the distance

void main() {
    out_colour = in_colour;
    vec4 at = frame.clip_from_world * vec4(in_place, 1);
    if (at.w > 0.0) at.z = min(at.z * at.w / max(at.w * (1.0 - k_far_pull) - k_pull, 0.5 * at.w), at.w);
    gl_Position = at;
}
