#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"
#include "shaders/shadow/shadow.glsl"

layout(location = 0) in vec3 in_place;

void main() {
    gl_Position = on_map(in_place);
}
