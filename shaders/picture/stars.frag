#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/pattern.glsl"

// At night, where nothing else is: a star, and noise, as shaders/light/light.h takes them.
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_surface;

// One in some cells of a grid over the sky, a pixel wide.
float stars(vec3 ray) {
    vec2 at = ray.xz / (1.0 + max(ray.y, 0.0)) * 150.0, cell = floor(at);
    float drawn = hash(cell), size = frame.ray_forward.w * 150.0;
    vec2 place = 0.2 + 0.6 * vec2(hash(cell + 57.0), hash(cell - 91.0));
    float near = saturate(1.2 - length(at - cell - place) / size);
    float bright = saturate((drawn - 0.9) * 10.0);
    return near * bright * bright * saturate(ray.y * 5.0);
}

void main() {
    vec2 place = gl_FragCoord.xy * frame.samples.zw * 2.0 - 1.0;
    vec3 ray = frame.ray_forward.xyz + place.x * frame.ray_right.xyz + place.y * frame.ray_down.xyz;
    out_colour = vec4(stars(normalize(ray)), hash(gl_FragCoord.xy), 0, 1);
    out_surface = uvec2(0);
}
