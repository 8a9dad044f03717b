// What no body does: joints beyond their limits or with a jerk, a pelvis that falls faster than freely.
#pragma once

#include <cstdint>

#include "sim/pose/joint_limits.h"
#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

// Angles of a joint against its parent, degrees; see JointLimits.
struct JointAngles {
    float bend = 0, side = 0, twist = 0;
};
JointAngles joint_angles(Joint joint, Quat parent, Quat child);

// Degrees by which the angles exceed what people reach, 0 within. The hips turn freely.
float beyond_limits(Joint joint, const JointAngles& angles);

// Degrees between two rotations.
float angle_between(Quat a, Quat b);

// The worst of the ticks from `first` on and before `last`, each from one tick to the next: the fastest turn
// of a joint against its parent, the most that one is beyond its limits, how fast the head goes up or down,
// and with what acceleration the pelvis falls while a foot stands.
Quantities measure_body(const Walk& walk, size_t first, size_t last = SIZE_MAX);

}  // namespace flaneur
