#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/pose.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/pose/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

void pose_blocks_here(const Gait& gait, size_t begin, size_t end, float dt, const PoseBlock* before,
                      PoseBlock* poses) {
    for (size_t b = begin; b < end; ++b) {
        for (size_t lane = 0; lane < k_block; lane += lane_count()) {
            pose_chunk<Lanes>(gait.blocks[b], gait.people[b], dt, before ? &before[b] : nullptr, poses[b],
                              lane);
        }
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(pose_blocks_here);

void pose_blocks(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                 std::vector<PoseBlock>& poses) {
    HWY_DYNAMIC_DISPATCH(pose_blocks_here)(gait, begin, end, dt, before.data(), poses.data());
}

void pose_blocks(const Gait& gait, size_t begin, size_t end, std::vector<PoseBlock>& poses) {
    HWY_DYNAMIC_DISPATCH(pose_blocks_here)(gait, begin, end, 0, nullptr, poses.data());
}

JointPose joint_pose(const std::vector<PoseBlock>& poses, size_t walker, Joint joint) {
    const PoseBlock& b = poses[walker / k_block];
    size_t lane = walker % k_block;
    const auto& p = b.position[joint];
    const auto& q = b.rotation[joint];
    const auto& o = b.origin;
    return {{o[0][lane] + p[0][lane], o[1][lane] + p[1][lane], o[2][lane] + p[2][lane]},
            {q[0][lane], q[1][lane], q[2][lane], q[3][lane]}};
}

JointPose joint_between(const std::vector<PoseBlock>& before, const std::vector<PoseBlock>& last,
                        size_t walker, Joint joint, float between) {
    const JointPose a = joint_pose(before, walker, joint), b = joint_pose(last, walker, joint);
    return {lerp(a.position, b.position, between), nlerp(a.rotation, b.rotation, between)};
}

Sole sole(const std::vector<PoseBlock>& poses, const Gait& gait, size_t walker, Side side) {
    const PersonBlock& person = gait.people[walker / k_block];
    size_t lane = walker % k_block;
    Joint foot_joint = side == k_left ? left_foot : right_foot;
    Joint toes_joint = side == k_left ? left_toes : right_toes;
    JointPose foot = joint_pose(poses, walker, foot_joint), toes = joint_pose(poses, walker, toes_joint);
    float ankle_height = person.joints[foot_joint][1][lane], ball_height = person.joints[toes_joint][1][lane];
    Vec3 ball = toes.position + rotate(toes.rotation, Vec3{0, -ball_height, 0});
    return {foot.position + rotate(foot.rotation, Vec3{0, -ankle_height, -person.heel[lane]}), ball,
            ball + rotate(toes.rotation, Vec3{0, 0, person.toe[lane]})};
}

}  // namespace flaneur
#endif
