// One who bends down to somebody on the ground and takes a hand.
#pragma once

#include "sim/fall/body_pose.h"

namespace flaneur {

// How far one goes down to reach the hand of another who is on the knees, whose ground is `low` metres above
// one's own.
struct Stoop {
    float crouch = 0;  // metres of the pelvis
    float lean = 0;    // radians of the trunk
};
Stoop stoop_for(const PersonBlock& person, int lane, const PersonBlock& other, int other_lane, float low);

struct Hands {
    Side own = k_right, other = k_right;
    float reach = 0;  // of one's own arm, 0: as it hangs .. 1: out to the other
    float holds = 0;  // of both hands to each other
};
// Reaches with one's arm towards the other's shoulder, and brings both palms together where arms of their
// lengths meet. False if they do not reach.
bool take_hand(BodyPose& pose, const PersonBlock& person, int lane, BodyPose& other,
               const PersonBlock& other_person, int other_lane, const Hands& hands);

}  // namespace flaneur
