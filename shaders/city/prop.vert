#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 2) in vec2 in_timing;  // of a lens
layout(location = 3) in vec4 in_normal;
layout(location = 4) in uvec2 in_material;

layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out vec3 out_root;  // as surface.glsl has them
layout(location = 3) flat out uint out_rest;

const uint k_metal_mirror = 20u << 16;  // 0.08
const uint k_lamp_glow = 221u << 24;    // 6
const uint k_signal_glow = 180u << 24;  // 4
const uint k_lens_glow = 255u << 24;    // 8
const float k_dark_lens = 0.045;        // of its lit colour

// See k_material_lens.
bool is_lens_lit() {
    vec2 low = mod(in_timing, k_lens_unit), high = floor(in_timing / k_lens_unit);
    float cycle = high.x, now = mod(frame.zenith.w + low.x, cycle);
    return mod(now - low.y + cycle, cycle) < mod(high.y - low.y + cycle, cycle);
}

void main() {
    bool is_lamp = in_material.x == k_material_light;
    out_normal = in_normal.xyz;
    vec3 colour = linear_from_srgb(in_colour.rgb);
    bool is_lens = in_material.x == k_material_lens, is_lit = is_lens && is_lens_lit();
    if (is_lens && !is_lit) colour *= k_dark_lens;
    out_root = is_lamp ? vec3(1) : sqrt(colour);
    uint rest = is_lamp                              ? k_lamp_glow
                : is_lit                             ? k_lens_glow
                : in_material.x == k_material_signal ? k_signal_glow
                : in_material.x == k_material_metal  ? k_metal_mirror
                                                     : 0u;
    out_rest = 0xffffu | rest;
    gl_Position = frame.clip_from_world * vec4(in_place, 1);
}
