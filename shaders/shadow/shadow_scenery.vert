#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"
#include "shaders/shadow/shadow.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 2) in vec2 in_uv;
layout(location = 4) in uvec2 in_material;  // k_material_scenery, layer

layout(location = 0) out vec2 out_uv;
layout(location = 1) flat out uint out_layer;

void main() {
    out_uv = in_uv;
    out_layer = in_material.y;
    gl_Position = on_map(in_place);
}
