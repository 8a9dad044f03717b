#include "sim/loose_canes.h"

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/world.h"

namespace flaneur {

namespace {

// Where a hand holds a cane.
Vec3 palm_at(const World& w, uint32_t walker, const JointPose& hand) {
    constexpr Vec3 k_palm{-0.006f, -0.049f, 0.014f};  // of the height, from the wrist
    const float height = w.gait.people[walker / k_block].height[walker % k_block];
    return hand.position + rotate(hand.rotation, k_palm * height);
}

}  // namespace

void step_cane(World& w, const Fall& f) {
    const Cane* cane = own_of(w.gait.canes, f.walker);
    if (!cane || f.phase == FallPhase::sways) return;
    LooseRod* rod = own_of(w.falls.rods, f.walker);
    const JointPose hand = joint_pose(w.poses, f.walker, right_hand);
    const Vec3 palm = palm_at(w, f.walker, hand), tip = hand.position + rotate(hand.rotation, cane->tip_hs);
    if (!rod) {
        const JointPose was = joint_pose(w.previous_poses, f.walker, right_hand);
        LooseRod loose{.walker = f.walker, .length = length(tip - palm)};
        loose.grip = palm_at(w, f.walker, was);
        loose.tip = loose.tip_before = was.position + rotate(was.rotation, cane->tip_hs);
        loose.turn = was.rotation;
        rod = &*w.falls.rods.insert(take_away(w.falls.rods, f.walker), loose);
    }
    const Vec3 hangs = normalize_or(tip - palm, {0, -1, 0}),
               in_hand = rotate(conjugate(hand.rotation), hangs);
    const bool is_standing_up = f.phase == FallPhase::rises && f.stage >= RiseStage::stand;
    if (is_standing_up) {
        const float t = f.stage == RiseStage::done ? 1 : smoothstep(0, 1, f.share);
        const float by = t < 1 ? (t - rod->share) / (1 - rod->share) : 1;
        rod->share = t;
        point_rod(*rod, w.around, palm, hangs, by);
        turn_rod(*rod, in_hand);
        rod->turn = nlerp(rod->turn, hand.rotation, by);
        return;
    }
    rod->share = 0;
    swing_rod(*rod, w.around, palm, k_tick);
    turn_rod(*rod, in_hand);
}

}  // namespace flaneur
