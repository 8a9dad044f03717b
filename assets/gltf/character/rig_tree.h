// The part of a skeleton that carries flesh: what limbs are looked for in.
#pragma once

#include <vector>

#include "assets/gltf/character/rig.h"

namespace flaneur {

struct RigTree {
    std::vector<RigJoint> joints;  // parents first
    std::vector<int> original;     // by joint: its index in the rig
    bool whole = true;             // no piece was left out
};

// By joint: 1 where it carries flesh, holds together what does, or ends a chain of it close to the flesh.
std::vector<uint8_t> living_joints(const std::vector<RigJoint>& rig);

// Appends a made-up joint where a chain just stops, at the far end of its last bone's flesh: it tells how
// long that bone is.
void add_ends(std::vector<RigJoint>& rig);

RigTree living_tree(const std::vector<RigJoint>& rig);

// Of a tree whose flesh hangs together by nothing but joints without flesh: trees without these, each piece
// below the bone that it begins at. They differ in the joint at the root, the likeliest first. Where
// pieces lie apart, a tree without them comes before one with them. None where there is one piece only.
std::vector<RigTree> joined_trees(const RigTree& tree, Vec3 low, Vec3 high);

}  // namespace flaneur
