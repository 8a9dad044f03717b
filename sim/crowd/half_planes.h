// The velocity nearest to a wish that keeps to half-planes: the linear programs of van den Berg, Guy, Lin and
// Manocha (2011), written for half-planes in normal form. Private to sim/crowd.
#pragma once

#include "sim/base/vec.h"

namespace flaneur {

// The velocities v with dot(v, normal) >= offset; `normal` is a unit vector.
struct HalfPlane {
    Vec2 normal;
    float offset = 0;
};

inline constexpr int k_most_planes = 64;

// The velocity of length <= most_speed nearest to `wish` inside all planes, k_most_planes at most. The first
// `firm` planes are kept whatever happens (if they can be); where the others cannot all be kept, the largest
// trespass on them is made smallest.
Vec2 best_velocity(const HalfPlane* planes, int count, int firm, float most_speed, Vec2 wish);

}  // namespace flaneur
