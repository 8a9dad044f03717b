#version 460

layout(location = 0) in vec2 in_place;
layout(location = 1) flat in float in_strength;

layout(location = 0) out vec4 out_colour;

void main() {
    float near = max(1.0 - dot(in_place, in_place), 0.0);
    out_colour = vec4(0, 0, 0, in_strength * near * near);
}
