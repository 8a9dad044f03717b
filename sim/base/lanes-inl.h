// Lanes: up to sixteen floats that go through a formula together, and plain float with the same operations,
// so that a kernel is written once as a template over T = float or T = Lanes. Compiled once for every
// instruction set by Highway; included by kernels between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE only
// through this pattern.
//
// Only operations whose IEEE result is exact to the last bit are here: no fused multiply-add, no estimates.
#if defined(FLANEUR_SIM_BASE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_BASE_LANES_INL_H
#undef FLANEUR_SIM_BASE_LANES_INL_H
#else
#define FLANEUR_SIM_BASE_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using LaneTag = hn::CappedTag<float, 16>;

struct LaneMask {
    hn::Mask<LaneTag> m;
};
struct Lanes {
    hn::Vec<LaneTag> v;
    Lanes() = default;
    HWY_INLINE Lanes(hn::Vec<LaneTag> value) : v(value) {}
    HWY_INLINE Lanes(float value) : v(hn::Set(LaneTag(), value)) {}
};
HWY_INLINE size_t lane_count() { return hn::Lanes(LaneTag()); }

HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
HWY_INLINE Lanes operator-(Lanes a) { return hn::Neg(a.v); }
HWY_INLINE LaneMask operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE LaneMask operator>(Lanes a, Lanes b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE LaneMask operator<=(Lanes a, Lanes b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE LaneMask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
HWY_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {hn::Or(a.m, b.m)}; }

HWY_INLINE bool any(LaneMask m) { return !hn::AllFalse(LaneTag(), m.m); }

HWY_INLINE Lanes select(LaneMask m, Lanes a, Lanes b) { return hn::IfThenElse(m.m, a.v, b.v); }
HWY_INLINE Lanes sqrt(Lanes a) { return hn::Sqrt(a.v); }
HWY_INLINE Lanes abs(Lanes a) { return hn::Abs(a.v); }
HWY_INLINE Lanes floor(Lanes a) { return hn::Floor(a.v); }
HWY_INLINE void load(Lanes& to, const float* from) { to.v = hn::Load(LaneTag(), from); }
HWY_INLINE void store(Lanes from, float* to) { hn::Store(from.v, LaneTag(), to); }

HWY_INLINE bool any(bool m) { return m; }
HWY_INLINE float select(bool m, float a, float b) { return m ? a : b; }
HWY_INLINE float sqrt(float a) { return std::sqrt(a); }
HWY_INLINE float abs(float a) { return std::fabs(a); }
HWY_INLINE float floor(float a) { return std::floor(a); }
HWY_INLINE void load(float& to, const float* from) { to = *from; }
HWY_INLINE void store(float from, float* to) { *to = from; }

// Of two equal zeros the second; NaN in either gives b.
template <class T>
HWY_INLINE T min(T a, T b) {
    return select(a < b, a, b);
}
template <class T>
HWY_INLINE T max(T a, T b) {
    return select(a > b, a, b);
}
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
// One instruction that says just this.
HWY_INLINE Lanes min(Lanes a, Lanes b) { return hn::Min(a.v, b.v); }
HWY_INLINE Lanes max(Lanes a, Lanes b) { return hn::Max(a.v, b.v); }
#endif
template <class T>
HWY_INLINE T clamp(T v, T low, T high) {
    return min(max(v, low), high);
}
template <class T>
HWY_INLINE T lerp(T a, T b, T t) {
    return a + (b - a) * t;
}
// 0 below 0, 1 above 1, 3t^2 - 2t^3 between.
template <class T>
HWY_INLINE T smoothstep(T t) {
    t = clamp(t, T(0.0f), T(1.0f));
    return t * t * (T(3.0f) - T(2.0f) * t);
}
// The same of where v lies between `low` and `high`; constant limits cost no division.
template <class T>
HWY_INLINE T smoothstep(T low, T high, T v) {
    return smoothstep((v - low) * (T(1.0f) / (high - low)));
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
