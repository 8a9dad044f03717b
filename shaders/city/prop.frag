#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/surface.glsl"

layout(location = 1) in vec3 in_normal;
layout(location = 2) flat in vec3 in_root;
layout(location = 3) flat in uint in_rest;

// Trees and street furniture: many small triangles, of which a CPU shades whole blocks of pixels; so little is done
// for each.
void main() { keep(in_root, in_normal, k_kind_thing, in_rest); }
