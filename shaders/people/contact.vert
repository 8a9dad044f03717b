#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec4 in_spot;  // place on the ground, metres; radius
layout(location = 1) in float in_strength;

layout(location = 0) out vec2 out_place;  // -1..1
layout(location = 1) flat out float out_strength;

const vec2 k_corners[6] = {vec2(-1, -1), vec2(-1, 1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(1, -1)};
const float k_lift = 0.02;  // above the ground, metres

void main() {
    out_place = k_corners[gl_VertexIndex];
    out_strength = in_strength;
    vec3 place = in_spot.xyz + vec3(out_place.x, 0, out_place.y) * in_spot.w;
    gl_Position = frame.clip_from_world * vec4(place + vec3(0, k_lift, 0), 1);
}
