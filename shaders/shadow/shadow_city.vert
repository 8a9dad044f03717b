#version 460

layout(push_constant) uniform Push { mat4 map_from_world; };
layout(location = 0) in vec3 in_place;

void main() {
    vec4 at = map_from_world * vec4(in_place, 1);
    gl_Position = vec4(at.xy * 2.0 - 1.0, at.z, 1);
}
