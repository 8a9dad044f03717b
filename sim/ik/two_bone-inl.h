// Two-bone inverse kinematics in closed form, over float or Lanes.
//
// The law of cosines places the middle joint. The plane that the limb bends in is carried along by the
// shortest arc from hanging to pointing at the target, so it turns smoothly wherever the target goes but
// straight above. Rotations are built as half-angle quaternions, so no trigonometric function is needed.
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
    V3<T> root;        // hip or shoulder
    V3<T> target;      // wanted place of ankle or wrist
    T upper, lower;    // lengths, > 0, metres
    V3<T> front;       // where the limb's canonical +z looks while it hangs; need not be unit or square to it
    T bend;            // +1: the middle joint goes towards `front` (knee); -1: away from it (elbow)
    Q4<T> reference;   // of pelvis or chest: its -y is where the limb hangs, and results are near it
    T soft = T(0.0f);  // metres before full extension from which the limb gives way, see below; 0: none
};

template <class T>
struct TwoBoneOutput {
    V3<T> middle, end;           // knee and ankle; `end` is the target where it can be reached
    Q4<T> upper_rot, lower_rot;  // take the canonical bones to their places
};

// The rotation with the given axes (orthonormal, right-handed), not of unit length, on the side of
// `reference`. The outer product q q^T is linear in the matrix of a rotation (Bar-Itzhack 2000), and its
// product with `reference` lies along q. The diagonal is raised a little so that something is left where q is
// half a turn away from the reference.
template <class T>
HWY_INLINE Q4<T> rotation_near(Axes<T> a, Q4<T> reference) {
    V3<T> x = a.x, y = a.y, z = a.z;
    T one = T(1.000001f);
    T xx = one + x.x - y.y - z.z, yy = one - x.x + y.y - z.z, zz = one - x.x - y.y + z.z,
      ww = one + x.x + y.y + z.z;
    T xy = x.y + y.x, xz = x.z + z.x, yz = y.z + z.y;
    T xw = y.z - z.y, yw = z.x - x.z, zw = x.y - y.x;
    Q4<T> r = reference;
    return {xx * r.x + xy * r.y + xz * r.z + xw * r.w, xy * r.x + yy * r.y + yz * r.z + yw * r.w,
            xz * r.x + yz * r.y + zz * r.z + zw * r.w, xw * r.x + yw * r.y + zw * r.z + ww * r.w};
}

// `q` brought to unit length, however short it is.
template <class T>
HWY_INLINE Q4<T> unit_of(Q4<T> q) {
    T s = T(1.0f) / root(larger(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, T(1e-30f)));
    return {q.x * s, q.y * s, q.z * s, q.w * s};
}

// A target beyond reach is pointed at with the limb stretched to 99.95 % of its length; one too close leaves
// the limb folded to |upper - lower| and a millimetre. Bone lengths are kept whatever the input.
//
// With `soft` the limb gives way before that: from `soft` short of its reach to `soft` beyond, the distance
// follows a parabola that begins with slope 1 and ends with slope 0. The knee then opens at an even speed
// instead of ever faster, and comes to rest without a knock. A target just at the reach is missed by a
// quarter of `soft`.
template <class T>
HWY_INLINE TwoBoneOutput<T> two_bone(const TwoBoneInput<T>& in) {
    // Canonical +x is (+y) x (+z) = (-down) x front; a little of the reference's own where these are
    // parallel.
    Axes<T> axes = axes_of(in.reference);
    V3<T> down = axes.y * T(-1.0f);
    V3<T> hanging_hinge = unit(cross(in.front, down) + axes.x * T(1e-5f));

    V3<T> to_target = in.target - in.root;
    T distance = root(larger(dot(to_target, to_target), T(1e-12f)));
    T reach = (in.upper + in.lower) * T(0.9995f);
    T fold = absolute(in.upper - in.lower) + T(1e-3f);
    T soft = larger(in.soft, T(1e-7f));
    T inverse = T(1.0f) / (distance * soft);  // one division for two
    V3<T> direction = to_target * (inverse * soft);
    T excess = clamped(distance - (reach - soft), T(0.0f), soft + soft);
    T give = excess * excess * T(0.25f) * (inverse * distance);
    T d = larger(smaller(distance, reach + soft) - give, fold);

    // The shortest arc from `down` to `direction` is, for what is square to `down`, a mirror square to their
    // sum: lengths stay whatever the rounding.
    V3<T> sum = down + direction;
    T sum2 = dot(sum, sum);
    T across = dot(direction, hanging_hinge) * T(2.0f) / larger(sum2, T(1e-10f));
    V3<T> hinge = hanging_hinge - sum * select(sum2 > T(1e-10f), across, T(0.0f));
    V3<T> ahead = cross(direction, hinge);

    T along = (in.upper * in.upper - in.lower * in.lower + d * d) / (d + d);
    T height = root(larger(in.upper * in.upper - along * along, T(0.0f))) * in.bend;
    TwoBoneOutput<T> out;
    out.middle = in.root + direction * along + ahead * height;
    out.end = in.root + direction * d;
    Q4<T> straight = rotation_near(Axes<T>{hinge, direction * T(-1.0f), ahead}, in.reference);
    out.upper_rot = unit_of(turned_x(straight, {-height, in.upper + along}));
    out.lower_rot = unit_of(turned_x(straight, {height, in.lower + d - along}));
    return out;
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
