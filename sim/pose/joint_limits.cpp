#include "sim/pose/joint_limits.h"

#include "sim/base/math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/joint_limits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/rows-inl.h"

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

// Of hip, knee, ankle and toes. The knee's is not asked for: its solver keeps it.
inline constexpr size_t k_knee_of_leg = 1;
struct LegRanges {
    JointRange joints[4];
};

}  // namespace flaneur
#endif

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

using L = Lanes;

// Ends of names say spaces: _ws the world's axes, _ps the parent's, _os places from the pose's origin along
// the world's axes. In the canonical pose all axes are the model's, so bones there are bones in their
// parent's axes.

// How far a joint has turned in the world: the chord between unit quaternions, |p - q| = sqrt(2 - 2 p . q). A
// turn by a is one of chord 2 sin(a / 4), and chords keep the triangle inequality: a joint against its parent
// turns no farther than the chords of both together.
HWY_INLINE L chord(const PoseBlock& before, const PoseBlock& now, size_t joint, size_t lane) {
    L d =
        abs(dot(load_rotation<L>(before.rotation[joint], lane), load_rotation<L>(now.rotation[joint], lane)));
    return sqrt(max(L(2.0f) - d - d, L(0.0f)));
}

HWY_INLINE Q4<L> rotation_ps(const PoseBlock& pose, size_t joint, size_t parent, size_t lane) {
    return conjugate(load_rotation<L>(pose.rotation[parent], lane)) *
           load_rotation<L>(pose.rotation[joint], lane);
}

// A turn of a part that hangs along -y, as JointLimits sees it.
struct Swing {
    V3<L> along_ps;         // where the part points, outward +x
    L low_bend, high_bend;  // sines of what the bend lies beyond either end, times something positive
};
// `q` takes (0, -1, 0) to `along_ps`. A bend by b is the direction (-cos b, sin b) in (y, z), so that the
// cross product of the two tells the side on which the part lies of the range's end.
HWY_INLINE Swing swing_of(Q4<L> q, const JointRange& range, float outward) {
    V3<L> along{(q.w * q.z - q.x * q.y) * L(2.0f * outward), (q.x * q.x + q.z * q.z) * L(2.0f) - L(1.0f),
                (q.y * q.z + q.w * q.x) * L(-2.0f)};
    return {along, along.z * L(range.bend_low.cosine) + along.y * L(range.bend_low.sine),
            along.z * L(range.bend_high.cosine) + along.y * L(range.bend_high.sine)};
}

HWY_INLINE LaneMask beyond(Q4<L> q, const JointRange& range, float outward) {
    Swing s = swing_of(q, range, outward);
    L twist = abs(q.y) * L(range.half_twist.cosine) - abs(q.w) * L(range.half_twist.sine);
    return (s.low_bend < L(0.0f)) | (s.high_bend > L(0.0f)) | (s.along_ps.x < L(range.side_low)) |
           (s.along_ps.x > L(range.side_high)) | (twist > L(0.0f));
}

// The turn, or as much of it as a turn by twice `half` is.
HWY_INLINE Q4<L> at_most(Q4<L> turn, SinCosOf<L> half) {
    L sign = select(turn.w < L(0.0f), L(-1.0f), L(1.0f));
    L sine = sqrt(max(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z, L(1e-12f)));
    L scale = sign * half.sine / sine;
    Q4<L> part{turn.x * scale, turn.y * scale, turn.z * scale, half.cosine};
    return select(abs(turn.w) < half.cosine, part, turn);
}

// The turn with its twist about y at most twice `half`; where it takes y to stays.
HWY_INLINE Q4<L> twist_at_most(Q4<L> turn, SinCosOf<L> half) {
    SinCosOf<L> is = twist_about_y(turn);
    L sine = select(is.sine < L(0.0f), -half.sine, half.sine);
    SinCosOf<L> back{sine * is.cosine - half.cosine * is.sine, half.cosine * is.cosine + sine * is.sine};
    return select(abs(is.sine) > half.sine, turned_y(turn, back), turn);
}

// The nearest turn within the range: its bend, then its side, then its twist.
HWY_INLINE Q4<L> within(Q4<L> q, const JointRange& range, float outward) {
    Swing s = swing_of(q, range, outward);
    L x = clamp(s.along_ps.x, L(range.side_low), L(range.side_high));
    // Behind the joint a bend lies beyond both ends: the nearer one counts.
    L nearer_high = s.along_ps.z * L(range.bend_high.sine - range.bend_low.sine) -
                    s.along_ps.y * L(range.bend_high.cosine - range.bend_low.cosine);
    LaneMask high = (s.high_bend > L(0.0f)) & ((s.low_bend >= L(0.0f)) | (nearer_high > L(0.0f)));
    LaneMask low = s.low_bend < L(0.0f);
    L length2 = s.along_ps.z * s.along_ps.z + s.along_ps.y * s.along_ps.y;
    L is = L(1.0f) / sqrt(max(length2, L(1e-12f))), wanted = sqrt(L(1.0f) - x * x);
    L sine = select(high, L(range.bend_high.sine), select(low, L(range.bend_low.sine), s.along_ps.z * is));
    L cosine =
        select(high, L(range.bend_high.cosine), select(low, L(range.bend_low.cosine), -s.along_ps.y * is));
    V3<L> from{s.along_ps.x * L(outward), s.along_ps.y, s.along_ps.z},
        to{x * L(outward), -cosine * wanted, sine * wanted};
    Q4<L> turned = rotation_between(from, to) * q;
    return twist_at_most(turned, {L(range.half_twist.sine), L(range.half_twist.cosine)});
}

// Feet and toes point ahead: as if they hung.
HWY_INLINE Q4<L> hanging(Q4<L> turn, size_t joint_of_leg) {
    return joint_of_leg > k_knee_of_leg ? Q4<L>{turn.x, -turn.z, turn.y, turn.w} : turn;
}
HWY_INLINE Q4<L> as_it_points(Q4<L> hangs, size_t joint_of_leg) {
    return joint_of_leg > k_knee_of_leg ? Q4<L>{hangs.x, hangs.z, -hangs.y, hangs.w} : hangs;
}

struct LegSide {
    size_t hip;
    float outward;  // +1 left, -1 right
};

// In the lanes of `poor` every joint of the leg is set anew: its own turn, no faster than it can and within
// its range, below its parent.
void restrain_leg(const PersonBlock& person, const PoseBlock& before, PoseBlock& now, LegSide leg,
                  size_t lane, LaneMask poor, SinCosOf<L> limit, const LegRanges& ranges) {
    Q4<L> was_above_ws = load_rotation<L>(now.rotation[hips], lane);
    for (size_t joint = leg.hip; joint < leg.hip + 4; ++joint) {
        size_t parent = joint == leg.hip ? size_t{hips} : joint - 1;
        Q4<L> above_ws = load_rotation<L>(now.rotation[parent], lane);
        Q4<L> was_ws = load_rotation<L>(now.rotation[joint], lane);
        Q4<L> turn_ps = conjugate(was_above_ws) * was_ws;
        was_above_ws = was_ws;
        Q4<L> before_ps = rotation_ps(before, joint, parent, lane);
        turn_ps = at_most(turn_ps * conjugate(before_ps), limit) * before_ps;
        if (size_t k = joint - leg.hip; k != k_knee_of_leg) {
            Q4<L> part = hanging(turn_ps, k), held = within(part, ranges.joints[k], leg.outward);
            turn_ps = select(beyond(part, ranges.joints[k], leg.outward), as_it_points(held, k), turn_ps);
        }
        store_rotation(select(poor, normalize(above_ws * turn_ps), was_ws), now.rotation[joint], lane);
        V3<L> bone_ps =
            load_place<L>(person.joints[joint], lane) - load_place<L>(person.joints[parent], lane);
        V3<L> place_os = load_place<L>(now.position[parent], lane) + rotate(above_ws, bone_ps);
        store_place(select(poor, place_os, load_place<L>(now.position[joint], lane)), now.position[joint],
                    lane);
    }
}

void restrain_here(const Gait& gait, size_t begin, size_t end, float dt, const LegRanges& ranges,
                   const PoseBlock* before, PoseBlock* now) {
    for (size_t b = begin; b < end; ++b) {
        for (size_t lane = 0; lane < k_block; lane += lane_count()) {
            L running;
            load(running, gait.blocks[b].running + lane);
            SinCosOf<L> limit =
                sin_cos_half(lerp(L(k_fastest_walking), L(k_fastest_running), running) * L(dt));
            L farthest = sqrt(L(2.0f) - limit.cosine - limit.cosine);
            L pelvis = chord(before[b], now[b], hips, lane);
            for (LegSide leg : {LegSide{left_upper_leg, 1}, LegSide{right_upper_leg, -1}}) {
                L above = pelvis;
                auto poor = L(0.0f) > L(0.0f);
                for (size_t joint = leg.hip; joint < leg.hip + 4; ++joint) {
                    size_t parent = joint == leg.hip ? size_t{hips} : joint - 1;
                    Q4<L> turn_ps = rotation_ps(now[b], joint, parent, lane);
                    if (size_t k = joint - leg.hip; k != k_knee_of_leg)
                        poor = poor | beyond(hanging(turn_ps, k), ranges.joints[k], leg.outward);
                    L self = chord(before[b], now[b], joint, lane);
                    auto may_be = above + self > farthest;
                    if (any(may_be)) {
                        L d = abs(dot(rotation_ps(before[b], joint, parent, lane), turn_ps));
                        poor = poor | (may_be & (d < limit.cosine));
                    }
                    above = self;
                }
                if (any(poor))
                    restrain_leg(gait.people[b], before[b], now[b], leg, lane, poor, limit, ranges);
            }
        }
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(restrain_here);

void restrain_legs(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                   std::vector<PoseBlock>& now) {
    static const LegRanges ranges{
        {range_of(joint_limits::k_hip), {}, range_of(joint_limits::k_ankle), range_of(joint_limits::k_toes)}};
    HWY_DYNAMIC_DISPATCH(restrain_here)(gait, begin, end, dt, ranges, before.data(), now.data());
}

}  // namespace flaneur
#endif
