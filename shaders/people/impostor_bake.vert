#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/skin.glsl"
#include "shaders/people/impostor.glsl"

layout(push_constant) uniform Push { vec2 atlas_size; };  // texels

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in ivec4 in_normal;  // w: tint
layout(location = 4) in uvec4 in_joints;
layout(location = 5) in vec4 in_weights;
layout(location = 6) in uint in_layer;

layout(location = 0) out vec3 out_normal;  // on the picture's axes
layout(location = 1) out vec3 out_colour;
layout(location = 2) out vec2 out_uv;
layout(location = 3) flat out uint out_layer;
layout(location = 4) flat out uint out_tint;

const float k_reach = 4.0;  // metres about the centre that depth tells apart

void main() {
    uint cell = gl_InstanceIndex, view = cell % k_impostor_views;
    uint pose = cell / k_impostor_views;  // of all people's
    float turn = float(view % k_impostor_sides) * (6.2831853 / float(k_impostor_sides));
    mat3 axes = axes_of(vec2(sin(turn), cos(turn)), k_tilts[view / k_impostor_sides]);
    vec3 normal = vec3(in_normal.xyz) * (1.0 / 127.0);
    Skinned body = skinned(pose * k_palette_joints, in_place, normal, in_joints, in_weights);
    vec3 seen = body.place * axes;
    vec4 box = cells[cell].box, texels = cells[cell].texels;
    vec2 at = (seen.xy - box.xy) / box.zw;
    vec2 texel = texels.xy + vec2(at.x, 1.0 - at.y) * texels.zw;
    out_normal = body.normal * axes;
    out_colour = linear_from_srgb(in_colour.rgb);
    out_uv = in_uv;
    out_layer = in_layer;
    out_tint = uint(in_normal.w);
    gl_Position = vec4(texel / atlas_size * 2.0 - 1.0, 0.5 + seen.z / (2.0 * k_reach), 1);
}
