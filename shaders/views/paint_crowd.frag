#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/people/turns.glsl"

layout(location = 0) in vec4 in_colour;
layout(location = 1) flat in uint in_hidden;

layout(location = 0) out vec4 out_picture;

void main() {
    if (is_left_out(in_hidden)) discard;
    out_picture = in_colour;
}
