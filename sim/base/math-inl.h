// The formulas of math.h over float or Lanes. Polynomials: Cephes (Moshier), single precision.
#if defined(FLANEUR_SIM_BASE_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_BASE_MATH_INL_H
#undef FLANEUR_SIM_BASE_MATH_INL_H
#else
#define FLANEUR_SIM_BASE_MATH_INL_H
#endif

#include "sim/base/lanes-inl.h"
#include "sim/base/math.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Quarter turns are taken off in three parts whose products with a small whole number are exact.
template <class T>
HWY_INLINE SinCosOf<T> sin_cos(T x) {
    T quarter = floor(x * T(0.636619772f) + T(0.5f));
    T r = ((x - quarter * T(1.5703125f)) - quarter * T(4.837512969970703125e-4f)) -
          quarter * T(7.5497899548918e-8f);
    T r2 = r * r;
    T s = r + r * r2 * (T(-1.6666654611e-1f) + r2 * (T(8.3321608736e-3f) + r2 * T(-1.9515295891e-4f)));
    T c = T(1.0f) - T(0.5f) * r2 +
          r2 * r2 *
              (T(4.166664568298827e-2f) + r2 * (T(-1.388731625493765e-3f) + r2 * T(2.443315711809948e-5f)));
    T turn = quarter - T(4.0f) * floor(quarter * T(0.25f));  // 0, 1, 2 or 3
    auto odd = ((turn >= T(0.5f)) & (turn <= T(1.5f))) | (turn >= T(2.5f));
    T sine = select(odd, c, s), cosine = select(odd, s, c);
    sine = select(turn >= T(1.5f), -sine, sine);
    cosine = select((turn >= T(0.5f)) & (turn <= T(2.5f)), -cosine, cosine);
    return {sine, cosine};
}

// Sine and cosine of half of `angle`, which lies within -pi .. pi: what a quaternion needs. Minimax
// polynomials, error below 6e-7.
template <class T>
HWY_INLINE SinCosOf<T> sin_cos_half(T angle) {
    T h = angle * T(0.5f), h2 = h * h;
    T s = h * (T(9.99996616e-1f) +
               h2 * (T(-1.66648284e-1f) + h2 * (T(8.30632497e-3f) + h2 * T(-1.83636471e-4f))));
    T c = T(9.99999953e-1f) +
          h2 * (T(-4.99999053e-1f) +
                h2 * (T(4.16635847e-2f) + h2 * (T(-1.38537040e-3f) + h2 * T(2.31539249e-5f))));
    return {s, c};
}

// Of the sum of two angles.
template <class T>
HWY_INLINE SinCosOf<T> plus(SinCosOf<T> a, SinCosOf<T> b) {
    return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

// Of the whole angle, from those of its half.
template <class T>
HWY_INLINE SinCosOf<T> doubled(SinCosOf<T> half) {
    T twice = half.sine + half.sine;
    return {twice * half.cosine, T(1.0f) - twice * half.sine};
}

template <class T>
HWY_INLINE T arctan2(T y, T x) {
    T ax = abs(x), ay = abs(y);
    T high = max(ax, ay), low = min(ax, ay);
    T t = low / select(high > T(0.0f), high, T(1.0f));
    // atan t = atan((t - k) / (1 + k t)) + atan k with k = tan(pi / 8) above that.
    auto upper = t > T(0.4142135623730950f);
    T u = select(upper, (t - T(1.0f)) / (t + T(1.0f)), t);
    T z = u * u;
    T a = u + u * z *
                  (T(-3.33329491539e-1f) +
                   z * (T(1.99777106478e-1f) + z * (T(-1.38776856032e-1f) + z * T(8.05374449538e-2f))));
    a = select(upper, a + T(0.785398163397448f), a);
    a = select(ay > ax, T(1.57079632679490f) - a, a);
    a = select(x < T(0.0f), T(3.14159265358979f) - a, a);
    return select(y < T(0.0f), -a, a);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
