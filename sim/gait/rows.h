// What moves sixteen walkers, side by side, for the parts of the gait that advance them together.
#pragma once

#include <cstddef>

#include "sim/gait/steps.h"

namespace flaneur {

struct alignas(64) StepperRows {
    float moves[k_block];  // 1; 0: nobody, and nothing of that lane changes
    float x[k_block], z[k_block];
    float velocity_x[k_block], velocity_z[k_block], wish_x[k_block], wish_z[k_block];
    float heading[k_block], turn_rate[k_block];
    float swings[2][k_block], stands[k_block];  // 1 or 0
    // What find_misfits finds: the direction of the heading; of each foot, see Misfit.
    float facing_x[k_block], facing_z[k_block];
    float distance[2][k_block], twist[2][k_block], behind[2][k_block], unasked[2][k_block];
};

// Of `walker`, whose lane of the block it is.
void set_rows(StepperRows& rows, const GaitBlock& gait, const RootMotion& root, size_t walker);
// After a walker's feet have moved.
void set_feet(StepperRows& rows, const GaitBlock& gait, int lane);

void find_misfits(const GaitBlock& gait, const PersonBlock& people, StepperRows& steppers);
// Of one foot anew, where it was set down since.
Misfit misfit(const GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, Side side,
              int lane);

}  // namespace flaneur
