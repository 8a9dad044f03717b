// How high the pelvis rides while one walks, over float or Lanes: the path that the pose gives it is the one
// that the planner of steps expects.
//
// The body falls over the standing leg and is caught by the next one: a smooth path first, which knees and
// heels answer. Harmonics of its path in CMU motion capture (slow, natural and fast walks of nine people), as
// shares of the leg; a longer step needs a lower mean.
#if defined(FLANEUR_SIM_GAIT_CURVES_RISE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_CURVES_RISE_INL_H
#undef FLANEUR_SIM_GAIT_CURVES_RISE_INL_H
#else
#define FLANEUR_SIM_GAIT_CURVES_RISE_INL_H
#endif

#include "sim/base/math.h"
#include "sim/gait/curves/curves-inl.h"
#include "sim/gait/curves/fits.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// How much faster than at a natural pace, as a difference of paces (see GaitBlock); bounded, so that what is
// linear in it stays sound.
template <class T>
HWY_INLINE T over_natural(T pace) {
    return min(pace - T(k_natural_pace), T(k_fastest_over));
}

// Legs by which the pelvis is above where it is when one stands upright. `step` and `amplitude` as in
// GaitBlock, `over` as above; `twice` is 2a, a = 2 pi phase.
template <class T>
HWY_INLINE T pelvis_rise(T step, T over, T amplitude, T climb, SinCosOf<T> twice) {
    // Cosines and sines of 2a, 4a, 6a.
    T c2 = twice.cosine, s2 = twice.sine;
    T c4 = c2 * c2 - s2 * s2, s4 = c2 * s2 + c2 * s2;
    T c6 = c4 * c2 - s4 * s2, s6 = s4 * c2 + c4 * s2;
    over = max(over, T(k_slowest_over));
    T path = c2 * (T(k_rise_c2) + T(k_rise_c2_pace) * over) + s2 * (T(k_rise_s2) + T(k_rise_s2_pace) * over) +
             c4 * T(k_rise_c4) + s4 * T(k_rise_s4) + c6 * T(k_rise_c6) + s6 * T(k_rise_s6);
    T drop = T(k_sink) + T(k_sink_step) * step * step;
    return (path * (T(2.0f) - amplitude) * (T(1.0f) - T(k_uphill) * climb) - drop) * amplitude -
           T(k_stand) * (T(1.0f) - amplitude);
}

// Metres by which the hips are below where they are at contact and at toe-off, `share` of a step after
// contact, which takes `step` seconds and in which a foot stands `duty` of its cycle.
//
// In flight they fall freely. On the ground the path is -a q - b q^2 with q = 4s(1 - s), s the share of
// stance: it goes on at the speed of the flight, and the push of the leg rises from contact to the middle of
// stance and falls again as a parabola.
template <class T>
HWY_INLINE T run_drop(T share, T step, T duty) {
    T stance = min(duty + duty, T(1.0f)), stands = stance * step, flies = step - stands;
    T s = min(share / stance, T(1.0f)), q = T(4.0f) * s * (T(1.0f) - s);
    T on_ground = q * stands * T(k_gravity) * (flies * T(0.125f) + T(k_run_give) * stands * q);
    T t = max(share - stance, T(0.0f)) * step;
    return on_ground - T(0.5f * k_gravity) * t * (flies - t);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
