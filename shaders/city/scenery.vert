#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in vec4 in_normal;
layout(location = 4) in uvec2 in_material;  // k_material_scenery, layer

layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_colour;
layout(location = 3) out vec2 out_uv;
layout(location = 4) flat out uint out_layer;

void main() {
    out_normal = in_normal.xyz;
    out_colour = linear_from_srgb(in_colour.rgb);
    out_uv = in_uv;
    out_layer = in_material.y;
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
