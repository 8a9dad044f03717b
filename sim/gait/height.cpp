#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/gait/height.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/gait/height-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

void advance_heights_here(GaitBlock& g, const PersonBlock& p, const StepperRows& s, float dt) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) advance_heights<Lanes>(g, p, s, dt, lane);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(advance_heights_here);

void set_rows(StepperRows& rows, const GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    rows.moves[lane] = 1;
    rows.x[lane] = s.root.x;
    rows.z[lane] = s.root.z;
    rows.velocity_x[lane] = s.velocity.x;
    rows.velocity_z[lane] = s.velocity.z;
    rows.wish_x[lane] = s.wish.x;
    rows.wish_z[lane] = s.wish.z;
    rows.facing_x[lane] = s.facing.x;
    rows.facing_z[lane] = s.facing.z;
    for (Side side : {k_left, k_right}) rows.swings[side][lane] = g.feet[side].swinging[lane] ? 1.0f : 0.0f;
    rows.stands[lane] = g.standing[lane] ? 1.0f : 0.0f;
}

void advance_heights(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt) {
    HWY_DYNAMIC_DISPATCH(advance_heights_here)(gait, people, steppers, dt);
}

}  // namespace flaneur
#endif
