#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/impostor_quad.glsl"

layout(push_constant) uniform Push { mat4 map_from_world; };

layout(location = 0) out vec2 out_texel;

void main() {
    Quad quad = quad_of(impostors[gl_VertexIndex / 6], frame.sun_direction.xyz, gl_VertexIndex % 6);
    out_texel = quad.texel;
    vec4 at = map_from_world * vec4(quad.place, 1);
    gl_Position = vec4(at.xy * 2.0 - 1.0, at.z, 1);
}
