#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/light.glsl"
#include "shaders/people/impostor.glsl"
#include "shaders/people/impostor_quad.glsl"

layout(location = 0) centroid out vec2 out_texel;
layout(location = 1) out float out_lit;  // how much of the sun reaches head and feet
layout(location = 2) flat out uint out_number;
layout(location = 3) flat out vec4 out_view;  // side and tilt that the picture was taken from
layout(location = 4) flat out vec4 out_air;   // what the air adds, and how much light it lets through
layout(location = 5) flat out vec3 out_lamps;

const float k_nearer = 0.25;  // metres that depth is nearer: half a body, so that no foot is lost in the ground
const float k_girth = 0.3;    // metres towards the sun that lead out of the body, which is not to shade itself

void main() {
    ImpostorInstance walker = impostors[gl_VertexIndex / 6];
    Quad quad = quad_of(walker, frame.eye.xyz - walker.place.xyz, gl_VertexIndex % 6);
    vec3 ray = walker.place.xyz - frame.eye.xyz;
    float distance = length(ray);
    ray /= distance;
    out_texel = quad.texel;
    out_lit = sunlit_once(quad.middle + frame.sun_direction.xyz * k_girth, vec3(0), 0.0);
    out_number = gl_VertexIndex / 6;
    out_view = vec4(quad.side, quad.tilt);
    vec3 dark = through_air(vec3(0), ray, distance);
    out_air = vec4(dark, through_air(vec3(1), ray, distance).x - dark.x);
    out_lamps = k_light == k_light_night ? lamps_at(walker.place.xyz, vec3(0)) : vec3(0);
    vec4 at = frame.clip_from_world * vec4(quad.place, 1);
    at.z *= at.w / max(at.w - k_nearer * walker.place.w, k_nearer);
    gl_Position = at;
}
