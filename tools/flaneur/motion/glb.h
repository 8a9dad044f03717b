// Motions as binary glTF files, which animation programs and viewers open.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/motion/motion.h"

namespace flaneur {

// The bytes of a .glb, glTF 2.0: a doll of a block a joint, of the body's proportions, and an animation of
// `ticks`, `rate` a second. Metres, y up, facing +z. The nodes are the joints, under their parents as in the
// canonical pose, arms hanging; at rest the hips are where the motion begins. Quaternions against the parent
// go on from tick to tick without a change of sign. The hips have a place too. `ticks` are not empty.
std::string motion_glb(const Body& body, const std::vector<JointPoses>& ticks, double rate);

}  // namespace flaneur
