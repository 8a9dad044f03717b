// One person walked over ground made for it, and everything about it written down each tick.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "sim/body/body.h"
#include "sim/gait/gait.h"
#include "sim/ground/ground.h"
#include "sim/pose/pose.h"

namespace flaneur {

struct FootInstant {
    Sole sole;
    float ground[3] = {};  // height under heel, ball and tip; the point's own where there is none
    bool swinging = false;
};

// A foot of the pose as it is now.
FootInstant foot_instant(const Ground& ground, const Gait& gait, const std::vector<PoseBlock>& poses,
                         size_t walker, Side side);

struct Instant {
    Vec3 root;
    Vec2 velocity;
    float heading = 0;
    std::array<JointPose, k_joint_count> joints;
    FootInstant feet[2];
};

inline Vec3 place(const Instant& now, Joint joint) { return now.joints[joint].position; }

// Joints of one side.
struct LimbJoints {
    Joint upper_leg, lower_leg, foot, upper_arm, lower_arm, hand;
};
inline constexpr LimbJoints k_limbs[2] = {
    {left_upper_leg, left_lower_leg, left_foot, left_upper_arm, left_lower_arm, left_hand},
    {right_upper_leg, right_lower_leg, right_foot, right_upper_arm, right_lower_arm, right_hand}};

struct Walk {
    Body body;
    double rate = 60;  // ticks a second
    std::vector<Instant> ticks;
    uint64_t hash = 0;  // of every pose: equal for equal walks on any machine
};

// A strip of ground 20 m wide along +z whose height changes at `edges`: between two of them it lies level at
// the height of its middle (`stepped`) or runs straight from one end's height to the other's.
Ground strip(const std::function<float(float z)>& height, const std::vector<float>& edges, bool stepped,
             Surface kind = Surface::sidewalk);

// Who walks: a body and its manner.
struct Person {
    Body body;
    Manner manner;
};

// The velocity, m/s on the ground plane, that the person would like at a time. Legs follow it as fast as they
// can (next_motion).
using Wish = std::function<Vec2(double time)>;

// Walks for `seconds` from (0, 0), facing +z.
Walk walk(const Ground& ground, const Person& person, double seconds, const Wish& wish);

}  // namespace flaneur
