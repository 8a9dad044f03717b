// How high the body rides: on the ground that its feet find, and no higher than its legs will reach.
#pragma once

#include "sim/gait/rows.h"

namespace flaneur {

// A tick of GaitBlock::base, rise and sink, of a block.
void advance_heights(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt);

}  // namespace flaneur
