#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/base/common.glsl"

// After Lottes' FXAA 3.11 (NVIDIA 2009), quality path, by whole texels alone.
layout(set = 0, binding = k_binding_picture) uniform sampler2D picture_before;

layout(constant_id = k_constant_smooth) const int k_smooth = 1;

layout(location = 0) out vec4 out_colour;

const int k_reach = 8;  // how far along an edge its ends are looked for, pixels

ivec2 last;
vec4 at(ivec2 p) { return texelFetch(picture_before, clamp(p, ivec2(0), last), 0); }
float luma_within(ivec2 p) { return texelFetch(picture_before, p, 0).a; }

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    last = ivec2(frame.screen.xy) - 1;
    // Pixels of the picture's border stay as they are, so that no neighbour need be looked for outside. Two of the
    // four are in the pixel's own quad, and known by their difference.
    bool is_within = all(greaterThan(p, ivec2(0))) && all(lessThan(p, last));
    ivec2 q = is_within ? p : ivec2(1), odd = p & 1, away = 2 * odd - 1;
    vec4 middle = texelFetch(picture_before, p, 0);
    float m = middle.a, to_x = dFdxFine(m), to_y = dFdyFine(m);
    float beside = luma_within(q + ivec2(away.x, 0)), beyond = luma_within(q + ivec2(0, away.y));
    float w = odd.x == 1 ? m - to_x : beside, e = odd.x == 1 ? beside : m + to_x;
    float n = odd.y == 1 ? m - to_y : beyond, s = odd.y == 1 ? beyond : m + to_y;
    float high = max(m, max(max(n, s), max(w, e))), low = min(m, min(min(n, s), min(w, e)));
    float contrast = high - low;
    vec3 colour = middle.rgb;
    ONLY_IF(k_smooth == 1 && is_within && contrast > max(0.04, high * 0.125)) {
        bool is_level = abs(n + s - 2.0 * m) > abs(w + e - 2.0 * m);  // the edge runs left to right
        float before = is_level ? n : w, after = is_level ? s : e;
        bool is_before = abs(before - m) >= abs(after - m);
        ivec2 across = (is_level ? ivec2(0, 1) : ivec2(1, 0)) * (is_before ? -1 : 1);
        ivec2 along = is_level ? ivec2(1, 0) : ivec2(0, 1);
        float other = is_before ? before : after;
        float edge_luma = 0.5 * (m + other), step_luma = 0.25 * abs(other - m);

        // Both ends of the edge: where the mean across it leaves the edge's.
        ivec2 ends = ivec2(k_reach);
        vec2 deltas = vec2(0);
        [[dont_unroll]] for (int side = 0; side < 2; ++side) {
            ivec2 r = p, stride = side == 0 ? -along : along;
            int i = 0;
            float delta = 0.0;
            [[dont_unroll]] while (i < k_reach && abs(delta) < step_luma) {
                ++i;
                r += stride;
                delta = 0.5 * (at(r).a + at(r + across).a) - edge_luma;
            }
            if (side == 0) ends.x = i, deltas.x = delta; else ends.y = i, deltas.y = delta;
        }
        float nearest = float(min(ends.x, ends.y)), span = float(ends.x + ends.y);
        float delta = ends.x < ends.y ? deltas.x : deltas.y;
        bool is_inside = (m < edge_luma) != (delta < 0.0);  // this pixel lies beyond the edge's end
        float shift = is_inside ? 0.5 - nearest / span : 0.0;

        // Specks: as much as the pixel differs from its neighbourhood.
        float speck = saturate(abs((n + s + w + e) * 0.25 - m) / max(contrast, 1e-4));
        speck = speck * speck * (3.0 - 2.0 * speck);
        shift = max(shift, speck * speck * 0.5);
        colour = mix(colour, at(p + across).rgb, shift);
    }
    out_colour = vec4(colour, 1);
}
