#version 460

layout(location = 0) in float in_share;
layout(location = 1) in float in_strength;

layout(location = 0) out vec4 out_colour;

void main() {
    float near = 1.0 - in_share;
    out_colour = vec4(0, 0, 0, in_strength * near * near * (3.0 - 2.0 * near));
}
