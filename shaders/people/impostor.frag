#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/surface.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/turns.glsl"

layout(set = 0, binding = k_binding_atlas) uniform usampler2D atlas;

layout(location = 0) in vec2 in_texel;
layout(location = 1) flat in uint in_number;
layout(location = 2) flat in vec4 in_view;

void main() {
    uint texel = texelFetch(atlas, ivec2(in_texel), 0).x;
    if (texel == k_empty_texel || is_left_out(impostors[in_number].hidden)) discard;
    vec3 tint = linear_from_srgb(unpackUnorm4x8(impostors[in_number].tints[tint_of(texel)]).rgb);
    vec3 normal = axes_of(in_view.xy, in_view.zw) * normal_of(texel);
    keep(root_of(texel) * sqrt(tint), normal, k_kind_impostor, k_plain);
}
