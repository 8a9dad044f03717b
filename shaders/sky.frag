#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common.glsl"

layout(location = 0) in vec3 in_ray;
layout(location = 1) in vec3 in_light;

layout(location = 0) out vec4 out_picture;

// The sky, and the sun's disc, softened.
void main() {
    float cos_gamma = dot(in_ray, frame.sun_direction.xyz) * inversesqrt(dot(in_ray, in_ray));
    float disc = saturate((cos_gamma - 0.99985) * 12000.0);
    out_picture = picture(in_light + frame.sun_light.xyz * (6.0 * disc));
}
