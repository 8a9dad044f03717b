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

void pose_without(const World& w, Techniques on, std::vector<PoseBlock>& poses) {
    static_assert(hips == 0 && spine == 1 && left_upper_leg == right_hand + 1 &&
                  right_toes == k_joint_count - 1);
    const bool own_legs = on.feet && on.soles && on.heels && on.pelvis && on.limits;
    const bool own_trunk =
        on.pelvis && on.trunk && on.look && on.walls && on.holds && on.canes && on.prams && on.idles;
    poses.resize(w.poses.size());
    parallel_for(*w.workers, poses.size(), k_blocks_a_chunk,
                 [&](size_t begin, size_t end, int) { pose_bare(w.gait, begin, end, on, w.poses, poses); });
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

void keep_previous(Without& without, const World& world) {
    if (is_whole(without)) return;
    pose_without(world, without.on, without.previous);
    without.tick = world.tick;
}

void catch_up(Without& without, const World& world) {
    if (is_whole(without)) return;
    pose_without(world, without.on, without.poses);
    if (without.tick + 1 != world.tick || without.previous.size() != without.poses.size())
        without.previous = without.poses;
}

JointPose joint_between(const Without& without, size_t walker, Joint joint, float between) {
    JointPose last = joint_pose(without.poses, walker, joint),
              before = joint_pose(without.previous, walker, joint);
    return {lerp(before.position, last.position, between), nlerp(before.rotation, last.rotation, between)};
}

}  // namespace flaneur
