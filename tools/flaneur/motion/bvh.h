// Motions as BVH files, which animation programs open.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/motion/motion.h"

namespace flaneur {

// The skeleton of a body, joint by joint under its parent as it stands in the canonical pose, arms hanging,
// feet on the ground, and a frame for each of `ticks`. Metres, y up, facing +z; toes end at the tip of the
// sole, which lies on the ground. Angles in degrees about z, x and y, in this order, against the parent; they
// go on from frame to frame, beyond 180 too, so that one may take values between. The hips have a place too.
// `rate`: frames a second. Format: Biovision's hierarchy, as Meredith & Maddock, Motion capture file formats
// explained (2001), tell it.
std::string bvh_text(const Body& body, const std::vector<JointPoses>& ticks, double rate);

}  // namespace flaneur
