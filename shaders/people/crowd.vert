#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/skin.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in ivec4 in_normal;  // w: tint
layout(location = 4) in uvec4 in_joints;
layout(location = 5) in vec4 in_weights;
layout(location = 6) in uint in_layer;

layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_root;  // of the albedo
layout(location = 3) out vec2 out_uv;
layout(location = 4) flat out uint out_layer;  // and, from bit 16 on, where it is hidden

void main() {
    vec3 v = in_place * instances[gl_InstanceIndex].scale, normal = vec3(in_normal.xyz) * (1.0 / 127.0);
    Skinned body = skinned(instances[gl_InstanceIndex].palette, v, normal, in_joints, in_weights);
    out_normal = body.normal;
    vec4 tint = unpackUnorm4x8(instances[gl_InstanceIndex].tints[in_normal.w]);
    out_root = sqrt(linear_from_srgb(in_colour.rgb) * linear_from_srgb(tint.rgb));
    out_uv = in_uv;
    out_layer = in_layer | instances[gl_InstanceIndex].hidden << 16;
    gl_Position = frame.clip_from_world * vec4(body.place, 1);
}
