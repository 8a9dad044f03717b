#include "sim/pose/joint_limits.h"

#include "sim/base/math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/joint_limits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/pose/rows-inl.h"

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

// How far a joint has turned in the world: the chord between unit quaternions.
HWY_INLINE L chord(const PoseBlock& before, const PoseBlock& now, size_t joint, size_t lane) {
    L d = absolute(
        dot(load_rotation<L>(before.rotation[joint], lane), load_rotation<L>(now.rotation[joint], lane)));
    return root(larger(L(2.0f) - d - d, L(0.0f)));
}

HWY_INLINE Q4<L> against_parent(const PoseBlock& pose, size_t joint, size_t parent, size_t lane) {
    return inverse(load_rotation<L>(pose.rotation[parent], lane)) *
           load_rotation<L>(pose.rotation[joint], lane);
}

// A turn of a part that hangs along -y, as JointLimits sees it.
struct Swing {
    V3<L> along;            // where the part points, outward +x
    L low_bend, high_bend;  // sines of what the bend lies beyond either end, times something positive
};
HWY_INLINE Swing swing_of(Q4<L> q, const JointRange& range, float outward) {
    V3<L> along{(q.w * q.z - q.x * q.y) * L(2.0f * outward), (q.x * q.x + q.z * q.z) * L(2.0f) - L(1.0f),
                (q.y * q.z + q.w * q.x) * L(-2.0f)};
    return {along, along.z * L(range.bend_low.cosine) + along.y * L(range.bend_low.sine),
            along.z * L(range.bend_high.cosine) + along.y * L(range.bend_high.sine)};
}

HWY_INLINE LaneMask beyond(Q4<L> q, const JointRange& range, float outward) {
    Swing s = swing_of(q, range, outward);
    L twist = absolute(q.y) * L(range.half_twist.cosine) - absolute(q.w) * L(range.half_twist.sine);
    return (s.low_bend < L(0.0f)) | (s.high_bend > L(0.0f)) | (s.along.x < L(range.side_low)) |
           (s.along.x > L(range.side_high)) | (twist > L(0.0f));
}

// The turn, or as much of it as a turn by twice `half` is.
HWY_INLINE Q4<L> at_most(Q4<L> turn, SineCosine<L> half) {
    L sign = select(turn.w < L(0.0f), L(-1.0f), L(1.0f));
    L sine = root(larger(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z, L(1e-12f)));
    L scale = sign * half.sine / sine;
    Q4<L> part{turn.x * scale, turn.y * scale, turn.z * scale, half.cosine};
    return select(absolute(turn.w) < half.cosine, part, turn);
}

// The turn with its twist about y at most twice `half`; where it takes y to stays.
HWY_INLINE Q4<L> twist_at_most(Q4<L> turn, SineCosine<L> half) {
    SineCosine<L> is = twist_about_y(turn);
    L sine = select(is.sine < L(0.0f), -half.sine, half.sine);
    SineCosine<L> back{sine * is.cosine - half.cosine * is.sine, half.cosine * is.cosine + sine * is.sine};
    return select(absolute(is.sine) > half.sine, turned_y(turn, back), turn);
}

// The nearest turn within the range: its bend, then its side, then its twist.
HWY_INLINE Q4<L> within(Q4<L> q, const JointRange& range, float outward) {
    Swing s = swing_of(q, range, outward);
    L x = clamped(s.along.x, L(range.side_low), L(range.side_high));
    // Behind the joint a bend lies beyond both ends: the nearer one counts.
    L nearer_high = s.along.z * L(range.bend_high.sine - range.bend_low.sine) -
                    s.along.y * L(range.bend_high.cosine - range.bend_low.cosine);
    LaneMask high = (s.high_bend > L(0.0f)) & ((s.low_bend >= L(0.0f)) | (nearer_high > L(0.0f)));
    LaneMask low = s.low_bend < L(0.0f);
    L length2 = s.along.z * s.along.z + s.along.y * s.along.y;
    L is = L(1.0f) / root(larger(length2, L(1e-12f))), wanted = root(L(1.0f) - x * x);
    L sine = select(high, L(range.bend_high.sine), select(low, L(range.bend_low.sine), s.along.z * is));
    L cosine =
        select(high, L(range.bend_high.cosine), select(low, L(range.bend_low.cosine), -s.along.y * is));
    V3<L> from{s.along.x * L(outward), s.along.y, s.along.z},
        to{x * L(outward), -cosine * wanted, sine * wanted};
    Q4<L> turned = arc(from, to) * q;
    return twist_at_most(turned, {L(range.half_twist.sine), L(range.half_twist.cosine)});
}

// Feet and toes point ahead: as if they hung.
HWY_INLINE Q4<L> hanging(Q4<L> turn, size_t joint_of_leg) {
    return joint_of_leg > k_knee_of_leg ? Q4<L>{turn.x, -turn.z, turn.y, turn.w} : turn;
}
HWY_INLINE Q4<L> as_it_points(Q4<L> hangs, size_t joint_of_leg) {
    return joint_of_leg > k_knee_of_leg ? Q4<L>{hangs.x, hangs.z, -hangs.y, hangs.w} : hangs;
}

struct Leg {
    size_t hip;
    float outward;  // +1 left, -1 right
};

// In the lanes of `poor` every joint of the leg is set anew: its own turn, no faster than it can and within
// its range, below its parent.
void restrain_leg(const PersonBlock& person, const PoseBlock& before, PoseBlock& now, Leg leg, size_t lane,
                  LaneMask poor, SineCosine<L> limit, const LegRanges& ranges) {
    Q4<L> was = load_rotation<L>(now.rotation[hips], lane);
    for (size_t joint = leg.hip; joint < leg.hip + 4; ++joint) {
        size_t parent = joint == leg.hip ? size_t{hips} : joint - 1;
        Q4<L> above = load_rotation<L>(now.rotation[parent], lane);
        Q4<L> self = load_rotation<L>(now.rotation[joint], lane), turn = inverse(was) * self;
        was = self;
        Q4<L> last = against_parent(before, joint, parent, lane);
        turn = at_most(turn * inverse(last), limit) * last;
        if (size_t k = joint - leg.hip; k != k_knee_of_leg) {
            Q4<L> part = hanging(turn, k), held = within(part, ranges.joints[k], leg.outward);
            turn = select(beyond(part, ranges.joints[k], leg.outward), as_it_points(held, k), turn);
        }
        store_rotation(select(poor, unit(above * turn), self), now.rotation[joint], lane);
        V3<L> bone = load_place<L>(person.joints[joint], lane) - load_place<L>(person.joints[parent], lane);
        V3<L> place = load_place<L>(now.position[parent], lane) + rotate(above, bone);
        store_place(select(poor, place, load_place<L>(now.position[joint], lane)), now.position[joint], lane);
    }
}

void restrain_here(const Gait& gait, size_t begin, size_t end, float dt, const LegRanges& ranges,
                   const PoseBlock* before, PoseBlock* now) {
    for (size_t b = begin; b < end; ++b) {
        for (size_t lane = 0; lane < k_block; lane += lane_count()) {
            L running;
            load(running, gait.blocks[b].running + lane);
            SineCosine<L> limit =
                half_turn(mixed(L(k_fastest_walking), L(k_fastest_running), running) * L(dt));
            L farthest = root(L(2.0f) - limit.cosine - limit.cosine);
            L pelvis = chord(before[b], now[b], hips, lane);
            for (Leg leg : {Leg{left_upper_leg, 1}, Leg{right_upper_leg, -1}}) {
                L above = pelvis;
                auto poor = L(0.0f) > L(0.0f);
                for (size_t joint = leg.hip; joint < leg.hip + 4; ++joint) {
                    size_t parent = joint == leg.hip ? size_t{hips} : joint - 1;
                    Q4<L> turn = against_parent(now[b], joint, parent, lane);
                    if (size_t k = joint - leg.hip; k != k_knee_of_leg)
                        poor = poor | beyond(hanging(turn, k), ranges.joints[k], leg.outward);
                    L self = chord(before[b], now[b], joint, lane);
                    auto may_be = above + self > farthest;
                    if (any(may_be)) {
                        L d = absolute(dot(against_parent(before[b], joint, parent, lane), turn));
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
