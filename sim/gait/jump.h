// Leaps of one who walks, from one foot to the other, and hops of one who stands, from both feet to both.
#pragma once

#include "sim/gait/steps.h"

namespace flaneur {

// Asks for a jump if none is under way: a leap begins with the next foot that leaves, a hop at once.
void begin_jump(GaitBlock& gait, int lane);

// The foot `side` is about to leave and shall lead a leap.
void commit_leap(GaitBlock& gait, const Stepper& s, Side side);

// A tick of the jump under way, if any. True while the jump, not the walk, moves the feet.
bool advance_jump(GaitBlock& gait, const Stepper& s);

}  // namespace flaneur
