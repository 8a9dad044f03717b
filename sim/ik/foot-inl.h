// A foot brought to the ground, over float or Lanes.
#if defined(FLANEUR_SIM_IK_FOOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_FOOT_INL_H
#undef FLANEUR_SIM_IK_FOOT_INL_H
#else
#define FLANEUR_SIM_IK_FOOT_INL_H
#endif

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
struct FootInput {
    V3<T> ankle;     // where the pose has it
    Q4<T> rotation;  // of the foot in the pose; the identity stands flat and looks along +z
    T ankle_height;  // above the sole of a flat foot, metres
    V3<T> ground;    // the point of the ground under the ankle
    V3<T> normal;    // of the ground, unit, upwards
    T range;         // metres between sole and ground beyond which the foot stays where it is, > 0
};

template <class T>
struct FootOutput {
    V3<T> ankle;  // target for the leg's two-bone solver
    Q4<T> rotation;
};

// Within half the range the sole stands on the ground and turns with its normal; from there to the range it
// eases back to the pose, so that nothing jumps when ground comes into range.
template <class T>
HWY_INLINE FootOutput<T> foot_on_ground(const FootInput<T>& in) {
    T gap = absolute(in.ankle.y - in.ankle_height - in.ground.y);
    T weight = eased((in.range - gap) * T(2.0f) / in.range);
    Q4<T> tilt = arc(V3<T>{T(0.0f), T(1.0f), T(0.0f)},
                     unit(mixed(V3<T>{T(0.0f), T(1.0f), T(0.0f)}, in.normal, weight)));
    V3<T> sole{in.ankle.x, in.ground.y, in.ankle.z};
    V3<T> standing = sole + rotate(tilt, V3<T>{T(0.0f), in.ankle_height, T(0.0f)});
    return {mixed(in.ankle, standing, weight), tilt * in.rotation};
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
