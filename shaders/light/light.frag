#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

// Lights every pixel once, of what the first pass has kept of it.
layout(set = 0, binding = k_binding_colour) uniform sampler2D colours;
layout(set = 0, binding = k_binding_surface) uniform usampler2D surfaces;
layout(set = 0, binding = k_binding_depth) uniform sampler2D depths;
layout(set = 0, binding = k_binding_shadow) uniform sampler2DArray shadow_map;
layout(set = 0, binding = k_binding_lamps) uniform sampler2D lamp_map;
layout(std430, set = 0, binding = k_binding_sky) readonly buffer Sky { vec4 sky_corners[]; };

layout(location = 0) out vec4 out_picture;

struct Row {
    float a, b, c, d;
};
struct Block {
    Row a, b, c, d;
};
struct Lamp {
    vec3 light;
    float ground;
};

// Of a number that is kept in so many steps, whole.
float whole(float x, float steps) { return floor(x * steps + 0.5); }

float shadow_texel(ivec3 at) { return whole(texelFetch(shadow_map, at, 0).x, 65535.0); }

Row row_at(ivec3 at) {
    return Row(shadow_texel(at), shadow_texel(at + ivec3(1, 0, 0)), shadow_texel(at + ivec3(2, 0, 0)),
               shadow_texel(at + ivec3(3, 0, 0)));
}

Block shadow_texels(float layer, float x, float y) {
    ivec3 at = ivec3(x, y, layer);
    return Block(row_at(at), row_at(at + ivec3(0, 1, 0)), row_at(at + ivec3(0, 2, 0)), row_at(at + ivec3(0, 3, 0)));
}

Lamp lamp_texel(float x, float y) {
    ivec2 at = ivec2(x, y), size = textureSize(lamp_map, 0);
    bool is_there = at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y;
    vec4 texel = is_there ? texelFetch(lamp_map, at, 0) : vec4(0);
    return Lamp(texel.xyz, texel.w);
}

vec3 sky_corner(float column, float row) { return sky_corners[int(row) * (k_sky_columns + 1) + int(column)].xyz; }

#include "shaders/light/dialect.glsl"
#include "shaders/light/light.h"

float byte_of(uint word, int shift) { return float(word >> shift & 255u); }

Kept kept_at(ivec2 at) {
    vec4 colour = floor(texelFetch(colours, at, 0) * 255.0 + 0.5);
    uvec2 surface = texelFetch(surfaces, at, 0).xy;
    return Kept(colour.r, colour.g, colour.b, colour.a, float(surface.x & 4095u), float(surface.x >> 12 & 4095u),
                byte_of(surface.x, 24), byte_of(surface.y, 0), byte_of(surface.y, 8), byte_of(surface.y, 16),
                byte_of(surface.y, 24), texelFetch(depths, at, 0).x);
}

vec3 colour_at(Kept kept, ivec2 at) {
    vec2 place = (vec2(at) + 0.5) * frame.samples.zw;
    return colour_seen(kept, place.x, place.y);
}

vec3 pixel_of_four(ivec2 pixel) {
    ivec2 at = 2 * pixel;
    Kept a = kept_at(at), b = kept_at(at + ivec2(1, 0)), c = kept_at(at + ivec2(0, 1)), d = kept_at(at + 1);
    if (!is_one_surface(a, b, c, d))
        return mean(colour_at(a, at), colour_at(b, at + ivec2(1, 0)), colour_at(c, at + ivec2(0, 1)),
                    colour_at(d, at + 1));
    vec2 place = (vec2(pixel) + 0.5) * frame.screen.zw;
    return colour_seen(mean(a, b, c, d), place.x, place.y);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 colour = frame.samples.x > 1.0 ? pixel_of_four(pixel) : colour_at(kept_at(pixel), pixel);
    vec3 bytes = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    float luma = floor((bytes.r * 299.0 + bytes.g * 587.0 + bytes.b * 114.0) * 0.001 + 0.5);
    out_picture = vec4(bytes, luma) * (1.0 / 255.0);
}
