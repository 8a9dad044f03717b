#include "sim/pose/joint_speed.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/joint_speed.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/pose/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Sine and cosine of half the largest turn.
using Limit = SineCosine<Lanes>;

// How far a joint has turned in the world: the chord between unit quaternions.
HWY_INLINE Lanes chord(const PoseBlock& before, const PoseBlock& now, size_t joint, size_t lane) {
    Lanes d = absolute(dot(load_rotation<Lanes>(before.rotation[joint], lane),
                           load_rotation<Lanes>(now.rotation[joint], lane)));
    return root(larger(Lanes(2.0f) - d - d, Lanes(0.0f)));
}

HWY_INLINE Q4<Lanes> against_parent(const PoseBlock& pose, size_t joint, size_t parent, size_t lane) {
    return inverse(load_rotation<Lanes>(pose.rotation[parent], lane)) *
           load_rotation<Lanes>(pose.rotation[joint], lane);
}

// What takes `from` to `to`, or as much of it as the limit allows.
HWY_INLINE Q4<Lanes> limited_turn(Q4<Lanes> from, Q4<Lanes> to, Limit limit) {
    Q4<Lanes> turn = to * inverse(from);
    Lanes sign = select(turn.w < Lanes(0.0f), Lanes(-1.0f), Lanes(1.0f));
    Lanes sine = root(larger(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z, Lanes(1e-12f)));
    Lanes scale = sign * limit.sine / sine;
    auto fast = absolute(turn.w) < limit.cosine;
    return {select(fast, turn.x * scale, turn.x), select(fast, turn.y * scale, turn.y),
            select(fast, turn.z * scale, turn.z), select(fast, limit.cosine, turn.w)};
}

HWY_INLINE Q4<Lanes> select(LaneMask m, Q4<Lanes> a, Q4<Lanes> b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}

// In the lanes of `fast` every joint of the leg is set anew: its own turn limited, below its parent.
void slow_leg(const PersonBlock& person, const PoseBlock& before, PoseBlock& now, size_t leg, size_t lane,
              LaneMask fast, Limit limit) {
    Q4<Lanes> was = load_rotation<Lanes>(now.rotation[hips], lane);
    for (size_t joint = leg; joint < leg + 4; ++joint) {
        size_t parent = joint == leg ? size_t{hips} : joint - 1;
        Q4<Lanes> above = load_rotation<Lanes>(now.rotation[parent], lane);
        Q4<Lanes> self = load_rotation<Lanes>(now.rotation[joint], lane);
        Q4<Lanes> last = against_parent(before, joint, parent, lane);
        Q4<Lanes> turn = limited_turn(last, inverse(was) * self, limit);
        was = self;
        store_rotation(select(fast, unit(above * (turn * last)), self), now.rotation[joint], lane);
        V3<Lanes> bone =
            load_place<Lanes>(person.joints[joint], lane) - load_place<Lanes>(person.joints[parent], lane);
        V3<Lanes> place = load_place<Lanes>(now.position[parent], lane) + rotate(above, bone);
        store_place(select(fast, place, load_place<Lanes>(now.position[joint], lane)), now.position[joint],
                    lane);
    }
}

void limit_here(const Gait& gait, size_t begin, size_t end, float dt, const PoseBlock* before,
                PoseBlock* now) {
    for (size_t b = begin; b < end; ++b) {
        for (size_t lane = 0; lane < k_block; lane += lane_count()) {
            Lanes running;
            load(running, gait.blocks[b].running + lane);
            Limit limit =
                half_turn(mixed(Lanes(k_fastest_walking), Lanes(k_fastest_running), running) * Lanes(dt));
            Lanes farthest = root(Lanes(2.0f) - limit.cosine - limit.cosine);
            Lanes pelvis = chord(before[b], now[b], hips, lane);
            for (size_t leg : {left_upper_leg, right_upper_leg}) {
                Lanes above = pelvis;
                auto fast = Lanes(0.0f) > Lanes(0.0f);
                for (size_t joint = leg; joint < leg + 4; ++joint) {
                    Lanes self = chord(before[b], now[b], joint, lane);
                    auto may_be = above + self > farthest;
                    if (any(may_be)) {
                        size_t parent = joint == leg ? size_t{hips} : joint - 1;
                        Lanes d = absolute(dot(against_parent(before[b], joint, parent, lane),
                                               against_parent(now[b], joint, parent, lane)));
                        fast = fast | (may_be & (d < limit.cosine));
                    }
                    above = self;
                }
                if (any(fast)) slow_leg(gait.people[b], before[b], now[b], leg, lane, fast, limit);
            }
        }
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(limit_here);

void limit_joint_speeds(const Gait& gait, size_t begin, size_t end, float dt,
                        const std::vector<PoseBlock>& before, std::vector<PoseBlock>& now) {
    HWY_DYNAMIC_DISPATCH(limit_here)(gait, begin, end, dt, before.data(), now.data());
}

}  // namespace flaneur
#endif
