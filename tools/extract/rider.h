// Who rides a bicycle: a person of the crowd's kinds, set onto it.
#pragma once

#include "assets/props/vehicles.h"
#include "sim/pose/pose.h"

namespace flaneur {

// How one sits on it.
struct Ride {
    Vec3 at;               // of the bicycle: the middle of the ground below,
    Quat turn;             // and how it is turned
    float crank = 0;       // angle of its left pedal, 0 ahead, growing as it goes on, radians
    float stands = 0;      // 0..1: with one foot on the ground
    bool on_left = false;  // which
};
// Writes k_joint_count poses: sits on the saddle, holds the grips, treads the pedals.
void ride(const Body& body, const Ride& how, JointPose* joints);

}  // namespace flaneur
