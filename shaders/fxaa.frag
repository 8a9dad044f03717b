#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common.glsl"

// After Lottes' FXAA 3.11 (NVIDIA 2009), quality path, by whole texels alone.
layout(set = 0, binding = k_binding_picture) uniform sampler2D picture_before;

layout(location = 0) out vec4 out_colour;

const int k_reach = 8;  // how far along an edge its ends are looked for, pixels

ivec2 last;
vec4 at(ivec2 p) { return texelFetch(picture_before, clamp(p, ivec2(0), last), 0); }
float luma(ivec2 p) { return at(p).a; }

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    last = ivec2(frame.screen.xy) - 1;
    vec4 middle = at(p);
    float m = middle.a;
    float n = luma(p + ivec2(0, -1)), s = luma(p + ivec2(0, 1));
    float w = luma(p + ivec2(-1, 0)), e = luma(p + ivec2(1, 0));
    float high = max(m, max(max(n, s), max(w, e))), low = min(m, min(min(n, s), min(w, e)));
    float contrast = high - low;
    bool is_edge = contrast > max(0.04, high * 0.125);

    bool is_level = abs(n + s - 2.0 * m) > abs(w + e - 2.0 * m);  // the edge runs left to right
    float before = is_level ? n : w, after = is_level ? s : e;
    bool is_before = abs(before - m) >= abs(after - m);
    ivec2 across = (is_level ? ivec2(0, 1) : ivec2(1, 0)) * (is_before ? -1 : 1);
    ivec2 along = is_level ? ivec2(1, 0) : ivec2(0, 1);
    float other = is_before ? before : after;
    float edge_luma = 0.5 * (m + other), step_luma = 0.25 * abs(other - m);

    // Both ends of the edge: where the mean across it leaves the edge's.
    float ends[2] = {float(k_reach), float(k_reach)};
    float deltas[2] = {0.0, 0.0};
    for (int side = 0; side < 2; ++side) {
        ivec2 q = p, stride = side == 0 ? -along : along;
        bool found = !is_edge;
        for (int i = 1; i <= k_reach && !found; ++i) {
            q += stride;
            deltas[side] = 0.5 * (luma(q) + luma(q + across)) - edge_luma;
            found = abs(deltas[side]) >= step_luma;
            ends[side] = float(i);
        }
    }
    float nearest = min(ends[0], ends[1]), span = ends[0] + ends[1];
    float delta = ends[0] < ends[1] ? deltas[0] : deltas[1];
    bool is_inside = (m < edge_luma) != (delta < 0.0);  // this pixel lies beyond the edge's end
    float shift = is_inside ? 0.5 - nearest / span : 0.0;

    // Specks: as much as the pixel differs from its neighbourhood.
    float speck = saturate(abs((n + s + w + e) * 0.25 - m) / max(contrast, 1e-4));
    speck = speck * speck * (3.0 - 2.0 * speck);
    shift = is_edge ? max(shift, speck * speck * 0.5) : 0.0;
    out_colour = vec4(mix(middle.rgb, at(p + across).rgb, shift), 1);
}
