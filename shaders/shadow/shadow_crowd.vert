#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"
#include "shaders/people/skin.glsl"
#include "shaders/shadow/shadow.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 4) in uvec4 in_joints;

void main() {
    vec3 v = in_place * instances[gl_InstanceIndex].scale;
    gl_Position = on_map(moved_by(instances[gl_InstanceIndex].palette + in_joints.x, v));
}
