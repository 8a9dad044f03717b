// What a walker does with its feet: stands, starts, walks, runs, stops, jumps.
#pragma once

#include "sim/base/rng.h"
#include "sim/gait/rows.h"

namespace flaneur {

inline constexpr float k_rest = 0.16f;          // phase of a foot that stands
inline constexpr float k_slowest = 0.62f;       // cycles/s while a foot is in the air
inline constexpr float k_short_stride = 0.62f;  // of one ahead, of who goes aside or back

// One tick of one walker. Chance is drawn under `chance`, which changes every two seconds.
void advance_walker(GaitBlock& gait, const StepperRows& rows, const Stepper& stepper, RandomKey chance);
// The part of it that only follows the feet, for those whose feet go by another rule: the phase of pelvis and
// arms, the load, what one does who stands, and the look.
void advance_bearing(GaitBlock& gait, const Stepper& stepper, RandomKey chance);

}  // namespace flaneur
