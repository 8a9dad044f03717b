#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) out vec3 out_ray;
layout(location = 1) out vec3 out_light;

const vec2 k_corners[6] = {vec2(0, 0), vec2(0, 1), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(1, 0)};

// A grid of cells over the whole picture, at infinity: the sky changes so slowly that its light at their corners
// will do. Perez' distribution with Preetham's numbers (see renderer/light/sky.h).
void main() {
    int cell = gl_VertexIndex / 6;
    vec2 at = vec2(cell % k_sky_columns, cell / k_sky_columns) + k_corners[gl_VertexIndex % 6];
    vec2 place = at / vec2(k_sky_columns, k_sky_rows) * 2.0 - 1.0;
    out_ray = frame.ray_forward.xyz + place.x * frame.ray_right.xyz + place.y * frame.ray_down.xyz;
    vec3 ray = normalize(out_ray);
    float cos_gamma = clamp(dot(ray, frame.sky_sun.xyz), -1.0, 1.0);
    float gamma = acos(cos_gamma);
    float cos_zenith = max(ray.y, 0.01);
    vec3 yxy = frame.sky_scale.xyz * (1.0 + frame.perez[0].xyz * exp(frame.perez[1].xyz / cos_zenith)) *
               (1.0 + frame.perez[2].xyz * exp(frame.perez[3].xyz * gamma) + frame.perez[4].xyz * cos_gamma * cos_gamma);
    float x = yxy.x * yxy.y / yxy.z, z = yxy.x * (1.0 - yxy.y - yxy.z) / yxy.z;
    out_light = max(vec3(3.2406 * x - 1.5372 * yxy.x - 0.4986 * z, -0.9689 * x + 1.8758 * yxy.x + 0.0415 * z,
                         0.0557 * x - 0.2040 * yxy.x + 1.0570 * z), 0.0) * frame.sky_white.xyz;
    float height = saturate(ray.y), towards = dot(ray.xz, frame.sky_sun.xz) * 0.5 + 0.5;
    out_light += mix(frame.sky_low.xyz, frame.sky_high.xyz, height) +
                 frame.sky_dusk.xyz * (towards * towards * exp(-7.0 * height));
    gl_Position = vec4(place, 0, 1);
}
