// How far joints of people turn.
#pragma once

#include "sim/pose/joint_limits.h"

namespace flaneur {

// Angles of a joint against its parent, degrees; see JointLimits.
struct JointAngles {
    float bend = 0, side = 0, twist = 0;
};
JointAngles joint_angles(Joint joint, Quat parent, Quat child);

// Degrees by which the angles exceed what people reach, 0 within. The hips turn freely.
float beyond_limits(Joint joint, const JointAngles& angles);

}  // namespace flaneur
