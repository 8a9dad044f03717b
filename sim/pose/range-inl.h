// Ranges of joints as directions, and the nearest turn within one, over lanes.
#if defined(FLANEUR_SIM_POSE_RANGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_RANGE_INL_H
#undef FLANEUR_SIM_POSE_RANGE_INL_H
#else
#define FLANEUR_SIM_POSE_RANGE_INL_H
#endif

#include "sim/base/vec-inl.h"
#include "sim/pose/joint_limits.h"

#ifndef FLANEUR_SIM_POSE_JOINT_RANGE
#define FLANEUR_SIM_POSE_JOINT_RANGE
namespace flaneur {

// A range as directions: sines and cosines of its ends, half a degree inside.
struct RangeEnd {
    float sine, cosine;
};
struct JointRange {
    RangeEnd bend_low, bend_high;
    float side_low, side_high;
    RangeEnd half_twist;  // of the turn, either way
};

inline JointRange range_of(const JointLimits& limits) {
    auto end = [](float degrees) {
        SinCos s = sin_cos(degrees * k_radians);
        return RangeEnd{s.sine, s.cosine};
    };
    return {end(limits.bend.low + 0.5f), end(limits.bend.high - 0.5f), end(limits.side.low + 0.5f).sine,
            end(limits.side.high - 0.5f).sine, end(0.5f * limits.twist.high - 0.25f)};
}

}  // namespace flaneur
#endif

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// A turn of a part that hangs along -y, as JointLimits sees it.
struct Swing {
    V3<Lanes> along_ps;         // where the part points, outward +x
    Lanes low_bend, high_bend;  // sines of what the bend lies beyond either end, times something positive
};
// `q` takes (0, -1, 0) to `along_ps`. A bend by b is the direction (-cos b, sin b) in (y, z), so that the
// cross product of the two tells the side on which the part lies of the range's end.
HWY_INLINE Swing swing_of(Q4<Lanes> q, const JointRange& range, float outward) {
    V3<Lanes> along{(q.w * q.z - q.x * q.y) * Lanes(2.0f * outward),
                    (q.x * q.x + q.z * q.z) * Lanes(2.0f) - Lanes(1.0f),
                    (q.y * q.z + q.w * q.x) * Lanes(-2.0f)};
    return {along, along.z * Lanes(range.bend_low.cosine) + along.y * Lanes(range.bend_low.sine),
            along.z * Lanes(range.bend_high.cosine) + along.y * Lanes(range.bend_high.sine)};
}

HWY_INLINE LaneMask beyond(Q4<Lanes> q, const JointRange& range, float outward) {
    Swing s = swing_of(q, range, outward);
    Lanes twist = abs(q.y) * Lanes(range.half_twist.cosine) - abs(q.w) * Lanes(range.half_twist.sine);
    return (s.low_bend < Lanes(0.0f)) | (s.high_bend > Lanes(0.0f)) | (s.along_ps.x < Lanes(range.side_low)) |
           (s.along_ps.x > Lanes(range.side_high)) | (twist > Lanes(0.0f));
}

// The turn with its twist about y at most twice `half`; where it takes y to stays.
HWY_INLINE Q4<Lanes> twist_at_most(Q4<Lanes> turn, SinCosOf<Lanes> half) {
    SinCosOf<Lanes> is = twist_about_y(turn);
    Lanes sine = select(is.sine < Lanes(0.0f), -half.sine, half.sine);
    SinCosOf<Lanes> back{sine * is.cosine - half.cosine * is.sine, half.cosine * is.cosine + sine * is.sine};
    return select(abs(is.sine) > half.sine, turned_y(turn, back), turn);
}

// The nearest turn within the range: its bend, then its side, then its twist.
HWY_INLINE Q4<Lanes> within(Q4<Lanes> q, const JointRange& range, float outward) {
    Swing s = swing_of(q, range, outward);
    Lanes x = clamp(s.along_ps.x, Lanes(range.side_low), Lanes(range.side_high));
    // Behind the joint a bend lies beyond both ends: the nearer one counts.
    Lanes nearer_high = s.along_ps.z * Lanes(range.bend_high.sine - range.bend_low.sine) -
                        s.along_ps.y * Lanes(range.bend_high.cosine - range.bend_low.cosine);
    LaneMask high = (s.high_bend > Lanes(0.0f)) & ((s.low_bend >= Lanes(0.0f)) | (nearer_high > Lanes(0.0f)));
    LaneMask low = s.low_bend < Lanes(0.0f);
    Lanes length2 = s.along_ps.z * s.along_ps.z + s.along_ps.y * s.along_ps.y;
    Lanes is = Lanes(1.0f) / sqrt(max(length2, Lanes(1e-12f))), wanted = sqrt(Lanes(1.0f) - x * x);
    Lanes sine =
        select(high, Lanes(range.bend_high.sine), select(low, Lanes(range.bend_low.sine), s.along_ps.z * is));
    Lanes cosine = select(high, Lanes(range.bend_high.cosine),
                          select(low, Lanes(range.bend_low.cosine), -s.along_ps.y * is));
    V3<Lanes> from{s.along_ps.x * Lanes(outward), s.along_ps.y, s.along_ps.z},
        to{x * Lanes(outward), -cosine * wanted, sine * wanted};
    Q4<Lanes> turned = rotation_between(from, to) * q;
    return twist_at_most(turned, {Lanes(range.half_twist.sine), Lanes(range.half_twist.cosine)});
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
