#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 2) in vec2 in_uv;
layout(location = 4) in uvec2 in_material;  // k_material_scenery, layer
layout(location = 6) in vec4 in_id;

layout(location = 0) out vec4 out_id;
layout(location = 1) out vec2 out_uv;
layout(location = 2) flat out uint out_layer;

void main() {
    out_id = in_id;
    out_uv = in_uv;
    out_layer = in_material.y;
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
