// Bodies that lean with the back at a wall.
#pragma once

#include "sim/pastimes/seated.h"

namespace flaneur {

// A wall behind somebody: a place on it, and where it faces, unit.
struct WallBehind {
    Vec3 at;
    Vec2 out;
};

// `share` of the way, 0..1, from the pose in which one stands before a wall, whose feet are where `stands`
// says, to one whose back and hips are at it. `foot`: one of them is set against the wall, the left one of
// posture 0 and the right one of 1; of others both stay on the ground.
BodyPose leaning_back(const BodyPose& standing, const FootAt (&stands)[2], Someone who,
                      const WallBehind& wall, uint32_t foot, float share);

}  // namespace flaneur
