#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in vec4 in_normal;
layout(location = 4) in uvec2 in_material;  // material, extra

layout(location = 0) out vec3 out_place;
layout(location = 1) out vec2 out_uv;
layout(location = 2) out vec3 out_normal;
layout(location = 3) out vec3 out_root;          // of the albedo
layout(location = 4) flat out vec3 out_pattern;  // see below
layout(location = 5) flat out uint out_rest;     // as surface.glsl has it

// How a surface's slabs lie: edge in metres, width of the joints, how their lightness varies, and how much of the
// sky it mirrors. The stripes of a crossing are slabs whose odd ones are dark (a variation above 1); sleepers are such
// with ballast between them (above 2).
const vec4 k_patterns[13] = {
    vec4(0.035, 0.0, 0.16, 0.0),   // road: grains
    vec4(0.8, 0.012, 0.05, 0.0),   // sidewalk
    vec4(0.5, 0.0, 2.0, 0.0),      // crossing
    vec4(1.2, 0.014, 0.06, 0.0),   // plaza
    vec4(0.06, 0.0, 0.14, 0.0),    // path
    vec4(1.6, 0.010, 0.04, 0.0),   // steps
    vec4(0.09, 0.0, 0.26, 0.0),    // grass
    vec4(0.4, 0.0, 0.04, 0.6),     // water
    vec4(0.11, 0.0, 0.3, 0.0),     // ballast
    vec4(0.3, 0.0, 3.0, 0.0),      // sleepers
    vec4(1.0, 0.0, 0.0, 0.0),      // facade
    vec4(0.9, 0.012, 0.05, 0.0),   // stone
    vec4(0.6, 0.012, 0.05, 0.0)    // roof
};

void main() {
    out_place = in_place;
    out_uv = in_uv;
    out_normal = in_normal.xyz;
    out_root = sqrt(linear_from_srgb(in_colour.rgb));
    vec4 pattern = k_patterns[min(in_material.x, k_material_roof)];
    out_pattern = pattern.xyz;
    out_rest = 0xffffu | uint(pattern.w * 255.0 + 0.5) << 16;
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
