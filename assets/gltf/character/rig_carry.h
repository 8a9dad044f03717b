// Who of the body's joints carries what else the skeleton moves.
#pragma once

#include <vector>

#include "assets/gltf/character/rig.h"
#include "assets/gltf/character/rig_tree.h"

namespace flaneur {

// Turns indices of the tree into those of the rig, and finds who carries what. Returns the share of flesh
// that hangs from no joint that was found.
float settle(const std::vector<RigJoint>& rig, const RigTree& tree, RigMap& map);

}  // namespace flaneur
