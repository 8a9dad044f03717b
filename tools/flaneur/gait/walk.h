// One person walked over ground made for it, and everything about it written down each tick.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "sim/city/city.h"
#include "sim/gait/gait.h"
#include "sim/pose/body.h"
#include "sim/pose/pose.h"

namespace flaneur {

struct FootInstant {
    Sole sole;
    float ground[3] = {};  // height under heel, ball and tip; the point's own where there is none
    bool swinging = false;
};

struct Instant {
    Vec3 root;
    Vec2 velocity;
    float heading = 0;
    std::array<JointPose, k_joint_count> joints;
    FootInstant feet[2];
};

// What the legs are asked for.
struct Wish {
    float speed = 0;      // m/s
    float turn_rate = 0;  // rad/s
};

struct Walk {
    Body body;
    double rate = 60;  // ticks a second
    std::vector<Instant> ticks;
};

// A strip of ground 20 m wide along +z whose height changes at `edges`: between two of them it lies level at
// the height of its middle (`stepped`) or runs straight from one end's height to the other's.
City strip(const std::function<float(float z)>& height, const std::vector<float>& edges, bool stepped);

// Walks for `seconds` from (0, 0), facing +z. `wish` gives what is asked for at a time; speed and turning
// follow it as fast as legs can.
Walk walk(const City& city, const Body& body, uint64_t style, double seconds,
          const std::function<Wish(double time)>& wish);

}  // namespace flaneur
