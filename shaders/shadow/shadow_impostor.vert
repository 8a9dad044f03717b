#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/impostor_quad.glsl"
#include "shaders/shadow/shadow.glsl"

layout(location = 0) out vec2 out_texel;

void main() {
    Quad quad = quad_of(impostors[gl_VertexIndex / 6], frame.sun_direction.xyz, gl_VertexIndex % 6);
    out_texel = quad.texel;
    gl_Position = on_map(quad.place);
}
