// FABRIK, forward and backward reaching inverse kinematics, for a chain of any length (Aristidou & Lasenby
// 2011, "FABRIK: a fast, iterative solver for the inverse kinematics problem", Graphical Models 73), over
// float, Lanes or Wide: one chain a lane.
//
// Everything of one chain is in one space, whichever the caller's is.
//
// A chain is joints p[0 .. joints), the first at rest, and bones[i] the length from p[i] to p[i + 1].
// One iteration draws the joints along from the target inwards, then back from the base outwards; the
// outward pass is last, so bone lengths are kept to rounding whatever the input. An iteration depends on the
// places alone: n and then m iterations are n + m.
#if defined(FLANEUR_SIM_IK_FABRIK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_FABRIK_INL_H
#undef FLANEUR_SIM_IK_FABRIK_INL_H
#else
#define FLANEUR_SIM_IK_FABRIK_INL_H
#endif

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// An attometre: lost in rounding beside any other vector, it gives the zero vector a direction, +y.
inline constexpr float k_speck = 1e-18f;

// The unit vector along `a`.
template <class T>
HWY_INLINE V3<T> direction_of(V3<T> a) {
    a.y = a.y + T(k_speck);
    return a * (T(1.0f) / sqrt(dot(a, a)));
}

// The point `length` away from `anchor`, towards `p`.
template <class T>
HWY_INLINE V3<T> drawn(V3<T> anchor, V3<T> p, T length) {
    V3<T> a = p - anchor;
    a.y = a.y + T(k_speck);
    return anchor + a * (length / sqrt(dot(a, a)));
}

// A unit vector square to unit vector `a`.
template <class T>
HWY_INLINE V3<T> square_to(V3<T> a) {
    auto steep = abs(a.y) > T(0.9f);
    T x = select(steep, T(1.0f), T(0.0f)), y = select(steep, T(0.0f), T(1.0f));
    return normalize(cross(a, V3<T>{x, y, T(0.0f)}));
}

// Unit vector `a` brought into the cone about unit vector `axis` whose half angle has this cosine.
template <class T>
HWY_INLINE V3<T> within_cone(V3<T> a, V3<T> axis, T cosine) {
    T along = dot(a, axis);
    V3<T> side = a - axis * along;
    T side2 = dot(side, side);
    auto opposite = side2 < T(1e-10f);
    if (any(opposite)) side = select(opposite, square_to(axis), side);
    T sine = sqrt(max(T(1.0f) - cosine * cosine, T(0.0f)));
    V3<T> rim = axis * cosine + side * (sine / sqrt(select(opposite, T(1.0f), side2)));
    return select(along < cosine, rim, a);
}

// From the base to the target.
template <class T>
struct TargetLine {
    V3<T> direction;     // unit
    T distance, length;  // of the target; of the stretched chain
    V3<T> target;
};
// From `soft` short of its length the chain gives way: the distance follows the parabola of two_bone-inl.h,
// and the target is drawn in as far.
template <class T>
HWY_INLINE TargetLine<T> line_to(const V3<T>* p, const T* bones, int joints, V3<T> target, T soft) {
    V3<T> to_target = target - p[0];
    T length = bones[0];
    for (int i = 1; i + 1 < joints; ++i) length = length + bones[i];
    T distance = sqrt(dot(to_target, to_target));
    soft = max(soft, T(1e-7f));
    T excess = clamp(distance - (length - soft), T(0.0f), soft + soft);
    T d = distance - excess * excess * T(0.25f) / soft;
    V3<T> direction = direction_of(to_target);
    return {direction, d, length, select(excess > T(0.0f), p[0] + direction * d, target)};
}

// A chain that lies on the line to its target would never leave it. It is bowed by about what the way to the
// target needs: an arc of length l over a chord c rises by sqrt(3/8 l (l - c)) for c near l.
template <class T>
HWY_INLINE void bow(V3<T>* p, int joints, const TargetLine<T>& line) {
    T off2 = T(0.0f);
    for (int i = 1; i + 1 < joints; ++i) {
        V3<T> a = p[i] - p[0];
        V3<T> side = a - line.direction * dot(a, line.direction);
        off2 = max(off2, dot(side, side));
    }
    T rise2 = T(0.375f) * line.length * max(line.length - line.distance, T(0.0f));
    auto straight = off2 < rise2 * T(1e-4f);
    if (!any(straight)) return;
    V3<T> side = square_to(line.direction) * sqrt(rise2);
    for (int i = 1; i + 1 < joints; ++i) {
        float t = static_cast<float>(i) / static_cast<float>(joints - 1);
        p[i] = select(straight, p[i] + side * T(4 * t * (1 - t)), p[i]);
    }
}

// Moves p[1 .. joints) so that the last comes to `target`, joints >= 2. A target out of reach is pointed at
// with the whole chain stretched.
//
// A chain of 10 joints takes 10.6 iterations on average to come within 1 mm of targets spread evenly over its
// reach, 21.5 to 0.1 mm (the paper: 15.5, to a tolerance that it does not give); inside 90 % of the reach 2.6
// do, near full extension hundreds. A millimetre short of that the bones of a chain of half a metre stand 4
// degrees and more off the line; `soft`, in metres and 0 for none, spreads that opening.
template <class T>
HWY_INLINE void fabrik(V3<T>* p, const T* bones, int joints, V3<T> target, T soft, int iterations) {
    TargetLine<T> line = line_to(p, bones, joints, target, soft);
    target = line.target;
    bow(p, joints, line);
    int last = joints - 1;
    for (int k = 0; k < iterations; ++k) {
        V3<T> at = target;
        for (int i = last - 1; i > 0; --i) p[i] = at = drawn(at, p[i], bones[i]);
        p[last] = target;
        at = p[0];
        for (int i = 1; i <= last; ++i) p[i] = at = drawn(at, p[i], bones[i - 1]);
    }
    auto far = line.distance > line.length;
    if (!any(far)) return;
    V3<T> at = p[0];
    for (int i = 1; i <= last; ++i) {
        at = at + line.direction * bones[i - 1];
        p[i] = select(far, at, p[i]);
    }
}

// As fabrik, with a limit at each joint: bone i makes an angle with the bone before it, bone 0 with unit
// vector `axis`, whose cosine is limits[i] or more. -1: free. Both passes bring each bone into the cone about
// its neighbour, so limits hold to rounding; a target that they forbid is approached as far as the iteration
// gets.
template <class T>
HWY_INLINE void fabrik_limited(V3<T>* p, const T* bones, const T* limits, V3<T> axis, int joints,
                               V3<T> target, T soft, int iterations) {
    TargetLine<T> line = line_to(p, bones, joints, target, soft);
    bow(p, joints, line);
    target = p[0] + line.direction * min(line.distance, line.length);
    int last = joints - 1;
    for (int k = 0; k < iterations; ++k) {
        V3<T> inner = direction_of(target - p[last - 1]);
        V3<T> at = p[last - 1] = target - inner * bones[last - 1];
        for (int i = last - 2; i >= 0; --i) {
            inner = within_cone(direction_of(at - p[i]), inner, limits[i + 1]);
            at = at - inner * bones[i];
            if (i > 0) p[i] = at;
        }
        p[last] = target;
        at = p[0];
        V3<T> outer = axis;
        for (int i = 1; i <= last; ++i) {
            outer = within_cone(direction_of(p[i] - at), outer, limits[i - 1]);
            p[i] = at = at + outer * bones[i - 1];
        }
    }
}

// A hinge bends its bone against the one before by `low` to `high` about its axis, right-handed; radians,
// within half a turn of each other.
template <class T>
struct HingeLimit {
    SinCosOf<T> middle;
    T cosine;  // of half the range
};
template <class T>
HWY_INLINE HingeLimit<T> hinge_limit(T low, T high) {
    return {sin_cos((low + high) * T(0.5f)), sin_cos((high - low) * T(0.5f)).cosine};
}

// The unit vector along `a` in the plane of unit vector `hinge`, brought into the limit against `before`,
// which is unit and lies in that plane. `sense` -1: `before` is the bone that comes after.
template <class T>
HWY_INLINE V3<T> within_hinge(V3<T> a, V3<T> before, V3<T> hinge, HingeLimit<T> limit, float sense) {
    V3<T> middle = before * limit.middle.cosine + cross(hinge, before) * (limit.middle.sine * T(sense));
    V3<T> side = cross(hinge, middle);
    T along = dot(a, middle), across = dot(a, side), length2 = along * along + across * across;
    auto none = length2 < T(1e-14f);
    T scale = T(1.0f) / sqrt(select(none, T(1.0f), length2));
    along = select(none, T(1.0f), along * scale);
    across = select(none, T(0.0f), across * scale);
    T sine = sqrt(max(T(1.0f) - limit.cosine * limit.cosine, T(0.0f)));
    auto over = along < limit.cosine;
    T rim = select(across < T(0.0f), T(0.0f) - sine, sine);
    return middle * select(over, limit.cosine, along) + side * select(over, rim, across);
}

// Turns each hinge of a chain, from the last to the first, by as much as brings the end nearest to `target`
// or its limit allows.
template <class T>
HWY_INLINE void turn_hinges(V3<T>* p, const HingeLimit<T>* limits, V3<T> hinge, V3<T> axis, int joints,
                            V3<T> target) {
    const HingeLimit<T> free{{T(0.0f), T(1.0f)}, T(-1.0f)};
    for (int i = joints - 2; i >= 0; --i) {
        V3<T> before = i == 0 ? axis : direction_of(p[i] - p[i - 1]);
        V3<T> bone = direction_of(p[i + 1] - p[i]);
        V3<T> end = within_hinge(p[joints - 1] - p[i], axis, hinge, free, 1.0f);
        V3<T> to = within_hinge(target - p[i], axis, hinge, free, 1.0f);
        V3<T> wanted = bone * dot(end, to) + cross(hinge, bone) * dot(cross(end, to), hinge);
        wanted = within_hinge(wanted, before, hinge, limits[i], 1.0f);
        T cosine = dot(bone, wanted), sine = dot(cross(bone, wanted), hinge);
        for (int j = i + 1; j < joints; ++j) {
            V3<T> from = p[j] - p[i];
            p[j] = p[i] + from * cosine + cross(hinge, from) * sine;
        }
    }
}

// As fabrik, for a chain of hinges about one axis, such as a finger: `hinge`, unit. Joint i bends bone i
// against the bone before it within limits[i], bone 0 against `axis`, unit and square to the hinge. The chain
// comes to lie in the plane of the hinge through p[0] and goes for the point of that plane next to `target`;
// limits hold to rounding. Start from a pose within them: in a plane a chain cannot go around what bars its
// way. From the middle of the ranges of random fingers of 2 to 9 bones 91 % of the reachable targets are
// reached in 50 iterations.
template <class T>
HWY_INLINE void fabrik_hinged(V3<T>* p, const T* bones, const HingeLimit<T>* limits, V3<T> hinge, V3<T> axis,
                              int joints, V3<T> target, T soft, int iterations) {
    target = target - hinge * dot(target - p[0], hinge);
    TargetLine<T> line = line_to(p, bones, joints, target, soft);
    target = p[0] + line.direction * min(line.distance, line.length);
    int last = joints - 1;
    for (int k = 0; k < iterations; ++k) {
        V3<T> at = target;
        V3<T> inner = target - p[last - 1];
        inner = within_hinge(inner, axis, hinge, HingeLimit<T>{{T(0.0f), T(1.0f)}, T(-1.0f)}, 1.0f);
        for (int i = last - 1; i > 0; --i) {
            p[i] = at = at - inner * bones[i];
            inner = within_hinge(at - p[i - 1], inner, hinge, limits[i], -1.0f);
        }
        at = p[0];
        V3<T> outer = axis;
        for (int i = 1; i <= last; ++i) {
            V3<T> wanted = i < last ? p[i] : target;
            outer = within_hinge(wanted - at, outer, hinge, limits[i - 1], 1.0f);
            p[i] = at = at + outer * bones[i - 1];
        }
        turn_hinges(p, limits, hinge, axis, joints, target);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
