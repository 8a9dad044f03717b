// What one walker did, as files of motion tell it (bvh.h, glb.h).
#pragma once

#include <array>

#include "sim/body/body.h"
#include "sim/pose/pose.h"

namespace flaneur {

using JointPoses = std::array<JointPose, k_joint_count>;  // in the world

// The turn of a joint against its parent; of the hips against the world.
Quat own_turn(const JointPoses& poses, size_t joint);

// Where a bone ends that no other joint follows, from its joint, in the canonical pose: the crown, fingers,
// and of toes the tip of the sole, which lies on the ground.
Vec3 bone_end(const Body& body, size_t joint);

// The same body, larger or smaller.
Body scaled_body(const Body& body, float scale);

}  // namespace flaneur
