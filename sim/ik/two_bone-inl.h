// Two-bone inverse kinematics in closed form, over float or Lanes.
//
// The law of cosines places the middle joint in the plane of root, target and pole; rotations are built from
// shortest arcs as half-angle quaternions, so no trigonometric function is needed.
#if defined(FLANEUR_SIM_IK_TWO_BONE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_TWO_BONE_INL_H
#undef FLANEUR_SIM_IK_TWO_BONE_INL_H
#else
#define FLANEUR_SIM_IK_TWO_BONE_INL_H
#endif

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// A limb hangs along -y in the canonical pose (see sim/pose/body.h) and looks along +z. Everything in one
// space.
template <class T>
struct TwoBoneInput {
    V3<T> root;      // hip or shoulder
    V3<T> target;    // wanted place of ankle or wrist
    T upper, lower;  // lengths, > 0, metres
    V3<T> front;  // where the limb's canonical +z should look, as far as the target allows; need not be unit
                  // or square to the limb, but must not be parallel to it
    T bend;       // +1: the middle joint goes towards `front` (knee); -1: away from it (elbow)
    Q4<T> reference;  // a rotation near the result's (that of pelvis or chest); settles the twist's branch
};

template <class T>
struct TwoBoneOutput {
    V3<T> middle, end;           // knee and ankle; `end` is the target where it can be reached
    Q4<T> upper_rot, lower_rot;  // take the canonical bones to their places
};

// A target beyond reach is pointed at with the limb stretched to 99.95 % of its length; one too close leaves
// the limb folded to |upper - lower| and a millimetre. Bone lengths are kept whatever the input.
template <class T>
HWY_INLINE TwoBoneOutput<T> two_bone(const TwoBoneInput<T>& in) {
    V3<T> to_target = in.target - in.root;
    T distance = root(larger(dot(to_target, to_target), T(1e-12f)));
    V3<T> direction = to_target * (T(1.0f) / distance);
    T reach = (in.upper + in.lower) * T(0.9995f);
    T fold = absolute(in.upper - in.lower) + T(1e-3f);
    T d = clamped(distance, fold, reach);

    // Square to the limb's plane: canonical +x, which is (+y) x (+z) = (-direction) x front.
    V3<T> hinge = unit(cross(in.front, direction));
    V3<T> side = cross(direction, hinge) * in.bend;  // unit, towards the bend

    T along = (in.upper * in.upper - in.lower * in.lower + d * d) / (T(2.0f) * d);
    T height = root(larger(in.upper * in.upper - along * along, T(0.0f)));
    V3<T> upper_dir = (direction * along + side * height) * (T(1.0f) / in.upper);
    V3<T> lower_dir = (direction * (d - along) - side * height) * (T(1.0f) / in.lower);
    TwoBoneOutput<T> out;
    out.middle = in.root + direction * along + side * height;
    out.end = in.root + direction * d;

    V3<T> down = rotate(in.reference, V3<T>{T(0.0f), T(-1.0f), T(0.0f)});
    Q4<T> aimed = arc(down, upper_dir) * in.reference;
    V3<T> aimed_x = rotate(aimed, V3<T>{T(1.0f), T(0.0f), T(0.0f)});
    out.upper_rot = arc(aimed_x, hinge) * aimed;
    out.lower_rot = arc(upper_dir, lower_dir) * out.upper_rot;
    return out;
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
