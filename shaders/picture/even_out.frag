#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/base/common.glsl"
#include "shaders/picture/depths.glsl"

// The mean occlusion of a square of four by four half-size pixels about as far away as the one in its middle.
layout(set = 0, binding = k_binding_occlusion) uniform sampler2D occlusion;

layout(location = 0) out float out_open;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(occlusion, 0) - 1;
    int samples = 2 * int(frame.samples.x);
    float ahead = ahead_at(pixel * samples), sum = 0.0, weights = 0.0;
    [[dont_unroll]] for (int i = 0; i < 16; ++i) {
        ivec2 at = clamp(pixel - 1 + ivec2(i & 3, i >> 2), ivec2(0), last);
        float weight = saturate(1.0 - abs(ahead_at(at * samples) / ahead - 1.0) * 25.0) + 1e-5;
        sum += texelFetch(occlusion, at, 0).x * weight;
        weights += weight;
    }
    out_open = sum / weights;
}
