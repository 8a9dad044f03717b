// What a body does while it stands: it breathes, sways, and shifts its weight.
#pragma once

#include "sim/base/rng.h"
#include "sim/gait/steps.h"

namespace flaneur {

inline constexpr float k_breath_round = 100;  // breaths after which all begins again

// A tick of GaitBlock::breath, inhaled and tilt.
void advance_rest(GaitBlock& gait, const Stepper& stepper);

// The share of the body that the left leg of one who stands carries for half a minute, as `chance` has it.
float resting_load(const GaitBlock& gait, int lane, RandomKey chance);

// How one who stands, or is about to, takes a place: a foot ahead, the leg that rests turned out, everybody's
// own; anew at each stand, and of the foot that has come to rest at each shift. Who goes, or turns on the
// spot, gathers the feet. `chance` as in resting_load.
void advance_stance(GaitBlock& gait, const Stepper& stepper, RandomKey chance);

}  // namespace flaneur
