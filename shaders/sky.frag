#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common.glsl"

layout(location = 0) out vec4 out_picture;

// Perez' distribution with Preetham's numbers (see renderer/sky.h), and the sun's disc, softened.
void main() {
    vec2 place = gl_FragCoord.xy * frame.screen.zw * 2.0 - 1.0;
    vec3 ray = normalize(frame.ray_forward.xyz + place.x * frame.ray_right.xyz + place.y * frame.ray_down.xyz);
    float cos_gamma = clamp(dot(ray, frame.sun_direction.xyz), -1.0, 1.0);
    float gamma = acos(cos_gamma);
    float cos_zenith = max(ray.y, 0.01);
    vec3 yxy = frame.sky_scale.xyz * (1.0 + frame.perez[0].xyz * exp(frame.perez[1].xyz / cos_zenith)) *
               (1.0 + frame.perez[2].xyz * exp(frame.perez[3].xyz * gamma) + frame.perez[4].xyz * cos_gamma * cos_gamma);
    float x = yxy.x * yxy.y / yxy.z, z = yxy.x * (1.0 - yxy.y - yxy.z) / yxy.z;
    vec3 light = max(vec3(3.2406 * x - 1.5372 * yxy.x - 0.4986 * z, -0.9689 * x + 1.8758 * yxy.x + 0.0415 * z,
                          0.0557 * x - 0.2040 * yxy.x + 1.0570 * z), 0.0) * frame.sky_white.xyz;
    float disc = saturate((cos_gamma - 0.99985) * 12000.0);
    light += frame.sun_light.xyz * (6.0 * disc);
    out_picture = picture(light);
}
