// Two-bone inverse kinematics of a limb in closed form, over float or Lanes.
//
// Half angles of the triangle root, middle, end come from its sides (sin^2(a/2) = (s - b)(s - c) / bc), which
// is exact near full extension where the law of cosines cancels, and is what quaternions need. The plane that
// the limb bends in is carried along by the shortest arc from hanging to pointing at the target, so it turns
// smoothly wherever the target goes but straight above. No trigonometric function is needed.
//
// All is in one space, the caller's: its axes, from the limb's upper end.
#if defined(FLANEUR_SIM_IK_TWO_BONE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_TWO_BONE_INL_H
#undef FLANEUR_SIM_IK_TWO_BONE_INL_H
#else
#define FLANEUR_SIM_IK_TWO_BONE_INL_H
#endif

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
struct LimbSizes {
    T upper, lower;            // lengths of the bones, a centimetre and more, metres
    T over_upper, over_lower;  // 1 / (4 length)
};
template <class T>
HWY_INLINE LimbSizes<T> limb_sizes(T upper, T lower) {
    T quarter = T(0.25f) / (upper * lower);
    return {upper, lower, quarter * lower, quarter * upper};
}

// A limb hangs along -y in the canonical pose (see sim/body/body.h) and looks along +z. Everything in the
// caller's frame, from the limb's root.
template <class T>
struct PosedLimb {
    V3<T> middle, end;           // knee and ankle; `end` is the target where it can be reached
    Q4<T> upper_rot, lower_rot;  // take the canonical bones to their places
};

// Sine and cosine of half the yaw from +z to `front`, times a factor. Not defined for -z.
template <class T>
HWY_INLINE SinCosOf<T> half_yaw_to(T front_x, T front_z) {
    T length = sqrt(front_x * front_x + front_z * front_z);
    return {front_x, max(length + front_z, T(1e-6f))};
}

// `target` is the wanted place of ankle or wrist. `front` is half the yaw at which the limb looks while it
// hangs: its sine and cosine times any factor in [1e-6, 1e6]. `bend` +1: the middle joint goes to where it
// looks (knee), -1: away from there (elbow).
//
// A target beyond reach is pointed at with the limb stretched to 99.95 % of its length; one too close leaves
// the limb folded to |upper - lower| and a millimetre. Bone lengths are kept wherever the target is.
//
// With `soft` > 0, metres, the limb gives way before that: from `soft` short of its reach to `soft` beyond,
// the distance follows a parabola that begins with slope 1 and ends with slope 0. The knee then opens at an
// even speed instead of ever faster, and comes to rest without a knock. A target just at the reach is missed
// by a quarter of `soft`.
template <class T>
HWY_INLINE PosedLimb<T> two_bone(V3<T> target, SinCosOf<T> front, const LimbSizes<T>& size, float bend,
                                 float soft) {
    T u = size.upper, l = size.lower, one = T(1.0f);
    target.y = target.y - T(1e-18f);  // lost in rounding, but gives the zero vector a direction
    T distance = sqrt(dot(target, target));
    T reach = (u + l) * T(0.9995f), d = distance;
    if (soft > 0) {
        T excess = clamp(distance - (reach - T(soft)), T(0.0f), T(2 * soft));
        d = min(distance, reach + T(soft)) - excess * excess * T(0.25f / soft);
    }
    d = clamp(d, abs(u - l) + T(1e-3f), reach);
    T inverse = one / (distance * d);  // one division for two
    T over_d = inverse * distance;
    V3<T> direction = target * (inverse * d);

    // Twice what the perimeter's half s exceeds each side by: s - d, s - l, s - u. `over_upper` is 1 / 4u, so
    // that (s - u)(s - d) / ud and (s - l)(s - d) / ld come out without another division.
    T short_d = u + l - d, short_l = u + d - l, short_u = l + d - u;
    T a2 = short_u * short_d * over_d * size.over_upper, b2 = short_l * short_d * over_d * size.over_lower;
    SinCosOf<T> a{sqrt(a2), sqrt(max(one - a2, T(0.0f)))};
    SinCosOf<T> b{sqrt(b2), sqrt(max(one - b2, T(0.0f)))};

    // The arc is (-y x direction, 1 - direction.y), times 1 + direction.y above the root, where 1 -
    // direction.y cancels. It follows the yaw; both are brought to length 1 at once.
    T flat2 = direction.x * direction.x + direction.z * direction.z;
    auto above = direction.y > T(0.0f);
    T k = select(above, one + direction.y, one), w = select(above, flat2, one - direction.y);
    T x = T(1e-12f) - direction.z * k, z = direction.x * k;
    T norm = (x * x + z * z + w * w) * (front.sine * front.sine + front.cosine * front.cosine);
    T scale = one / sqrt(norm);
    T s = front.sine * scale, c = front.cosine * scale;
    Q4<T> straight{x * c - z * s, w * s, z * c + x * s, w * c};
    V3<T> ahead = axes_of(straight).z;

    PosedLimb<T> out;
    SinCosOf<T> whole = doubled(a);
    out.middle = direction * (u * whole.cosine) + ahead * (u * whole.sine * T(bend));
    out.end = direction * d;
    out.upper_rot = turned_x(straight, {a.sine * T(-bend), a.cosine});
    out.lower_rot = turned_x(straight, {b.sine * T(bend), b.cosine});
    return out;
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
