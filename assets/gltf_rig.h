// Finds the humanoid in a skeleton: limbs by their shape and place, names only tip the scale.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/pose/body.h"

namespace flaneur {

// A joint of a skin, in any units and axes. Parents come before children.
struct RigJoint {
    std::string name;
    int parent = -1;
    Vec3 place;
    float mass = 0;  // sum of the weights it has over all vertices
    Vec3 flesh;      // weighted mean place of those vertices
};

inline constexpr int k_not_found = -1;

struct RigMap {
    std::array<int, k_joint_count> joints;  // index of the rig's joint, or k_not_found
    Vec3 left, up, ahead;                   // orthonormal, in the rig's axes
    std::string note;                       // empty, or what was doubtful
};

// Arms, legs and a head are always found; spine, chest, shoulders, neck and toes may be k_not_found. `low`
// and `high` are the corners of the mesh's bounding box. Refuses with the sentence that names what is
// missing.
Result<RigMap> map_rig(const std::vector<RigJoint>& rig, Vec3 low, Vec3 high);

}  // namespace flaneur
