#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/views/paint.glsl"
#include "shaders/people/skin.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 3) in ivec4 in_normal;  // w: tint
layout(location = 4) in uvec4 in_joints;
layout(location = 5) in vec4 in_weights;

layout(location = 0) out vec4 out_colour;
layout(location = 1) flat out uint out_hidden;

void main() {
    vec3 v = in_place * instances[gl_InstanceIndex].scale, normal = vec3(in_normal.xyz) * (1.0 / 127.0);
    Skinned body = skinned(instances[gl_InstanceIndex].palette, v, normal, in_joints, in_weights);
    vec4 tint = unpackUnorm4x8(instances[gl_InstanceIndex].tints[in_normal.w]);
    out_colour = painted(body.normal, paint == k_paint_ids ? tint.rgb : in_colour.rgb * tint.rgb, body.place - frame.eye.xyz);
    out_hidden = instances[gl_InstanceIndex].hidden;
    gl_Position = nearer(frame.clip_from_world * vec4(body.place, 1));
}
