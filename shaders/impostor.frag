#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common.glsl"
#include "shaders/light.glsl"
#include "shaders/person.glsl"
#include "shaders/impostor.glsl"

layout(set = 0, binding = k_binding_atlas) uniform usampler2D atlas;

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec2 in_texel;
layout(location = 2) flat in uint in_number;
layout(location = 3) flat in vec4 in_view;

layout(location = 0) out vec4 out_picture;

const float k_girth = 0.3;  // metres towards the sun that lead out of the body, which is not to shade itself

void main() {
    uint texel = texelFetch(atlas, ivec2(in_texel), 0).x;
    if (texel == k_empty_texel) discard;
    vec3 tint = linear_from_srgb(unpackUnorm4x8(impostors[in_number].tints[tint_of(texel)]).rgb);
    vec3 normal = axes_of(in_view.xy, in_view.zw) * normal_of(texel);
    vec3 outside = in_place + frame.sun_direction.xyz * k_girth;
    out_picture = lit_person(in_place, outside, normal, base_of(texel) * tint);
}
