#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/base/common.glsl"
#include "shaders/picture/depths.glsl"

// Darkens by the mean occlusion of a square of four by four half-size pixels about as far away as this one.
layout(set = 0, binding = k_binding_occlusion) uniform sampler2D occlusion;

layout(location = 0) out vec4 out_colour;

const float k_most = 0.7;  // that occlusion takes

void main() {
    ivec2 sample_at = ivec2(gl_FragCoord.xy), last = textureSize(occlusion, 0) - 1;
    int samples = int(frame.samples.x);
    ivec2 first = (sample_at / samples - 3) >> 1;
    float ahead = ahead_at(sample_at), sum = 0.0, weights = 0.0;
    [[dont_unroll]] for (int i = 0; i < 16; ++i) {
        ivec2 at = clamp(first + ivec2(i & 3, i >> 2), ivec2(0), last);
        float weight = saturate(1.0 - abs(ahead_at(at * 2 * samples) / ahead - 1.0) * 25.0) + 1e-5;
        sum += texelFetch(occlusion, at, 0).x * weight;
        weights += weight;
    }
    out_colour = vec4(0, 0, 0, k_most * (1.0 - min(sum / weights, 1.0)));
}
