#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in vec4 in_normal;     // w: storeys
layout(location = 4) in uvec2 in_material;  // k_material_facade, extra
layout(location = 5) in uint in_house;

layout(location = 1) out vec2 out_uv;
layout(location = 2) out vec3 out_normal;
layout(location = 3) flat out vec3 out_colour;
layout(location = 4) flat out vec3 out_wall;  // see facade.frag
layout(location = 5) flat out uvec3 out_kind;

void main() {
    uint extra = in_material.y;
    out_uv = in_uv;
    out_normal = in_normal.xyz;
    out_colour = linear_from_srgb(in_colour.rgb);
    out_wall = vec3(float(extra & k_storey_mask) * k_storey_unit, float(extra >> k_shop_shift & 1u), in_normal.w * 127.0);
    out_kind = uvec3(extra >> k_door_shift & k_door_mask, extra >> k_windows_shift, in_house);
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
