// Sixteen walkers side by side: what moves them, and the parts of the gait that advance them together.
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

// A tick of GaitBlock::amplitude, running, pace, step, duty, forward, drive, bank and course, of a block: how
// much of a walk it is and of a run, which way, and what bodies lean into. Feet in the air keep their shares
// of the swing.
void advance_paces(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt);

// In how many steps springs go `dt` seconds, so that none of them swings up however long a tick is.
inline int spring_steps(float dt) {
    constexpr float k_longest = 0.04f;  // seconds
    return dt > k_longest ? static_cast<int>(dt / k_longest) + 1 : 1;
}

// A tick of GaitBlock::base, rise and sink, of a block: bodies ride on the ground that their feet find, and
// no higher than their legs will reach.
void advance_heights(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt);

// A tick of the paces, feet and heights of a block seen from far away: see advance_gait_afar. `height` is
// where the ground is, by lane. Also says in the rows where bodies face and which feet swing.
void advance_afar(GaitBlock& gait, const PersonBlock& people, StepperRows& steppers, const float* height,
                  float dt);

void find_misfits(const GaitBlock& gait, const PersonBlock& people, StepperRows& steppers);
// Of one foot anew, where it was set down since.
Misfit misfit(const GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, Side side,
              int lane);

}  // namespace flaneur
