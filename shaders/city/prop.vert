#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 3) in vec4 in_normal;
layout(location = 4) in uvec2 in_material;

layout(location = 0) out vec3 out_place;
layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out vec4 out_colour;  // w: how much of the sky it mirrors; above 1: a lamp's head

const float k_metal_mirror = 0.08;

void main() {
    out_place = in_place;
    out_normal = in_normal.xyz;
    float mirror = in_material.x == k_material_light ? 2.0 : in_material.x == k_material_metal ? k_metal_mirror : 0.0;
    out_colour = vec4(linear_from_srgb(in_colour.rgb), mirror);
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
