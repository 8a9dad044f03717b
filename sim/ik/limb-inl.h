// Two-bone inverse kinematics of a limb in closed form, over float or Lanes: the form of two_bone-inl.h for a
// limb that stays within half a turn of the canonical pose, in a frame that turns with the body.
//
// Half angles of the triangle hip, knee, ankle come from its sides (sin^2(a/2) = (s - b)(s - c) / bc), which
// is exact near full extension where the law of cosines cancels, and is what quaternions need.
#if defined(FLANEUR_SIM_IK_LIMB_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_LIMB_INL_H
#undef FLANEUR_SIM_IK_LIMB_INL_H
#else
#define FLANEUR_SIM_IK_LIMB_INL_H
#endif

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
struct LimbSizes {
    T upper, lower;            // lengths of the bones, > 0, metres
    T over_upper, over_lower;  // 1 / (4 length)
};
template <class T>
HWY_INLINE LimbSizes<T> limb_sizes(T upper, T lower) {
    return {upper, lower, T(0.25f) / upper, T(0.25f) / lower};
}

template <class T>
struct Limb {
    V3<T> middle, end;           // knee and ankle from the hip; `end` is the target where it can be reached
    Q4<T> upper_rot, lower_rot;  // take the canonical bones (along -y) to their places
};

// `target` is the wanted place of ankle or wrist from hip or shoulder; `front`, not parallel to it, is where
// the limb's canonical +z should look. `bend` +1: the middle joint goes towards `front` (knee), -1: away from
// it (elbow). A target beyond reach is pointed at with the limb stretched to 99.95 % of its length, one too
// close leaves it folded.
template <class T>
HWY_INLINE Limb<T> solve_limb(V3<T> target, V3<T> front, LimbSizes<T> size, float bend) {
    T u = size.upper, l = size.lower;
    T distance2 = larger(dot(target, target), T(1e-12f));
    T distance = root(distance2);
    V3<T> direction = target * (T(1.0f) / distance);
    T d = clamped(distance, absolute(u - l) + T(1e-3f), (u + l) * T(0.9995f));
    T over_d = T(1.0f) / d;

    T perimeter = u + l + d, short_d = u + l - d, short_l = u + d - l, short_u = l + d - u;
    T at_root = over_d * size.over_upper, at_end = over_d * size.over_lower;
    SineCosine<T> a{root(larger(short_u * short_d * at_root, T(0.0f))), root(short_l * perimeter * at_root)};
    SineCosine<T> b{root(larger(short_l * short_d * at_end, T(0.0f))), root(short_u * perimeter * at_end)};

    Axes<T> plane;
    plane.x = unit(cross(front, direction));
    plane.y = direction * T(-1.0f);
    plane.z = cross(plane.x, plane.y);
    Q4<T> base = rotation_of(plane);

    Limb<T> out;
    SineCosine<T> whole = doubled(a);
    out.middle = direction * (u * whole.cosine) + plane.z * (u * whole.sine * T(bend));
    out.end = direction * d;
    out.upper_rot = turned_x(base, {a.sine * T(-bend), a.cosine});
    out.lower_rot = turned_x(base, {b.sine * T(bend), b.cosine});
    return out;
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
