#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/pattern.glsl"

layout(location = 0) in vec3 in_ray;
layout(location = 1) in vec3 in_light;

layout(location = 0) out vec4 out_picture;

// One in some cells of a grid over the sky, a pixel wide.
float stars(vec3 ray) {
    vec2 at = ray.xz / (1.0 + max(ray.y, 0.0)) * 150.0, cell = floor(at);
    float drawn = hash(cell), size = frame.ray_forward.w * 150.0;
    vec2 place = 0.2 + 0.6 * vec2(hash(cell + 57.0), hash(cell - 91.0));
    float near = saturate(1.2 - length(at - cell - place) / size);
    float bright = saturate((drawn - 0.9) * 10.0);
    return near * bright * bright * saturate(ray.y * 5.0);
}

// The sky, and the sun's disc, softened.
void main() {
    float cos_gamma = dot(in_ray, frame.sun_direction.xyz) * inversesqrt(dot(in_ray, in_ray));
    float disc = saturate((cos_gamma - 0.99985) * 12000.0);
    vec3 light = in_light + frame.sun_light.xyz * (frame.sun_light.w * disc);
    if (k_light == k_light_night) light += 0.5 * frame.sky_dusk.w * stars(normalize(in_ray));
    out_picture = picture(light);
    // Half a step of noise, or dark skies show bands.
    if (k_light == k_light_night) out_picture.rgb += (hash(gl_FragCoord.xy) - 0.5) * (1.0 / 255.0);
}
