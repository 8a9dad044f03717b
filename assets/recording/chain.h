// A tree of bones as encoder and decoder go through it. Private to assets/recording.
#pragma once

#include "assets/recording/motion.h"
#include "assets/recording/waves.h"

namespace flaneur {

inline constexpr int k_group = 256;                // tracks that are coded together, apart from others
inline constexpr float k_origin_step = 1.0f / 32;  // metres
inline constexpr float k_yaw_step = 2 * k_pi / 256;

// Steps of waves, a quarter of an octave apart: from 0.5 (metres or radians) down to 9e-6.
inline float step_of(int index) {
    constexpr float k_quarters[4] = {0.5f, 0.420448208f, 0.353553391f, 0.297301779f};
    return k_quarters[index % 4] / static_cast<float>(1 << index / 4);
}

// A rotation by the vector of its axis and angle, and back.
inline Quat turn_of(Vec3 v) {
    const float angle = length(v);
    if (angle < 1e-4f) return normalize({v.x / 2, v.y / 2, v.z / 2, 1});
    const SinCos half = sin_cos(angle / 2);
    const float s = half.sine / angle;
    return {v.x * s, v.y * s, v.z * s, half.cosine};
}
inline Vec3 vector_of(Quat q) {
    const Vec3 u{q.x, q.y, q.z};
    const float s = length(u);
    if (s < 1e-6f) return u * (q.w < 0 ? -2.0f : 2.0f);
    return u * (2 * arctan2(q.w < 0 ? -s : s, q.w < 0 ? -q.w : q.w) / s);
}

}  // namespace flaneur
