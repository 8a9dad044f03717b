#version 460

layout(location = 0) in vec4 in_colour;

layout(location = 0) out vec4 out_picture;

void main() { out_picture = in_colour; }
