#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec4 in_spot;  // place on the ground, metres; radius
layout(location = 1) in vec4 in_lie;   // normal of the ground; strength

layout(location = 0) out vec2 out_place;  // -1..1
layout(location = 1) flat out float out_strength;

const vec2 k_corners[6] = {vec2(-1, -1), vec2(-1, 1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(1, -1)};
const float k_lift = 0.004;     // above the ground, metres: what of shoes is lower is darkened too
const float k_nearer = 0.0001;  // share of the distance, so that far ground does not come through

void main() {
    out_place = k_corners[gl_VertexIndex];
    out_strength = in_lie.w;
    vec3 up = in_lie.xyz;
    vec3 aside = normalize(cross(up, abs(up.z) < 0.7 ? vec3(0, 0, 1) : vec3(1, 0, 0)));
    vec3 ahead = cross(aside, up);
    vec3 place = in_spot.xyz + (aside * out_place.x + ahead * out_place.y) * in_spot.w + up * k_lift;
    vec4 at = frame.clip_from_world * vec4(place, 1);
    at.z *= 1.0 + k_nearer;
    gl_Position = at;
}
