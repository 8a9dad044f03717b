// How far feet are from home, over float or Lanes.
#if defined(FLANEUR_SIM_GAIT_MISFIT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_MISFIT_INL_H
#undef FLANEUR_SIM_GAIT_MISFIT_INL_H
#else
#define FLANEUR_SIM_GAIT_MISFIT_INL_H
#endif

#include "sim/base/math.h"
#include "sim/base/rows-inl.h"
#include "sim/gait/rows.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

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
    T across = T(0.5f) * mirror * row<T>(p.step_width, lane);
    T wants_x = row<T>(s.x, lane) + row<T>(s.facing_z, lane) * across,
      wants_z = row<T>(s.z, lane) - row<T>(s.facing_x, lane) * across;
    T off_x = wants_x - row<T>(foot.to.x, lane), off_z = wants_z - row<T>(foot.to.z, lane);
    T unasked_x = wants_x - row<T>(foot.wished_x, lane), unasked_z = wants_z - row<T>(foot.wished_z, lane);
    T vx = row<T>(s.velocity_x, lane), vz = row<T>(s.velocity_z, lane), wx = row<T>(s.wish_x, lane),
      wz = row<T>(s.wish_z, lane);
    T fast2 = vx * vx + vz * vz, wish2 = wx * wx + wz * wz;
    auto goes = fast2 > wish2;
    T motion = sqrt(max(fast2, wish2));
    T along = off_x * select(goes, vx, wx) + off_z * select(goes, vz, wz);
    T off = row<T>(s.heading, lane) + mirror * row<T>(p.toe_out, lane) - row<T>(foot.to.yaw, lane);
    T turns = floor(off * T(1 / (2 * k_pi)) + T(0.5f));
    return {sqrt(off_x * off_x + off_z * off_z), abs(off - T(2 * k_pi) * turns),
            select(motion > T(1e-6f), along / max(motion, T(1e-6f)), T(0.0f)),
            sqrt(unasked_x * unasked_x + unasked_z * unasked_z)};
}

template <class T>
HWY_INLINE void find_misfits(const GaitBlock& g, const PersonBlock& p, StepperRows& s, size_t lane) {
    SinCosOf<T> facing = sin_cos(row<T>(s.heading, lane));
    store(facing.sine, s.facing_x + lane);
    store(facing.cosine, s.facing_z + lane);
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
