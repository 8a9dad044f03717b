// What tests of chains and trees measure with, one lane wide.
#pragma once

#include <cmath>

#include "sim/base/rng.h"
#include "sim/ik/fabrik_tree-inl.h"

namespace flaneur {

using Vector = HWY_NAMESPACE::V3<float>;
constexpr float k_tolerance = 1e-4f;  // metres

inline float length(Vector v) { return std::sqrt(HWY_NAMESPACE::dot(v, v)); }
inline Vector direction_from(RandomKey key, uint32_t k) {
    return HWY_NAMESPACE::normalize(
        Vector{random_normal(key, k), random_normal(key, k + 1), random_normal(key, k + 2)});
}

}  // namespace flaneur
