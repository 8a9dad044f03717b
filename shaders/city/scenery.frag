#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/surface.glsl"

layout(set = 0, binding = k_binding_scenery) uniform sampler2DArray pictures;

layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec2 in_uv;
layout(location = 4) flat in uint in_layer;

void main() {
    vec4 texel = texture(pictures, vec3(in_uv, float(in_layer)));
    if (texel.a < 0.5) discard;
    keep(sqrt(in_colour * texel.rgb), in_normal, k_kind_thing, k_plain);
}
