#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"

layout(set = 0, binding = k_binding_letters) uniform sampler2D letters;

layout(location = 0) in vec2 in_uv;
layout(location = 1) in vec4 in_colour;

layout(location = 0) out vec4 out_picture;

void main() { out_picture = in_colour * textureLod(letters, in_uv, 0); }
