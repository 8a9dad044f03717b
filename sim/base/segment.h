// Straight lines that end.
#pragma once

#include <algorithm>

#include "sim/base/vec.h"

namespace flaneur {

// The share of the way from `a` to `b`, 0..1, at its place nearest to `p`; 0 where it has no length.
inline float closest_on(Vec2 a, Vec2 b, Vec2 p) {
    const Vec2 way = b - a;
    return clamp(dot(p - a, way) / std::max(length_squared(way), 1e-9f), 0, 1);
}

}  // namespace flaneur
