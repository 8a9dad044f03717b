#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/base/common.glsl"
#include "shaders/picture/depths.glsl"

// McGuire, Osman, Bukowski and Hennessy, "The Alchemy Screen-Space Ambient Obscurance Algorithm" (2011), at half
// the picture's width and height.
layout(location = 0) out float out_open;

const int k_taps = 16;
const float k_radius = 1.2;    // metres
const float k_most = 90.0;     // pixels that it is on the picture
const float k_bias = 0.0012;   // of the distance
const float k_strength = 2.6;

vec3 place_at(ivec2 pixel, float ahead) {
    vec2 at = (vec2(pixel) + 0.5) * frame.screen.zw * 2.0 - 1.0;
    return (frame.ray_forward.xyz + at.x * frame.ray_right.xyz + at.y * frame.ray_down.xyz) * ahead;
}
vec3 place_at(ivec2 pixel) { return place_at(pixel, ahead_at(pixel * int(frame.samples.x))); }

// The way to a neighbour, the one of two that lies less deep or high.
vec3 step_along(ivec2 pixel, vec3 place, ivec2 by) {
    vec3 after = place_at(pixel + by) - place, before = place - place_at(pixel - by);
    return dot(after, after) < dot(before, before) ? after : before;
}

void main() {
    ivec2 pixel = min(ivec2(gl_FragCoord.xy) * 2, ivec2(frame.screen.xy) - 1);
    float ahead = ahead_at(pixel * int(frame.samples.x));
    vec3 place = place_at(pixel, ahead);
    vec3 normal = normalize(cross(step_along(pixel, place, ivec2(0, 1)), step_along(pixel, place, ivec2(1, 0))));
    float reach = min(k_radius / (ahead * frame.ray_forward.w), k_most);
    // Turned and drawn out by a sixteenth from pixel to pixel in a square of four, which the blur evens out.
    ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
    float drawn = float((cell.x * 4 + cell.y) * 7 & 15) * 0.0625;
    float turn = drawn * 6.2831853;
    float sum = 0.0;
    [[dont_unroll]] for (int i = 0; i < k_taps; ++i) {
        float share = (float(i) + 0.3 + drawn) / float(k_taps), angle = turn + float(i) * 2.39996;
        vec2 by = vec2(cos(angle), sin(angle)) * (share * reach);
        vec3 way = place_at(pixel + ivec2(round(by))) - place;
        float squared = dot(way, way);
        float within = max(1.0 - squared / (k_radius * k_radius), 0.0);
        sum += max(dot(way, normal) - k_bias * ahead, 0.0) / (squared + 0.1) * within;
    }
    float open = max(1.0 - k_strength * k_radius * sum / float(k_taps), 0.0);
    out_open = mix(1.0, open, saturate((reach - 2.0) * 0.25) * float(ahead < 1000.0));
}
