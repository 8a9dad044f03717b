// Over a low wall, by key poses and inverse kinematics: where hips, feet and hands are at moments of the way,
// in the wall's own frame, and smooth curves between them on which nothing that stands moves. A low one is
// stepped over with a hand on it; on a higher one both hands lean, a leg goes over, one sits astride, the
// other leg follows, and one slides down.
#pragma once

#include <array>

#include "sim/deeds/goal.h"

namespace flaneur {

// Of legs, walls up to which one steps over, and up to which one climbs at all.
inline constexpr float k_steps_over = 0.62f, k_highest_wall = 1.4f;

// Where one stands before a wall; `onward`: along its heading, else against it.
Spot before_wall(const Deeds& deeds, size_t doer, const LowWall& wall, bool onward);
// Seconds that one is on the way over.
float climb_seconds(const Deeds& deeds, size_t doer, const LowWall& wall);

// What one wishes who climbs; goes from stage to stage, and takes the root over.
DoerWish climb(Deeds& deeds, size_t doer);
// The body of one who climbs. `pose` is the gait's.
void pose_climbing(const Deeds& deeds, size_t doer, BodyPose& pose);

// What rests on the wall now, for checks and views: hands that lean on it, and feet that stand on the ground.
struct ClimbHolds {
    bool hands[2] = {}, feet[2] = {};
    Vec3 palms[2];  // where hands lean
};
ClimbHolds climb_holds(const Deeds& deeds, size_t doer);

}  // namespace flaneur
