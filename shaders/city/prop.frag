#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/surface.glsl"

layout(location = 1) in vec3 in_normal;
layout(location = 2) flat in vec4 in_colour;
layout(location = 3) flat in float in_glow;

// Trees and street furniture: many small triangles, of which a CPU shades whole blocks of pixels; so little is done
// for each.
void main() { keep(Surface(in_colour.rgb, normalize(in_normal), k_kind_thing, 1.0, 1.0, in_colour.w, in_glow)); }
