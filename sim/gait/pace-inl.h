// Paces, and how far feet are from home, over float or Lanes.
#if defined(FLANEUR_SIM_GAIT_PACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_PACE_INL_H
#undef FLANEUR_SIM_GAIT_PACE_INL_H
#else
#define FLANEUR_SIM_GAIT_PACE_INL_H
#endif

#include "sim/base/math.h"
#include "sim/base/rows-inl.h"
#include "sim/body/body.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/rows.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

inline constexpr float k_run = 0.5f, k_walk = 0.42f;  // Froude numbers where a walk becomes a run and back
inline constexpr float k_turns_within = 0.05f;        // of the cycle after a contact, in which it does,
inline constexpr float k_turning = 3.2f;              // and shares of it a second
inline constexpr float k_leaning = 5, k_driving = 6, k_climbing = 1.2f;  // 1/s
inline constexpr float k_climbs_0 = 0.05f, k_climbs_1 = 0.3f;  // rises, of one who begins to climb, and does

// As in gait.h.
template <class T>
HWY_INLINE T duty_factor(T v) {
    return clamp(T(0.603f) - T(0.06f) * (v - T(1.24f)), T(0.57f), T(0.66f));
}
template <class T>
HWY_INLINE T run_frequency(T v, T leg) {
    T scale = sqrt(T(0.9f) / leg);
    return (T(1.27f) + T(0.03f) * v * scale) * scale;
}
template <class T>
HWY_INLINE T run_duty(T v, T leg) {
    T over = v * sqrt(T(0.9f) / leg) - T(3.1f);
    T reach = (T(k_run_reach) - T(k_run_reach_slope) * over) * leg;
    return min(T(0.391f) - T(0.012f) * over, reach * run_frequency(v, leg) / max(v, T(1.0f)));
}

template <class T>
HWY_INLINE T approached(T v, T target, T step) {
    return v + clamp(target - v, T(0.0f) - step, step);
}

// A walk becomes a run, and a run a walk, over a foot that has just come down: the body that would have
// vaulted over it sinks and leaves the ground, or the other way round.
template <class T>
HWY_INLINE T next_running(const GaitBlock& g, const StepperRows& s, T running, T froude, T dt, size_t lane) {
    T half = T(0.5f), one = T(1.0f), zero = T(0.0f);
    auto runs = froude > select(running > half, T(k_walk), T(k_run));
    auto turns = ((running > zero) & (running < one)) | (row<T>(s.stands, lane) > half);
    for (int side = 0; side < 2; ++side)
        turns = turns | ((row<T>(s.swings[side], lane) < half) &
                         (row<T>(g.feet[side].phase, lane) < T(k_turns_within)));
    return select(turns, approached(running, select(runs, one, zero), T(k_turning) * dt), running);
}

template <class T>
HWY_INLINE void advance_paces(GaitBlock& g, const PersonBlock& p, const StepperRows& s, float seconds,
                              size_t lane) {
    T dt = T(seconds), one = T(1.0f), zero = T(0.0f);
    auto moves = row<T>(s.moves, lane) > T(0.5f);
    auto keep = [&](T value, float* to) { store(select(moves, value, row<T>(to, lane)), to + lane); };
    T vx = row<T>(s.velocity_x, lane), vz = row<T>(s.velocity_z, lane), speed = sqrt(vx * vx + vz * vz);
    T leg = row<T>(p.joints[left_upper_leg][1], lane), froude = speed * speed / (T(k_gravity) * leg);
    T running = next_running(g, s, row<T>(g.running, lane), froude, dt, lane);
    T frequency = row<T>(g.frequency, lane), duty = row<T>(g.duty, lane), was = duty;
    T walks = duty_factor(speed) + row<T>(p.linger, lane);
    duty = approached(duty, lerp(walks, run_duty(speed, leg), running), lerp(T(0.1f), T(0.6f), running) * dt);
    T stretch = (one - duty) / (one - was);
    for (int side = 0; side < 2; ++side) {
        T phase = row<T>(g.feet[side].phase, lane);
        auto changes = (running > zero) & (row<T>(s.swings[side], lane) > T(0.5f));
        keep(select(changes, one - (one - phase) * stretch, phase), g.feet[side].phase);
    }
    T forward = vx * row<T>(s.facing_x, lane) + vz * row<T>(s.facing_z, lane), most = T(0.3f);
    T drive = clamp((forward - row<T>(g.forward, lane)) / (T(k_gravity) * dt), zero - most, most);
    T bank = clamp(speed * row<T>(s.turn_rate, lane) / T(k_gravity), zero - most, most);
    T course = select(speed > T(k_standing_speed), forward / max(speed, T(k_standing_speed)), one);
    auto follow = [&](float* to, T target, T step) { keep(approached(row<T>(to, lane), target, step), to); };
    auto lean = [&](float* to, T target, float quickly) {
        T is = row<T>(to, lane);
        keep(is + (target - is) * T(quickly) * dt, to);
    };
    follow(g.amplitude, smoothstep(T(0.1f), T(0.85f), speed), T(2.6f) * dt);
    follow(g.pace, sqrt(froude), T(0.9f) * dt);
    follow(g.step, speed / (T(2.0f) * leg * frequency), lerp(T(1.2f), T(4.0f), running) * dt);
    follow(g.course, course, T(4.0f) * dt);
    lean(g.drive, row<T>(g.push, lane), k_driving);
    lean(g.push, drive, k_driving);
    lean(g.bank, bank, k_leaning);
    lean(g.climb, smoothstep(T(k_climbs_0), T(k_climbs_1), row<T>(g.rise, lane)), k_climbing);
    keep(running, g.running);
    keep(duty, g.duty);
    keep(forward, g.forward);
}

// See Misfit.
template <class T>
struct MisfitOf {
    T distance, twist, behind, unasked;
};

template <class T>
HWY_INLINE MisfitOf<T> misfit(const GaitBlock& g, const PersonBlock& p, const StepperRows& s, int side,
                              size_t lane) {
    const FootBlock& foot = g.feet[side];
    T mirror = T(side == k_left ? 1.0f : -1.0f);
    T across = mirror * (T(0.5f) * row<T>(p.step_width, lane) + row<T>(foot.stance_out, lane));
    T facing_x = row<T>(s.facing_x, lane), facing_z = row<T>(s.facing_z, lane),
      ahead = row<T>(foot.stance_ahead, lane);
    T wants_x = row<T>(s.x, lane) + facing_z * across + facing_x * ahead,
      wants_z = row<T>(s.z, lane) - facing_x * across + facing_z * ahead;
    T off_x = wants_x - row<T>(foot.to.x, lane), off_z = wants_z - row<T>(foot.to.z, lane);
    T unasked_x = wants_x - row<T>(foot.wished_x, lane), unasked_z = wants_z - row<T>(foot.wished_z, lane);
    T vx = row<T>(s.velocity_x, lane), vz = row<T>(s.velocity_z, lane), wx = row<T>(s.wish_x, lane),
      wz = row<T>(s.wish_z, lane);
    T fast2 = vx * vx + vz * vz, wish2 = wx * wx + wz * wz;
    auto goes = fast2 > wish2;
    T motion = sqrt(max(fast2, wish2));
    T along = off_x * select(goes, vx, wx) + off_z * select(goes, vz, wz);
    T off = row<T>(s.heading, lane) + mirror * (row<T>(p.toe_out, lane) + row<T>(foot.stance_turn, lane)) -
            row<T>(foot.to.yaw, lane);
    T turns = floor(off * T(1 / (2 * k_pi)) + T(0.5f));
    return {sqrt(off_x * off_x + off_z * off_z), abs(off - T(2 * k_pi) * turns),
            select(motion > T(1e-6f), along / max(motion, T(1e-6f)), T(0.0f)),
            sqrt(unasked_x * unasked_x + unasked_z * unasked_z)};
}

template <class T>
HWY_INLINE void find_facing(StepperRows& s, size_t lane) {
    SinCosOf<T> facing = sin_cos(row<T>(s.heading, lane));
    store(facing.sine, s.facing_x + lane);
    store(facing.cosine, s.facing_z + lane);
}

template <class T>
HWY_INLINE void find_misfits(const GaitBlock& g, const PersonBlock& p, StepperRows& s, size_t lane) {
    find_facing<T>(s, lane);
    for (int side = 0; side < 2; ++side) {
        MisfitOf<T> off = misfit<T>(g, p, s, side, lane);
        store(off.distance, s.distance[side] + lane);
        store(off.twist, s.twist[side] + lane);
        store(off.behind, s.behind[side] + lane);
        store(off.unasked, s.unasked[side] + lane);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
