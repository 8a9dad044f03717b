#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/surface.glsl"
#include "shaders/people/turns.glsl"

layout(constant_id = k_constant_textured) const int k_textured = 0;
layout(set = 0, binding = k_binding_textures) uniform sampler2DArray textures;

layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_root;
layout(location = 3) in vec2 in_uv;
layout(location = 4) flat in uint in_layer;  // and, from bit 16 on, where it is hidden

void main() {
    vec3 root = in_root;
    bool is_seen = !is_left_out(in_layer >> 16);
    if (k_textured == 1) {
        vec4 texel = texture(textures, vec3(in_uv, float(in_layer & 0xffffu)));
        is_seen = is_seen && texel.a >= 0.5;
        root *= sqrt(texel.rgb);
    }
    if (!is_seen) discard;  // when all have been sampled, whose neighbours tell how finely
    keep(root, in_normal, k_kind_person, k_plain);
}
