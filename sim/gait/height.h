// How high the body rides: on the ground that its feet find, and no higher than its legs will reach.
#pragma once

#include "sim/gait/steps.h"

namespace flaneur {

// What the heights of sixteen walkers need of their steppers. Those who do not move keep theirs.
struct alignas(64) StepperRows {
    float moves[k_block];  // 1 or 0, as are those below
    float x[k_block], z[k_block];
    float velocity_x[k_block], velocity_z[k_block], wish_x[k_block], wish_z[k_block];
    float facing_x[k_block], facing_z[k_block];
    float swings[2][k_block], stands[k_block];
};
// After the feet of one walker have moved in this tick.
void set_rows(StepperRows& rows, const GaitBlock& gait, const Stepper& stepper);

// A tick of GaitBlock::base, rise and sink, of a block.
void advance_heights(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt);

}  // namespace flaneur
