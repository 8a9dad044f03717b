// How a body lies, stands or is in the air, joint by joint; as segments that fall, and back.
#pragma once

#include <array>
#include <vector>

#include "sim/fall/segments.h"
#include "sim/fall/tumble.h"
#include "sim/pose/pose.h"

namespace flaneur {

// Rotations take the axes of the canonical pose to the joint's, in the world.
struct BodyPose {
    Vec3 hips;  // in the world
    std::array<Quat, k_joint_count> rotation;
};

BodyPose body_pose_of(const std::vector<PoseBlock>& poses, size_t walker);
// Writes the walker's lane, from an origin below its hips.
void set_body_pose(std::vector<PoseBlock>& poses, const PersonBlock& person, size_t walker,
                   const BodyPose& to);

// Where all joints are.
std::array<Vec3, k_joint_count> places_of(const BodyPose& pose, const PersonBlock& person, int lane);

// Where one of them is: the same, for less.
Vec3 place_of(const BodyPose& pose, const PersonBlock& person, int lane, int joint);

// `t` of the way, 0..1, by the shorter turns of each joint against its parent.
BodyPose mixed(const BodyPose& from, const BodyPose& to, float t);

// How a drawn joint is turned against its segment: segments' elbows and knees bend in planes of their own,
// and one segment may carry several joints.
using Residue = std::array<Quat, k_joint_count>;

// Lane `lane` of a block becomes such a body, moving as from `before` to `now` in `dt` seconds. Places are
// from `origin`.
Residue take_over(TumbleBlock& block, int lane, const Segments& segments, const PersonBlock& person,
                  int person_lane, const BodyPose& before, const BodyPose& now, float dt, Vec3 origin);
// The pose that it has come to.
BodyPose body_pose_of(const TumbleBlock& block, int lane, const Segments& segments, const Residue& residue,
                      Vec3 origin);

// Where the middles of its balls are.
std::array<Vec3, k_ball_count> balls_of(const BodyPose& pose, const Segments& segments,
                                        const PersonBlock& person, int lane);

}  // namespace flaneur
