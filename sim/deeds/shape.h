// How thick people are, for what must not go into things: balls along limbs, trunk and head.
#pragma once

#include <array>

#include "sim/deeds/bend.h"

namespace flaneur {

struct BodyBall {
    Vec3 at;
    float radius = 0;  // metres
    Joint of = hips;   // whose bone it is on; of a shoe the ankle
};

inline constexpr size_t k_leg_balls = 15, k_arm_balls = 10, k_trunk_balls = 14;
// Thigh from below the hip, shank, and the shoe from heel to tip.
using LegBalls = std::array<BodyBall, k_leg_balls>;
LegBalls leg_balls(const BodyPose& pose, Someone who, Side side);
// Upper arm, forearm and hand to the finger tips.
using ArmBalls = std::array<BodyBall, k_arm_balls>;
ArmBalls arm_balls(const BodyPose& pose, Someone who, Side side);
// From hips to neck, shoulders, and the head.
using TrunkBalls = std::array<BodyBall, k_trunk_balls>;
TrunkBalls trunk_balls(const BodyPose& pose, Someone who);

}  // namespace flaneur
