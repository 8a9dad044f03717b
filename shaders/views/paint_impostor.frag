#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/turns.glsl"

layout(set = 0, binding = k_binding_atlas) uniform usampler2D atlas;

layout(location = 0) in vec2 in_texel;
layout(location = 1) flat in vec4 in_view;
layout(location = 2) flat in vec4 in_colour;
layout(location = 3) flat in uint in_shows_normals;
layout(location = 4) flat in uint in_hidden;

layout(location = 0) out vec4 out_picture;

void main() {
    uint texel = texelFetch(atlas, ivec2(in_texel), 0).x;
    if (texel == k_empty_texel || is_left_out(in_hidden)) discard;
    vec3 seen = axes_of(in_view.xy, in_view.zw) * normal_of(texel) * 0.5 + 0.5;
    out_picture = in_shows_normals == 1 ? vec4(seen, 1) : in_colour;
}
