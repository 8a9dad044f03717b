#include "sim/pose/joint_limits.h"

#include "sim/base/math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/joint_limits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/rows-inl.h"
#include "sim/pose/range-inl.h"

#ifndef FLANEUR_SIM_POSE_LEG_RANGES
#define FLANEUR_SIM_POSE_LEG_RANGES
namespace flaneur {

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

// The turn, or as much of it as a turn by twice `half` is.
HWY_INLINE Q4<L> at_most(Q4<L> turn, SinCosOf<L> half) {
    L sign = select(turn.w < L(0.0f), L(-1.0f), L(1.0f));
    L sine = sqrt(max(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z, L(1e-12f)));
    L scale = sign * half.sine / sine;
    Q4<L> part{turn.x * scale, turn.y * scale, turn.z * scale, half.cosine};
    return select(abs(turn.w) < half.cosine, part, turn);
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
