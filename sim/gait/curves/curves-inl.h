// Curves of the walk over float or Lanes.
#if defined(FLANEUR_SIM_GAIT_CURVES_CURVES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_CURVES_CURVES_INL_H
#undef FLANEUR_SIM_GAIT_CURVES_CURVES_INL_H
#else
#define FLANEUR_SIM_GAIT_CURVES_CURVES_INL_H
#endif

#include "sim/base/math-inl.h"
#include "sim/base/math.h"
#include "sim/gait/curves/norms.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// cos and sin of 2 pi k phase, k = 1 .. N, for phase in [0, 1].
template <class T, int N>
struct Harmonics {
    T cosine[N], sine[N];
};
// Multiples by Chebyshev's recurrence cos (k + 1)a = 2 cos a cos ka - cos (k - 1)a.
template <int N, class T>
HWY_INLINE Harmonics<T, N> harmonics(T phase) {
    // sin(x + pi) = -sin x, so that the half turn stays within its range.
    SinCosOf<T> shifted = doubled(sin_cos_half((phase - T(0.5f)) * T(2 * k_pi)));
    Harmonics<T, N> h;
    h.cosine[0] = T(0.0f) - shifted.cosine;
    h.sine[0] = T(0.0f) - shifted.sine;
    T twice = h.cosine[0] + h.cosine[0];
    for (int k = 1; k < N; ++k) {
        h.cosine[k] = twice * h.cosine[k - 1] - (k > 1 ? h.cosine[k - 2] : T(1.0f));
        h.sine[k] = k > 1 ? twice * h.sine[k - 1] - h.sine[k - 2] : twice * h.sine[k - 1];
    }
    return h;
}

// The series, times `unit`.
template <int N, class T, int M>
HWY_INLINE T curve_at(const HarmonicCurve<N>& curve, const Harmonics<T, M>& wave, float unit = k_radians) {
    static_assert(N <= M);
    T value = T(curve.mean * unit);
    for (int k = 0; k < N; ++k) {
        if (curve.terms[k].cosine != 0) value = value + wave.cosine[k] * T(curve.terms[k].cosine * unit);
        if (curve.terms[k].sine != 0) value = value + wave.sine[k] * T(curve.terms[k].sine * unit);
    }
    return value;
}

// max(a, b), rounded over a width of `k`.
template <class T>
HWY_INLINE T soft_max(T a, T b, T k) {
    T d = a - b;
    return (a + b + sqrt(d * d + k * k)) * T(0.5f);
}

// min(a, b), rounded over a width of `k`.
template <class T>
HWY_INLINE T soft_min(T a, T b, T k) {
    T d = a - b;
    return (a + b - sqrt(d * d + k * k)) * T(0.5f);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
