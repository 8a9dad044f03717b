#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/gait/rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/gait/afar-inl.h"
#include "sim/gait/height-inl.h"
#include "sim/gait/pace-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

void advance_paces_here(GaitBlock& g, const PersonBlock& p, const StepperRows& s, float dt) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) advance_paces<Lanes>(g, p, s, dt, lane);
}

void find_misfits_here(const GaitBlock& g, const PersonBlock& p, StepperRows& s) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) find_misfits<Lanes>(g, p, s, lane);
}

void advance_heights_here(GaitBlock& g, const PersonBlock& p, const StepperRows& s, float dt) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) advance_heights<Lanes>(g, p, s, dt, lane);
}

void advance_afar_here(GaitBlock& g, const PersonBlock& p, StepperRows& s, const float* height, float dt) {
    for (size_t lane = 0; lane < k_block; lane += lane_count())
        advance_afar<Lanes>(g, p, s, height, dt, lane);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

namespace kernel = HWY_NAMESPACE;

HWY_EXPORT(advance_paces_here);
HWY_EXPORT(find_misfits_here);
HWY_EXPORT(advance_heights_here);
HWY_EXPORT(advance_afar_here);

float duty_factor(float v) { return kernel::duty_factor(v); }
float run_frequency(float v, float leg) { return kernel::run_frequency(v, leg); }
float run_duty(float v, float leg) { return kernel::run_duty(v, leg); }

void set_rows(StepperRows& rows, const GaitBlock& g, const RootMotion& root, size_t walker) {
    const size_t lane = walker % k_block;
    const Vec2 velocity = root.velocity[walker], wish = root.wish ? root.wish[walker] : velocity;
    rows.moves[lane] = 1;
    rows.x[lane] = root.position[walker].x;
    rows.z[lane] = root.position[walker].z;
    rows.velocity_x[lane] = velocity.x;
    rows.velocity_z[lane] = velocity.z;
    rows.wish_x[lane] = wish.x;
    rows.wish_z[lane] = wish.z;
    rows.heading[lane] = root.heading[walker];
    rows.turn_rate[lane] = root.turn_rate[walker];
    set_feet(rows, g, static_cast<int>(lane));
}

void set_feet(StepperRows& rows, const GaitBlock& g, int lane) {
    for (Side side : {k_left, k_right}) rows.swings[side][lane] = g.feet[side].swinging[lane] ? 1.0f : 0.0f;
    rows.stands[lane] = g.standing[lane] ? 1.0f : 0.0f;
}

void advance_paces(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt) {
    HWY_DYNAMIC_DISPATCH(advance_paces_here)(gait, people, steppers, dt);
}

void advance_heights(GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, float dt) {
    HWY_DYNAMIC_DISPATCH(advance_heights_here)(gait, people, steppers, dt);
}

void advance_afar(GaitBlock& gait, const PersonBlock& people, StepperRows& steppers, const float* height,
                  float dt) {
    HWY_DYNAMIC_DISPATCH(advance_afar_here)(gait, people, steppers, height, dt);
}

void find_misfits(const GaitBlock& gait, const PersonBlock& people, StepperRows& steppers) {
    HWY_DYNAMIC_DISPATCH(find_misfits_here)(gait, people, steppers);
}

Misfit misfit(const GaitBlock& gait, const PersonBlock& people, const StepperRows& steppers, Side side,
              int lane) {
    auto off = kernel::misfit<float>(gait, people, steppers, side, static_cast<size_t>(lane));
    return {off.distance, off.twist, off.behind, off.unasked};
}

}  // namespace flaneur
#endif
