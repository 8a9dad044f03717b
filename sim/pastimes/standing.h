// Bodies that lean: with the back at a wall, with the hands on a railing.
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

// A railing before somebody: its edge on top, before the middle of the body, and where it faces, outward.
struct RailBefore {
    Vec3 at;
    Vec2 facing;
};

// `share` of the way, 0..1, from the pose in which one stands before a railing, whose feet are where `stands`
// says, to one that leans ahead with both hands on it, more or less apart by `posture`.
BodyPose leaning_out(const BodyPose& standing, const FootAt (&stands)[2], Someone who, const RailBefore& rail,
                     uint32_t posture, float share);

}  // namespace flaneur
