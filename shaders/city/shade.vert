#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 2) in vec2 in_uv;  // k_material_shade

layout(location = 0) out float out_share;
layout(location = 1) out float out_strength;

const float k_nearer = 0.0008;  // share of the distance, so that the ground does not come through

void main() {
    out_share = in_uv.x;
    float distance = length(in_place - frame.eye.xyz);
    out_strength = in_uv.y / (1.0 + max(distance - frame.haze_away.w, 0.0) * frame.haze_towards.w);
    vec4 at = frame.clip_from_world * vec4(in_place, 1);
    at.z *= 1.0 + k_nearer;
    gl_Position = at;
}
