// Feet of those who are seen from far away, over float or Lanes.
#if defined(FLANEUR_SIM_GAIT_AFAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_AFAR_INL_H
#undef FLANEUR_SIM_GAIT_AFAR_INL_H
#else
#define FLANEUR_SIM_GAIT_AFAR_INL_H
#endif

#include "sim/base/rows-inl.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/curves/norms.h"
#include "sim/gait/pace-inl.h"
#include "sim/gait/rows.h"
#include "sim/gait/states.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

inline constexpr float k_slowest_afar = 0.05f;  // m/s, for whose stride there is a length
inline constexpr float k_turns_to = 2;          // 1/s, of a way that begins to rise
inline constexpr float k_follows = 6;           // 1/s, of a body that the ground lifts
inline constexpr float k_steepest_way = 0.6f;
inline constexpr float k_lets_go = 3;  // 1/s, of hands and heads

// Where the way of one who walks evenly leads, in this tick.
template <class T>
struct AfarStride {
    T speed, length, frequency, duty, lead;  // m/s, metres of two steps, 1/s; shares of the cycle
    V2<T> along, facing;
};

template <class T>
HWY_INLINE AfarStride<T> stride_afar(const GaitBlock& g, const PersonBlock& p, const StepperRows& s,
                                     size_t lane) {
    AfarStride<T> w;
    V2<T> velocity{row<T>(s.velocity_x, lane), row<T>(s.velocity_z, lane)};
    w.facing = {row<T>(s.facing_x, lane), row<T>(s.facing_z, lane)};
    w.speed = sqrt(dot(velocity, velocity));
    T least = max(w.speed, T(k_slowest_afar)), leg = row<T>(p.joints[left_upper_leg][1], lane);
    auto goes = w.speed > T(k_standing_speed);
    w.along = {select(goes, velocity.x / least, w.facing.x), select(goes, velocity.z / least, w.facing.z)};
    T running = row<T>(g.running, lane), course = max(row<T>(g.course, lane), T(0.0f));
    T length = T(2 * k_step_factor) * leg * sqrt(least / sqrt(T(k_gravity) * leg)) * row<T>(p.stride, lane) *
               lerp(T(k_short_stride), T(1.0f), course);
    w.frequency = max(lerp(least / length, run_frequency(least, leg), running), T(k_slowest));
    w.length = select(goes, w.speed / w.frequency, T(0.0f));
    w.duty = row<T>(g.duty, lane);
    w.lead = lerp(T(k_lead) * row<T>(p.lead, lane), T(k_run_lead), running) * w.duty;
    return w;
}

// Sets a foot where an even walk over ground that rises evenly has it at its phase: beside the body's way,
// as far along it as the body has gone, or will have, since it stood over the foot.
template <class T>
HWY_INLINE void set_foot_afar(GaitBlock& g, const PersonBlock& p, StepperRows& s, const AfarStride<T>& w,
                              int side, size_t lane) {
    FootBlock& foot = g.feet[side];
    T zero = T(0.0f), one = T(1.0f), mirror = T(side == k_left ? 1.0f : -1.0f);
    auto goes = w.speed > T(k_standing_speed), moves = row<T>(s.moves, lane) > T(0.5f);
    auto keep = [&](T value, float* to) { store(select(moves, value, row<T>(to, lane)), to + lane); };
    T phase = row<T>(g.phase, lane) + T(side == k_left ? 0.0f : 0.5f);
    phase = select(goes, phase - floor(phase), T(k_rest));
    auto swings = phase >= w.duty;
    auto stands_so = [&](const float* of) { return select(goes, zero, row<T>(of, lane)); };
    T across = mirror * (T(0.5f) * row<T>(p.step_width, lane) + stands_so(foot.stance_out)),
      ahead = stands_so(foot.stance_ahead);
    T rise = row<T>(g.rise, lane), normal = T(-1.0f) / sqrt(one + rise * rise) * rise;
    T yaw = row<T>(s.heading, lane) + mirror * (row<T>(p.toe_out, lane) + stands_so(foot.stance_turn));
    V2<T> line{row<T>(s.x, lane) + w.facing.z * across + w.facing.x * ahead,
               row<T>(s.z, lane) - w.facing.x * across + w.facing.z * ahead};
    auto place_at = [&](FootPlaces& at, T by) {
        keep(line.x + w.along.x * by, at.x);
        keep(row<T>(g.base, lane) + rise * by, at.y);
        keep(line.z + w.along.z * by, at.z);
        keep(yaw, at.yaw);
        keep(w.along.x * normal, at.normal_x);
        keep(w.along.z * normal, at.normal_z);
    };
    T behind = w.length * (w.lead - phase), before = w.length * (one - phase + w.lead);
    place_at(foot.from, behind);
    for (FootPlaces* at : {&foot.to, &foot.goal}) place_at(*at, select(swings, before, behind));
    keep(row<T>(foot.goal.x, lane), foot.wished_x);
    keep(row<T>(foot.goal.z, lane), foot.wished_z);
    keep(yaw, foot.wished_yaw);
    for (float* none : {foot.obstacle, foot.round, foot.goal_round, foot.edge, foot.pivots, foot.beside})
        keep(zero, none);
    for (float* stance : {foot.stance_out, foot.stance_ahead, foot.stance_turn})
        keep(stands_so(stance), stance);
    keep(phase, foot.phase);
    keep(select(goes, row<T>(g.running, lane), zero), foot.forefoot);
    keep(w.frequency, foot.rate);
    store(select(swings & goes, one, zero), s.swings[side] + lane);
}

// The share of the body that the left leg carries: all while the right one swings, and between both it goes
// over to the foot that landed last.
template <class T>
HWY_INLINE T load_afar(const GaitBlock& g, const StepperRows& s, T duty, size_t lane) {
    T zero = T(0.0f), half = T(0.5f), one = T(1.0f);
    T l = row<T>(g.feet[k_left].phase, lane), r = row<T>(g.feet[k_right].phase, lane);
    auto left_swings = row<T>(s.swings[k_left], lane) > half,
         right_swings = row<T>(s.swings[k_right], lane) > half;
    T share = smoothstep(min(l, r) / max((duty - half) * T(k_shift_width), T(0.02f)));
    T stands = select(l < r, share, one - share), next = select(l > r, one, zero);
    return select(left_swings, select(right_swings, next, zero), select(right_swings, one, stands));
}

template <class T>
HWY_INLINE void advance_afar(GaitBlock& g, const PersonBlock& p, StepperRows& s, const float* height,
                             float seconds, size_t lane) {
    T zero = T(0.0f), one = T(1.0f), dt = T(seconds);
    auto moves = row<T>(s.moves, lane) > T(0.5f);
    auto keep = [&](T value, float* to) { store(select(moves, value, row<T>(to, lane)), to + lane); };
    T leg = row<T>(p.joints[left_upper_leg][1], lane);
    find_facing<T>(s, lane);
    advance_paces<T>(g, p, s, seconds, lane);
    AfarStride<T> w = stride_afar<T>(g, p, s, lane);
    auto goes = w.speed > T(k_standing_speed);
    keep(select(w.speed * w.speed > T(k_run * k_gravity) * leg, one, zero), g.running);
    keep(w.frequency, g.frequency);
    T phase = row<T>(g.phase, lane) + select(goes, w.frequency * dt, zero);
    keep(phase - floor(phase), g.phase);

    T climbed = row<T>(height, lane) - row<T>(g.base, lane), most = T(k_steepest_way);
    T rise = select(goes, clamp(climbed / max(w.speed * dt, T(0.01f)), zero - most, most), zero);
    keep(row<T>(g.rise, lane) + (rise - row<T>(g.rise, lane)) * min(one, T(k_turns_to) * dt), g.rise);
    keep(row<T>(g.base, lane) + climbed * min(one, T(k_follows) * dt), g.base);
    for (int side = 0; side < 2; ++side) set_foot_afar<T>(g, p, s, w, side, lane);
    keep(select(goes, load_afar<T>(g, s, w.duty, lane), T(0.5f)), g.load);
    keep(row<T>(g.look, lane) * max(one - T(k_lets_go) * dt, zero), g.look);
    for (HandBlock& hand : g.hands) keep(max(row<T>(hand.reach, lane) - T(k_lets_go) * dt, zero), hand.reach);
    for (float* none : {g.base_velocity, g.sink, g.sink_velocity, g.load_rate, g.interest, g.quicker, g.tread,
                        g.lift, g.crouch, g.jump, g.flight})
        keep(zero, none);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
