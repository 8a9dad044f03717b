#include "sim/without.h"

#include <cstring>

#include "sim/base/math.h"
#include "sim/pose/bare.h"
#include "sim/pose/cane.h"
#include "sim/pose/pram.h"

namespace flaneur {
namespace {

constexpr size_t k_blocks_a_chunk = 4;

void copy_joints(const PoseBlock& from, int first, int last, PoseBlock& to) {
    const size_t count = static_cast<size_t>(last - first + 1);
    std::memcpy(to.position[first], from.position[first], count * sizeof from.position[0]);
    std::memcpy(to.rotation[first], from.rotation[first], count * sizeof from.rotation[0]);
}

}  // namespace

static void pose_by_curves(const World& w, const std::vector<LimbClock>& clocks,
                           std::vector<PoseBlock>& poses) {
    parallel_for(*w.workers, poses.size(), k_blocks_a_chunk, [&](size_t begin, size_t end, int) {
        pose_by_curves(w.gait, begin, end, w.crowd.march.how, clocks, w.around, w.poses, poses);
    });
}

static void pose_bare(const World& w, Techniques on, std::vector<PoseBlock>& poses) {
    parallel_for(*w.workers, poses.size(), k_blocks_a_chunk,
                 [&](size_t begin, size_t end, int) { pose_bare(w.gait, begin, end, on, w.poses, poses); });
}

void pose_without(const World& w, Techniques on, std::vector<PoseBlock>& poses,
                  const std::vector<LimbClock>* clocks) {
    static_assert(hips == 0 && spine == 1 && left_upper_leg == right_hand + 1 &&
                  right_toes == k_joint_count - 1);
    const bool own_legs = on.gait && on.feet && on.soles && on.heels && on.pelvis && on.limits;
    const bool own_trunk = on.gait && on.pelvis && on.trunk && on.look && on.walls && on.holds && on.canes &&
                           on.prams && on.idles;
    poses.resize(w.poses.size());
    if (on.gait) {
        pose_bare(w, on, poses);
    } else if (clocks) {
        pose_by_curves(w, *clocks, poses);
    } else {
        std::vector<LimbClock> now;
        start_clocks(w.gait, w.crowd.march.how, now);
        pose_by_curves(w, now, poses);
    }
    if (!own_trunk) {
        if (on.idles) apply_plays(w.idles, 0, w.idles.plays.size(), poses);
        if (on.canes) hold_canes(w.gait, 0, w.gait.canes.size(), poses);
        if (on.prams) hold_prams(w.gait, 0, w.gait.prams.size(), poses);
    }
    for (size_t n = 0; n < poses.size(); ++n) {
        if (own_legs) copy_joints(w.poses[n], left_upper_leg, right_toes, poses[n]);
        if (own_trunk) copy_joints(w.poses[n], spine, right_hand, poses[n]);
    }
}

static void bring_clocks(Without& without, const World& w) {
    if (without.on.gait || (without.clocks_tick == w.tick && !without.clocks.empty())) return;
    const LimbCurves& how = w.crowd.march.how;
    const bool follows = without.clocks_tick + 1 == w.tick && without.clocks.size() == w.gait.blocks.size();
    if (follows)
        parallel_for(*w.workers, without.clocks.size(), k_blocks_a_chunk, [&](size_t begin, size_t end, int) {
            advance_clocks(w.gait, begin, end, how, k_tick, without.clocks);
        });
    else
        start_clocks(w.gait, how, without.clocks);
    without.clocks_tick = w.tick;
}

void keep_previous(Without& without, const World& world) {
    if (is_whole(without)) return;
    bring_clocks(without, world);
    pose_without(world, without.on, without.previous, &without.clocks);
    without.tick = world.tick;
}

void catch_up(Without& without, const World& world) {
    if (is_whole(without)) return;
    bring_clocks(without, world);
    pose_without(world, without.on, without.poses, &without.clocks);
    if (without.tick + 1 != world.tick || without.previous.size() != without.poses.size())
        without.previous = without.poses;
}

JointPose joint_between(const Without& without, size_t walker, Joint joint, float between) {
    return joint_between(without.previous, without.poses, walker, joint, between);
}

}  // namespace flaneur
