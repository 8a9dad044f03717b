// Pushes that are known beforehand.
#pragma once

#include <cstdint>

#include "sim/base/vec.h"

namespace flaneur {

inline constexpr uint32_t k_everybody = ~0u;
inline constexpr float k_usual_helpers = 0.5f;  // see WorldOptions::helpers

// See push() in sim/sim.h.
struct PlannedPush {
    uint32_t tick = 0;    // it is given when so many are done
    uint32_t walker = 0;  // number of who is there then, or k_everybody
    Vec2 impulse{};       // newton seconds
    bool operator==(const PlannedPush&) const = default;
};

}  // namespace flaneur
