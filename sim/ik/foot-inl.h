// A foot flat on the ground, over float or Lanes.
#if defined(FLANEUR_SIM_IK_FOOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_FOOT_INL_H
#undef FLANEUR_SIM_IK_FOOT_INL_H
#else
#define FLANEUR_SIM_IK_FOOT_INL_H
#endif

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// The rotation of a foot that stands flat on ground whose unit normal, upwards, has this x and z: a yaw,
// given by sine and cosine of half of it, then the shortest way from up to the normal. The ankle is its
// height over the sole along the rotation's y above the ground. Ground steeper than 84 degrees counts as 84.
template <class T>
HWY_INLINE Q4<T> flat_on_ground(T normal_x, T normal_z, SinCosOf<T> half_yaw) {
    T one = T(1.0f), zero = T(0.0f);
    T flat2 = normal_x * normal_x + normal_z * normal_z;
    T w = one + sqrt(max(one - flat2, T(0.01f)));
    T scale = one / sqrt(flat2 + w * w);
    return turned_y(Q4<T>{normal_z * scale, zero, zero - normal_x * scale, w * scale}, half_yaw);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
