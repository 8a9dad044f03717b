// Curves of the walk over float or Lanes.
#if defined(FLANEUR_SIM_GAIT_CURVES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_CURVES_INL_H
#undef FLANEUR_SIM_GAIT_CURVES_INL_H
#else
#define FLANEUR_SIM_GAIT_CURVES_INL_H
#endif

#include "sim/base/math-inl.h"
#include "sim/base/math.h"
#include "sim/gait/norms.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// The series in radians, from the sine and cosine of 2 pi phase; multiples of the angle by the recurrence
// cos (k + 1)a = cos ka cos a - sin ka sin a.
template <int N, class T>
HWY_INLINE T curve_at(const HarmonicCurve<N>& curve, SineCosine<T> a) {
    T value = T(curve.mean);
    T c = a.cosine, s = a.sine;
    for (int k = 0; k < N; ++k) {
        value = value + c * T(curve.terms[k].cosine) + s * T(curve.terms[k].sine);
        T next = c * a.cosine - s * a.sine;
        s = s * a.cosine + c * a.sine;
        c = next;
    }
    return value * T(k_radians);
}

// A phase warped so that toe-off, at `duty`, meets the toe-off of the normal curves.
template <class T>
HWY_INLINE T norm_phase(T phase, T duty) {
    T stance = phase * (T(k_norm_toe_off) / duty);
    T swing = T(k_norm_toe_off) + (phase - duty) * (T(1.0f - k_norm_toe_off) / (T(1.0f) - duty));
    return select(phase < duty, stance, swing);
}

// The share of the body that the left leg carries: 1 in its single support, sliding over in double support.
// `phase` is the left foot's.
template <class T>
HWY_INLINE T left_load(T phase, T duty) {
    T both = duty - T(0.5f);
    return select(phase < T(0.5f), eased(phase / both), T(1.0f) - eased((phase - T(0.5f)) / both));
}

template <class T>
HWY_INLINE T ramp(T low, T high, T v) {
    return eased((v - low) / (high - low));
}

// max(a, b), rounded over a width of `k`.
template <class T>
HWY_INLINE T soft_larger(T a, T b, T k) {
    T d = a - b;
    return (a + b + root(d * d + k * k)) * T(0.5f);
}

// min(a, b), rounded over a width of `k`.
template <class T>
HWY_INLINE T soft_smaller(T a, T b, T k) {
    T d = a - b;
    return (a + b - root(d * d + k * k)) * T(0.5f);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
