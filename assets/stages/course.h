// A course of ground that is hard to walk on, round a lawn: stairs, a hanging bridge, a plate that tilts, two
// that rise and sink, rubble, stepping stones and a ferry. Or all of it in one line, for who wants to see it
// from the side.
//
// Behind the round one, at x from -12 to 12 and z from -18 to -6, the terrace is free and level.
#pragma once

#include <cstdint>

#include "assets/city.h"
#include "sim/stepping.h"

namespace flaneur {

inline constexpr int k_flat_lanes = 8;  // that there are side by side in the one line

// What is seen of it, and what of it is still.
City build_course(uint64_t seed, bool is_flat);
// What its walkers go on. In one line each of so many has a lane of its own, there and back.
StepCourse make_course(bool is_flat);

}  // namespace flaneur
