// Small worlds side by side, each near enough to another one to leap there: two balls and a moon, a capsule,
// a torus and a boulder.
#pragma once

#include "assets/stages/rocks.h"

namespace flaneur {

inline constexpr float k_planet_pull = 6;  // m/s2, on the ground of each

SmallWorld make_planets(uint64_t seed, int walkers);

}  // namespace flaneur
