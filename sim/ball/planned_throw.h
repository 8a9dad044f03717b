// Throws that are known beforehand.
#pragma once

#include <cstdint>

#include "sim/base/vec.h"

namespace flaneur {

// A medicine ball: heavy enough to make somebody step, or fall.
inline constexpr float k_ball_mass = 4;                                // kg
inline constexpr float k_lightest_ball = 0.05f, k_heaviest_ball = 20;  // kg
inline constexpr float k_slowest_throw = 1, k_fastest_throw = 40;      // m/s

// See throw_ball() in sim/sim.h.
struct PlannedThrow {
    uint32_t tick = 0;  // it leaves the hand when so many are done
    Vec3 from{}, at{};  // metres; it passes `at` if nothing stops it before
    float speed = 9;    // m/s, as it leaves
    float mass = k_ball_mass;
    bool operator==(const PlannedThrow&) const = default;
};

}  // namespace flaneur
