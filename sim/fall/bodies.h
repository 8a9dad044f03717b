// Bodies on the ground that are in each other's way.
#pragma once

#include "sim/fall/body_pose.h"
#include "sim/fall/tumble.h"

namespace flaneur {

// A body as others meet it: capsules between its balls.
struct BodyInTheWay {
    std::array<Vec3, k_ball_count> balls;  // in the world
    std::array<float, k_ball_count> radius;
};

// Where a ball comes nearest to trunk, head, arms and legs of a body.
struct Nearest {
    float clear = 1e6f;    // metres between both; negative: in each other
    Vec3 normal{0, 1, 0};  // out of the body, unit
    Vec3 touches{};        // on its skin
};
Nearest nearest_to(const BodyInTheWay& body, Vec3 ball, float radius);

// What balls of the lane are near of such a body they meet as a wall, instead of one that is farther. Who is
// below another is not pressed down by it: the upper one alone gives way.
void meet_body(TumblePlanes& planes, int lane, const TumbleBlock& block, const TumbleShapes& shapes,
               Vec3 origin, const BodyInTheWay& body);

// Whether trunk, head or thighs of the upper body lie on the lower one.
bool lies_on(const BodyInTheWay& upper, const BodyInTheWay& lower);

}  // namespace flaneur
