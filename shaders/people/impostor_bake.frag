#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/people/impostor.glsl"

layout(set = 0, binding = k_binding_textures) uniform sampler2DArray textures;

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec3 in_colour;
layout(location = 2) in vec2 in_uv;
layout(location = 3) flat in uint in_layer;
layout(location = 4) flat in uint in_tint;

layout(location = 0) out uint out_texel;

void main() {
    vec3 base = in_colour * texture(textures, vec3(in_uv, float(in_layer))).rgb;
    out_texel = packed(clamp(base, 0.0, 1.0), normalize(in_normal), in_tint);
}
