// A tree of bones as encoder and decoder go through it. Private to assets/recording.
#pragma once

#include <algorithm>
#include <cmath>

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

// The mean of a curve of which the first wave is so many steps, and back.
inline float mean_of(int steps, int step, int samples) {
    return static_cast<float>(steps) * step_of(step) / std::sqrt(static_cast<float>(samples));
}
inline int steps_to(float mean, int step, int samples) {
    const float steps = mean * std::sqrt(static_cast<float>(samples)) / step_of(step);
    return static_cast<int>(std::lround(clamp(steps, -1e6f, 1e6f)));
}

inline constexpr uint32_t k_no_key = ~0u;

// Appends somebody whose steps and means follow those of all before, and these of some of them.
inline void add_one(MotionMeans& to, const RecordedMover& mover, size_t joints) {
    const size_t begin = to.ones.empty() ? 0 : to.ones.back().begin + to.ones.back().joints + 1;
    to.ones.push_back({mover.id, static_cast<uint32_t>(joints), begin});
}
inline void add_means(MotionMeans& to, const MotionMeans& from) {
    to.steps.insert(to.steps.end(), from.steps.begin(), from.steps.end());
    to.means.insert(to.means.end(), from.means.begin(), from.means.end());
}
inline void sort_ones(MotionMeans& means) {
    std::stable_sort(means.ones.begin(), means.ones.end(),
                     [](const MotionMeans::One& a, const MotionMeans::One& b) { return a.id < b.id; });
}

// What the key has of somebody; null: nothing.
inline const MotionMeans::One* find_mean(const MotionMeans* key, const RecordedMover& mover, size_t joints) {
    if (!key) return nullptr;
    const auto at = std::lower_bound(key->ones.begin(), key->ones.end(), mover.id,
                                     [](const MotionMeans::One& one, uint64_t id) { return one.id < id; });
    return at != key->ones.end() && at->id == mover.id && at->joints == joints ? &*at : nullptr;
}

// A rotation by the vector of its axis and angle, and back.
inline Quat turn_of(Vec3 v) {
    const float squared = length_squared(v);
    if (squared < 1) {  // by the first terms of both series, within 2e-8
        const float s = 0.5f - squared * (1.0f / 48 - squared * (1.0f / 3840 - squared / 645120));
        const float w =
            1 - squared * (1.0f / 8 - squared * (1.0f / 384 - squared * (1.0f / 46080 - squared / 10321920)));
        return {v.x * s, v.y * s, v.z * s, w};
    }
    const float angle = std::sqrt(squared);
    if (!(angle < 100)) return {};  // of bytes that are broken
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
