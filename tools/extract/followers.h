// What hangs on people and swings: skirts and coats, bags, loose hair, the ends of scarves. A pure function
// of the pose and of how the body has moved of late.
#pragma once

#include <array>

#include "assets/character.h"
#include "sim/pose/pose.h"
#include "sim/pose/trail.h"

namespace flaneur {

// Whether any of a character moves with followers.
bool has_followers(const Character& character);

// Where a character's followers are, at `scale` times its size in a pose: as if it kept still where there is
// no `trail`. Panels of robes are pushed by the leg that is farther out on their side and fall back after it;
// the rest lags behind what it hangs on, hanging down along the pelvis. What is pushed is where `pram` says,
// or stands ahead of the pelvis on level ground. A stick that lies
// about has its grip where `stick` says, turned like a hand that would hold it so; else the right hand has
// it.
std::array<JointPose, k_follower_count> followers(const Character& character, float scale,
                                                  const JointPose* joints, const Trail* trail,
                                                  const PramPlace* pram = nullptr,
                                                  const JointPose* stick = nullptr);

}  // namespace flaneur
