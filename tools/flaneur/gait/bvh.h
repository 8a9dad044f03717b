// Motions as BVH files, which animation programs open.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/body/body.h"
#include "sim/pose/pose.h"

namespace flaneur {

using JointPoses = std::array<JointPose, k_joint_count>;  // in the world

// The skeleton of a body, joint by joint under its parent as it stands in the canonical pose, and a frame for
// each of `ticks`. Metres, y up, facing +z; angles in degrees about z, x and y, in this order, against the
// parent; the hips have a place too. `rate`: frames a second. Format: Biovision's hierarchy, as Meredith &
// Maddock, Motion capture file formats explained (2001), tell it.
std::string bvh_text(const Body& body, const std::vector<JointPoses>& ticks, double rate);

}  // namespace flaneur
