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

void advance_heights(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt) {
    HWY_DYNAMIC_DISPATCH(advance_heights_here)(gait, people, steppers, dt);
}

}  // namespace flaneur
#endif
