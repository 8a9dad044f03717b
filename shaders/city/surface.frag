#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/pattern.glsl"
#include "shaders/base/surface.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec3 in_normal;
layout(location = 3) in vec3 in_root;
layout(location = 4) flat in vec3 in_pattern;  // edge, joint, variation
layout(location = 5) flat in uint in_rest;

const vec3 k_asphalt = vec3(0.2439, 0.2510, 0.2617);  // between the stripes of a crossing
const vec3 k_ballast = vec3(0.3759, 0.3533, 0.3309);  // and between sleepers

// What the pattern makes of the root of an albedo.
vec3 patterned(vec3 root) {
    float edge = in_pattern.x, inverse_edge = 1.0 / edge;
    vec2 pixel = pixel_widths(in_uv);

    // Slabs: each a little lighter or darker, with dark joints.
    vec2 slab = in_uv * inverse_edge;
    float shown = saturate(2.0 - 2.0 * max(pixel.x, pixel.y) * inverse_edge);
    float shade = 1.0;
    if (shown > 0.0) {
        vec2 cell = floor(slab), within = abs(slab - cell - 0.5) * edge;
        shade += (hash(cell) - 0.5) * min(in_pattern.z, 1.0) * shown * (in_pattern.z > 1.0 ? 0.1 : 1.0);
        if (in_pattern.y > 0.0) {
            vec2 inverse = 1.0 / pixel;
            vec2 joint = clamp((within - (0.5 * edge - in_pattern.y)) * inverse + 0.5, 0.0, 1.0) *
                         clamp(2.0 * in_pattern.y * inverse, 0.0, 1.0);
            shade *= 1.0 - 0.45 * max(joint.x, joint.y) * shown;
        }
    }
    // Large soft stains, so that wide surfaces are not one colour.
    vec2 s = in_place.xz * 0.05;
    shade *= 1.0 + 0.05 * wave(s.x + 0.33 * wave(0.7 * s.y)) * wave(0.9 * s.y + 0.27 * wave(0.5 * s.x));
    root *= sqrt(shade);

    // Stripes across the way of those who cross.
    if (in_pattern.z > 1.0) {
        float swing = abs(fract(slab.x * 0.5) - 0.5) * 2.0;  // 0..1 and back over two widths
        float paint = saturate((swing - 0.5) * edge / pixel.x + 0.5);
        paint = mix(paint, 0.5, saturate(2.0 * pixel.x * inverse_edge - 1.0));
        root = mix(in_pattern.z > 2.0 ? k_ballast : k_asphalt, root, paint);
    }
    return root;
}

void main() {
    vec3 root = in_root;
    ONLY_IF(frame.way.y == 0.0) root = patterned(root);
    keep(root, in_normal, k_kind_ground, in_rest);
}
