#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/impostor_quad.glsl"

layout(location = 0) out vec2 out_texel;
layout(location = 1) flat out uint out_number;
layout(location = 2) flat out vec4 out_view;  // side and tilt that the picture was taken from

const float k_nearer = 0.25;  // metres that depth is nearer: half a body, so that no foot is lost in the ground

void main() {
    ImpostorInstance walker = impostors[gl_VertexIndex / 6];
    Quad quad = quad_of(walker, frame.eye.xyz - walker.place.xyz, gl_VertexIndex % 6);
    out_texel = quad.texel;
    out_number = gl_VertexIndex / 6;
    out_view = vec4(quad.side, quad.tilt);
    vec4 at = frame.clip_from_world * vec4(quad.place, 1);
    at.z *= at.w / max(at.w - k_nearer * walker.place.w, k_nearer);
    gl_Position = at;
}
