#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"

layout(set = 0, binding = k_binding_scenery) uniform sampler2DArray pictures;

layout(location = 0) in vec2 in_uv;
layout(location = 1) flat in uint in_layer;

void main() {
    if (texture(pictures, vec3(in_uv, float(in_layer))).a < 0.5) discard;
}
