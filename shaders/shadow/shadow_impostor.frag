#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/people/impostor.glsl"

layout(set = 0, binding = k_binding_atlas) uniform usampler2D atlas;

layout(location = 0) in vec2 in_texel;

void main() {
    if (texelFetch(atlas, ivec2(in_texel), 0).x == k_empty_texel) discard;
}
