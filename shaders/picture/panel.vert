#version 460

layout(location = 0) in vec2 in_place;  // pixels
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec4 in_colour;

layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_colour;

layout(push_constant) uniform Push { vec2 scale; };  // 2 over the picture's width and height

void main() {
    out_uv = in_uv;
    out_colour = in_colour;
    gl_Position = vec4(in_place * scale - 1.0, 0, 1);
}
