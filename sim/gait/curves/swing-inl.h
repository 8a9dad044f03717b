// The swing of a foot from the place that it leaves to the one where it lands, over float or Lanes: the way
// that the pose shows is the one that the planner of steps keeps clear of the ground.
//
// Places are in any frame with the world's axes, +y up. `u` is the share of the swing, 0 at toe-off .. 1 at
// contact, and r = 1 - u. The numbers stand in fits.h.
#if defined(FLANEUR_SIM_GAIT_CURVES_SWING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_CURVES_SWING_INL_H
#undef FLANEUR_SIM_GAIT_CURVES_SWING_INL_H
#else
#define FLANEUR_SIM_GAIT_CURVES_SWING_INL_H
#endif

#include "sim/base/vec-inl.h"
#include "sim/gait/curves/fits.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
struct SwingTime {
    T u, rest;   // rest = 1 - u
    T product2;  // (u rest)^2
    T hop;       // 16 (u rest)^2: 0 at both ends, 1 in the middle
};
template <class T>
HWY_INLINE SwingTime<T> swing_time(T u) {
    T rest = T(1.0f) - u, product = u * rest;
    return {u, rest, product * product, T(16.0f) * product * product};
}

// The share of its way round the other foot (FootBlock::round) by which a foot is aside: wider than the hop.
template <class T>
HWY_INLINE T round_at(T hop) {
    return hop * (T(2.0f) - hop);
}

// How much of the height at which a heel comes down, of who lands on the ball, is left at this phase of the
// norms' stance.
template <class T>
HWY_INLINE T heel_up_after(T norm) {
    return T(1.0f) - smoothstep(T(0.0f), T(0.16f), norm);
}

// Both ends of a swing: the place left, and from there to the place of landing; likewise the unit normals of
// the ground, whose x and z are given. And how it passes the edge of a step: the last share of its time in
// which it comes down onto lower ground; how much it climbs before it goes on onto higher, 0..1, and up to 2
// the more slowly.
template <class T>
struct SwingEnds {
    V3<T> from, far;
    T from_nx, from_nz, far_nx, far_nz;
    T edge = T(k_step_falls);
};

// Where the foot is on its way.
template <class T>
struct SwingPath {
    V3<T> place;
    T progress;  // share of the way over ground that lies behind it
    T steep;     // 0: the ground slopes evenly .. 1: the way leads over a step
    T step;      // metres by which the landing lies above the slope at the place left
};

// A run, whose swing folds the leg behind the body. Lengths grow with the leg; `pace` is as in GaitBlock.

// A number at a pace of 1, and what a pace faster by 1 adds to it.
template <class T>
HWY_INLINE T at_pace(const RunFit& fit, T faster) {
    return T(fit.value) + T(fit.faster) * faster;
}

// What a run adds to the progress of a swing, r = 1 - u.
template <class T>
HWY_INLINE T run_progress(T u, T r, T pace) {
    T f = pace - T(1.0f), u2 = u * u;
    return u2 * r *
           (at_pace(k_run_progress[0], f) * r * r +
            (at_pace(k_run_progress[1], f) + at_pace(k_run_progress[2], f) * u2) * u * r +
            at_pace(k_run_progress[3], f) * u);
}

// Legs between the lowest point of a swinging foot and the ground.
template <class T>
HWY_INLINE T run_clearance(T u, T r, T pace) {
    T f = pace - T(1.0f), r2 = r * r;
    return u * r *
           ((at_pace(k_run_clear[0], f) + at_pace(k_run_clear[1], f) * u +
             at_pace(k_run_clear[2], f) * u * u) *
                r2 +
            at_pace(k_run_clear[3], f) * u + at_pace(k_run_clear[4], f) * u * u * u * r);
}

// The pitch of a foot, toes up +, radians: a share `stands` of its time on the ground has passed (1 in the
// swing), and u of its swing.
template <class T>
HWY_INLINE T run_pitch(T stands, T u, T pace, T reach) {
    T one = T(1.0f), r = one - u, f = pace - one, u2 = u * u;
    T leaves = max(stands - T(k_run_heel_off), T(0.0f)) * T(1 / (1 - k_run_heel_off));
    T lands = smoothstep(u);
    T off = (T(k_run_push) + T(k_run_push_reach) * reach) * (one - lands);
    T heel_first = T(k_run_contact) * (one - smoothstep(T(0.0f), T(k_run_flat), stands) + lands);
    return heel_first - off * leaves * leaves * (T(1 + k_run_push_late) - T(k_run_push_late) * leaves) +
           u * r * r *
               (at_pace(k_run_swing_pitch[0], f) * r + at_pace(k_run_swing_pitch[1], f) * u +
                at_pace(k_run_swing_pitch[2], f) * u2 + at_pace(k_run_swing_pitch[3], f) * u2 * u2);
}

// Metres by which the landing lies above the slope at the place left, which rises by -(nx x + nz z) / ny over
// the way (x, z); 1 / ny is 1 + (nx^2 + nz^2) / 2 to second order, with the mean of both normals.
template <class T>
HWY_INLINE T step_between(const SwingEnds<T>& ends) {
    const V3<T>& far = ends.far;
    T mean_nx = ends.from_nx + ends.far_nx * T(0.5f), mean_nz = ends.from_nz + ends.far_nz * T(0.5f);
    return far.y + (mean_nx * far.x + mean_nz * far.z) *
                       (T(1.0f) + T(0.5f) * (mean_nx * mean_nx + mean_nz * mean_nz));
}

// Over even ground the foot follows its slope, at the progress 3u^2 - 2u^3, less what the fits take off and
// with what a run adds at this pace. What the slope does not explain is a step, with h metres to climb: a
// foot climbs before it goes on, as far as its toes need that to pass the edge, and goes on before it comes
// down, so that its heel does. Down is up played backwards, and sooner where the edge lies behind.
template <class T>
HWY_INLINE SwingPath<T> swing_path(const SwingEnds<T>& ends, const SwingTime<T>& time, T running, T pace) {
    T one = T(1.0f), u = time.u, rest = time.rest;
    const V3<T>& far = ends.far;
    T progress =
        smoothstep(u) - T(k_progress_late) * time.product2 * (u * u) * (u * u) - T(k_progress_hop) * time.hop;
    if (any(running > T(0.0f)))
        progress = select(running > T(0.0f), progress + running * run_progress(u, rest, pace), progress);
    T climbed = progress;

    T step = step_between(ends);
    T height = max(step, T(0.0f) - step), steep = smoothstep(T(k_step_0), T(k_step_1), height);
    auto steps = steep > T(0.0f);
    if (any(steps)) {
        auto up = step > T(0.0f);
        T v = select(up, u, rest);  // of the climb, or of the descent backwards
        T far2 = far.x * far.x + far.z * far.z + T(0.01f);
        T waits = select(up, min(ends.edge, one), min(T(k_step_waits) * step * step / far2, one)) * steep;
        T slowly = select(up, max(ends.edge - one, T(0.0f)), T(0.0f));
        T climbs = lerp(min(T(k_step_climbs) + height, one), T(k_slow_climbs), slowly);
        T wait = lerp(T(k_step_wait), T(k_slow_wait), slowly);
        climbs = select(up, climbs, lerp(max(ends.edge, T(0.1f)), climbs, waits));
        T onward = smoothstep((v - wait) / (one - wait));
        T upward = smoothstep(v / climbs);
        progress = select(steps, lerp(progress, select(up, onward, one - onward), waits), progress);
        climbed = select(steps, lerp(climbed, select(up, upward, one - upward), steep), climbed);
    }
    T over_step = select(steps, step * (climbed - progress), T(0.0f));
    V3<T> place{ends.from.x + far.x * progress, ends.from.y + far.y * progress + over_step,
                ends.from.z + far.z * progress};
    return {place, progress, steep, step};
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
