#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(set = 0, binding = k_binding_scenery) uniform sampler2DArray pictures;

layout(location = 0) in vec4 in_id;
layout(location = 1) in vec2 in_uv;
layout(location = 2) flat in uint in_layer;

layout(location = 0) out vec4 out_picture;

void main() {
    if (texture(pictures, vec3(in_uv, float(in_layer))).a < 0.5) discard;
    out_picture = vec4(in_id.rgb, 1);
}
