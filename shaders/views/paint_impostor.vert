#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/impostor_quad.glsl"
#include "shaders/views/paint.glsl"

layout(location = 0) out vec2 out_texel;
layout(location = 1) flat out vec4 out_view;
layout(location = 2) flat out vec4 out_colour;
layout(location = 3) flat out uint out_shows_normals;
layout(location = 4) flat out uint out_hidden;

void main() {
    ImpostorInstance walker = impostors[gl_VertexIndex / 6];
    vec3 ray = walker.place.xyz - frame.eye.xyz;
    Quad quad = quad_of(walker, -ray, gl_VertexIndex % 6);
    out_texel = quad.texel;
    out_view = vec4(quad.side, quad.tilt);
    vec3 top = unpackUnorm4x8(walker.tints[3]).rgb;  // stands for all it wears
    out_colour = painted(vec3(0, 0, 1), top, ray);
    out_hidden = walker.hidden;
    out_shows_normals = uint(paint == k_paint_normals);
    gl_Position = frame.clip_from_world * vec4(quad.place, 1);
}
