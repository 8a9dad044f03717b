// Impostors: how a texel of the atlas is packed, and where a picture was taken from.
#include "shaders/shared.h"
layout(std430, set = 0, binding = k_binding_cells) readonly buffer Cells { ImpostorCell cells[]; };
layout(std430, set = 0, binding = k_binding_impostors) readonly buffer Impostors { ImpostorInstance impostors[]; };

const uint k_empty_texel = 0xffffffff;  // shows nothing

// Axes of a picture seen from the side with this sine and cosine: right, up, towards the viewer.
mat3 axes_of(vec2 side, vec2 tilt) {
    return mat3(vec3(side.y, 0, -side.x), vec3(-tilt.x * side.x, tilt.y, -tilt.x * side.y),
                vec3(tilt.y * side.x, tilt.x, tilt.y * side.y));
}

// `base`: linear, as a square of 5, 6 and 5 bits. `normal`: on the picture's axes, a unit vector, 6 and 6 bits.
uint packed(vec3 base, vec3 normal, uint tint) {
    uvec3 colour = uvec3(sqrt(base) * vec3(31, 63, 31) + 0.5);
    vec2 n = normal.z < 0.0 ? normalize(normal.xy) : normal.xy;
    uvec2 slope = uvec2(n * 31.0 + 31.5);
    return colour.r | colour.g << 5 | colour.b << 11 | slope.x << 16 | slope.y << 22 | tint << 28;
}

uint tint_of(uint texel) { return texel >> 28; }

vec3 root_of(uint texel) { return vec3(texel & 31, texel >> 5 & 63, texel >> 11 & 31) * (1.0 / vec3(31, 63, 31)); }

vec3 normal_of(uint texel) {
    vec2 n = vec2(texel >> 16 & 63, texel >> 22 & 63) * (1.0 / 31.0) - 1.0;
    return vec3(n, sqrt(max(1.0 - dot(n, n), 0.0)));
}
