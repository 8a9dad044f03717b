// Which way a body faces: what its feet, names, thumbs, eyes and knees tell, weighed.
#pragma once

#include <array>

#include "assets/gltf/character/limbs.h"

namespace flaneur {

using LegJoints = std::array<int, 4>;  // hip, knee, ankle, and the ball of the foot or k_not_found

struct Facing {
    float sure = 0;         // positive for `ahead`, negative for the way back
    bool feet_tell = true;  // whether its feet point anywhere
};

// Of a body of that height that faces `ahead` or the opposite.
Facing weigh_facing(const Rig& rig, const std::array<LegJoints, 2>& legs, Vec3 up, Vec3 ahead, float height);

}  // namespace flaneur
