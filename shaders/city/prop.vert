#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 3) in vec4 in_normal;
layout(location = 4) in uvec2 in_material;

layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out vec4 out_colour;  // w: how much of the sky it mirrors
layout(location = 3) flat out float out_glow;

const float k_metal_mirror = 0.08, k_lamp_glow = 6.0;

void main() {
    bool is_lamp = in_material.x == k_material_light;
    out_normal = in_normal.xyz;
    out_colour = is_lamp ? vec4(1, 1, 1, 0)
                         : vec4(linear_from_srgb(in_colour.rgb), in_material.x == k_material_metal ? k_metal_mirror : 0.0);
    out_glow = is_lamp ? k_lamp_glow : 0.0;
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
