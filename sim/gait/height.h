// How high the body rides: on the ground that its feet find, and no higher than its legs will reach.
#pragma once

#include "sim/gait/steps.h"

namespace flaneur {

// A tick of GaitBlock::base, rise and sink.
void advance_height(GaitBlock& gait, const Stepper& stepper, float speed);

}  // namespace flaneur
