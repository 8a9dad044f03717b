#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/base/common.glsl"
#include "shaders/picture/depths.glsl"

// Darkens a sample by what is evened out of the four half-size pixels about it that are about as far away.
layout(set = 0, binding = k_binding_even_occlusion) uniform sampler2D occlusion;

layout(location = 0) out vec4 out_colour;

const float k_most = 0.7;  // that occlusion takes

void main() {
    ivec2 sample_at = ivec2(gl_FragCoord.xy), last = textureSize(occlusion, 0) - 1;
    int samples = 2 * int(frame.samples.x);
    vec2 place = (vec2(sample_at) + 0.5) / float(samples) - 0.5, base = floor(place), f = place - base;
    float ahead = ahead_at(sample_at), sum = 0.0, weights = 0.0;
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 by = ivec2(i & 1, i >> 1), at = clamp(ivec2(base) + by, ivec2(0), last);
        vec2 near = mix(1.0 - f, f, vec2(by));
        float weight = (saturate(1.0 - abs(ahead_at(at * samples) / ahead - 1.0) * 25.0) + 1e-4) * (near.x * near.y + 1e-3);
        sum += texelFetch(occlusion, at, 0).x * weight;
        weights += weight;
    }
    out_colour = vec4(0, 0, 0, k_most * (1.0 - min(sum / weights, 1.0)));
}
