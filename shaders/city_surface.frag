#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common.glsl"
#include "shaders/light.glsl"
#include "shaders/pattern.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec3 in_normal;
layout(location = 3) in vec3 in_colour;
layout(location = 4) flat in vec4 in_pattern;  // edge, joint, variation, mirror

layout(location = 0) out vec4 out_picture;

const vec3 k_asphalt = vec3(0.058, 0.061, 0.065);  // between the stripes of a crossing

void main() {
    vec3 normal = normalize(in_normal);
    float edge = in_pattern.x;
    vec2 pixel = fwidth(in_uv);
    float wide = max(pixel.x, pixel.y);

    // Slabs: each a little lighter or darker, with dark joints.
    vec2 slab = in_uv / edge;
    vec2 cell = floor(slab), within = abs(slab - cell - 0.5) * edge;
    float shown = saturate(2.0 - 2.0 * wide / edge);
    float shade = 1.0 + (hash(cell) - 0.5) * min(in_pattern.z, 1.0) * shown * (in_pattern.z > 1.0 ? 0.1 : 1.0);
    pixel = max(pixel, vec2(1e-4));
    vec2 joint = clamp((within - (0.5 * edge - in_pattern.y)) / pixel + 0.5, 0.0, 1.0) *
                 clamp(2.0 * in_pattern.y / pixel, 0.0, 1.0);
    shade *= 1.0 - 0.45 * max(joint.x, joint.y) * float(in_pattern.y > 0.0) * shown;

    // Large soft stains, so that wide surfaces are not one colour.
    vec2 s = in_place.xz * 0.31;
    shade *= 1.0 + 0.05 * (sin(s.x + 2.1 * sin(0.7 * s.y)) * sin(s.y * 0.9 + 1.7 * sin(0.5 * s.x)));

    vec3 albedo = in_colour * shade;
    // Stripes across the way of those who cross.
    float wave = abs(fract(slab.x * 0.5) - 0.5) * 2.0;  // 0..1 and back over two widths
    float paint = saturate((wave - 0.5) * edge / pixel.x + 0.5);
    paint = mix(paint, 0.5, saturate(2.0 * pixel.x / edge - 1.0));
    albedo = in_pattern.z > 1.0 ? mix(k_asphalt, albedo, paint) : albedo;

    float facing = dot(normal, frame.sun_direction.xyz);
    float bias = 0.25 + 2.0 * saturate(1.0 - normal.y) * (1.0 - 0.4 * saturate(facing));
    float sun = saturate(facing) * sunlit(in_place, normal, bias);
    vec3 light = albedo * (frame.sun_light.xyz * sun + ambient(normal));

    vec3 ray = normalize(in_place - frame.eye.xyz);
    vec3 mirrored = sky_towards(reflect(ray, normal));
    float fresnel = in_pattern.w * (0.1 + 0.9 * pow(1.0 - saturate(-dot(ray, normal)), 4.0));
    light = mix(light, mirrored, fresnel);
    out_picture = picture(through_air(light, in_place));
}
