// How far joints of people turn.
#pragma once

#include "sim/pose/body.h"

namespace flaneur {

// Angles of a joint against its parent, degrees, both sides alike. Legs and arms hang, and `bend` carries
// them forward and `side` outward; trunk, neck and head stand, and bend forward and to their left; feet and
// toes point ahead, and bend up and outward; the inner ends of the clavicles point outward, and bend forward
// and up. `twist` is about the part's own length. Knees and elbows have only a bend, which is the whole angle
// between both bones, negative for a knee that bends as knees do, and a twist.
struct JointAngles {
    float bend = 0, side = 0, twist = 0;
};
JointAngles joint_angles(Joint joint, Quat parent, Quat child);

// Degrees by which the angles exceed what people reach, 0 within. The hips turn freely.
float beyond_limits(Joint joint, const JointAngles& angles);

}  // namespace flaneur
