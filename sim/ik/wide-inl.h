// Wide: four Lanes side by side, the same operations. A chain of square roots and divisions that each wait
// for the one before leaves a processor idle most of the time; four independent ones keep it busy.
#if defined(FLANEUR_SIM_IK_WIDE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_WIDE_INL_H
#undef FLANEUR_SIM_IK_WIDE_INL_H
#else
#define FLANEUR_SIM_IK_WIDE_INL_H
#endif

#include "sim/base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

struct WideMask {
    LaneMask a, b, c, d;
};
struct Wide {
    Lanes a, b, c, d;
    Wide() = default;
    HWY_INLINE Wide(Lanes a_in, Lanes b_in, Lanes c_in, Lanes d_in) : a(a_in), b(b_in), c(c_in), d(d_in) {}
    HWY_INLINE Wide(float value) : a(value), b(value), c(value), d(value) {}
};
HWY_INLINE size_t wide_count() { return 4 * lane_count(); }

HWY_INLINE Wide operator+(Wide x, Wide y) { return {x.a + y.a, x.b + y.b, x.c + y.c, x.d + y.d}; }
HWY_INLINE Wide operator-(Wide x, Wide y) { return {x.a - y.a, x.b - y.b, x.c - y.c, x.d - y.d}; }
HWY_INLINE Wide operator*(Wide x, Wide y) { return {x.a * y.a, x.b * y.b, x.c * y.c, x.d * y.d}; }
HWY_INLINE Wide operator/(Wide x, Wide y) { return {x.a / y.a, x.b / y.b, x.c / y.c, x.d / y.d}; }
HWY_INLINE WideMask operator<(Wide x, Wide y) { return {x.a < y.a, x.b < y.b, x.c < y.c, x.d < y.d}; }
HWY_INLINE WideMask operator>(Wide x, Wide y) { return {x.a > y.a, x.b > y.b, x.c > y.c, x.d > y.d}; }
HWY_INLINE Wide select(WideMask m, Wide x, Wide y) {
    return {select(m.a, x.a, y.a), select(m.b, x.b, y.b), select(m.c, x.c, y.c), select(m.d, x.d, y.d)};
}
HWY_INLINE bool any(WideMask m) { return any(m.a | m.b | m.c | m.d); }
HWY_INLINE Wide sqrt(Wide x) { return {sqrt(x.a), sqrt(x.b), sqrt(x.c), sqrt(x.d)}; }
HWY_INLINE Wide abs(Wide x) { return {abs(x.a), abs(x.b), abs(x.c), abs(x.d)}; }
HWY_INLINE void load(Wide& to, const float* from) {
    size_t n = lane_count();
    load(to.a, from);
    load(to.b, from + n);
    load(to.c, from + 2 * n);
    load(to.d, from + 3 * n);
}
HWY_INLINE void store(Wide from, float* to) {
    size_t n = lane_count();
    store(from.a, to);
    store(from.b, to + n);
    store(from.c, to + 2 * n);
    store(from.d, to + 3 * n);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
