#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared.h"
#include "shaders/people/skin.glsl"

layout(push_constant) uniform Push { mat4 map_from_world; };
layout(location = 0) in vec3 in_place;
layout(location = 4) in uvec4 in_joints;

void main() {
    vec3 v = in_place * instances[gl_InstanceIndex].scale;
    vec4 at = map_from_world * vec4(moved_by(instances[gl_InstanceIndex].palette + in_joints.x, v), 1);
    gl_Position = vec4(at.xy * 2.0 - 1.0, at.z, 1);
}
