#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

// Of a SkinnedVertex.
layout(location = 0) in uvec4 in_place;  // metres, as floats; w: the normal, ten bits to a number
layout(location = 1) in uvec4 in_look;   // u, v as floats; colour and tint, sRGB
layout(location = 2) in uint in_layer;   // and, from bit 16 on, where it is hidden

layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_root;  // of the albedo
layout(location = 3) out vec2 out_uv;
layout(location = 4) flat out uint out_layer;

void main() {
    vec3 place = uintBitsToFloat(in_place.xyz);
    out_normal = vec3(ivec3(in_place.www << uvec3(22, 12, 2)) >> 22) * (1.0 / 511.0);
    vec3 colour = unpackUnorm4x8(in_look.z).rgb, tint = unpackUnorm4x8(in_look.w).rgb;
    out_root = sqrt(linear_from_srgb(colour) * linear_from_srgb(tint));
    out_uv = uintBitsToFloat(in_look.xy);
    out_layer = in_layer;
    gl_Position = frame.clip_from_world * vec4(place, 1);
}
