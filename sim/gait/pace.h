// What follows the speed: how much of a walk it is and of a run, and which way; and what bodies lean into.
#pragma once

#include "sim/gait/rows.h"

namespace flaneur {

// A tick of GaitBlock::amplitude, running, pace, step, duty, forward, drive, bank and course, of a block.
// Feet in the air keep their shares of the swing.
void advance_paces(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt);

}  // namespace flaneur
