// Balls that are thrown: they fly, bounce off the ground and off walls, and roll until they lie.
//
//     std::vector<Ball> balls{{.place = {0, 1.6f, 0}, .velocity = {0, 2, 9}}};
//     for (;;) step_balls(balls, ground, around, k_tick);
#pragma once

#include <cstdint>
#include <span>

#include "sim/ball/planned_throw.h"
#include "sim/base/vec.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

inline constexpr uint32_t k_most_balls = 32;   // of a world
inline constexpr float k_ball_radius = 0.14f;  // metres

struct Ball {
    Vec3 place{}, velocity{};  // of its middle, metres and m/s
    Quat turn{};
    float mass = k_ball_mass, radius = k_ball_radius;
};

// How a ball leaves that is thrown so: straight at what it is to pass, and so much higher as it falls on the
// way. Where it is too slow to get there, upwards by 45 degrees.
Ball thrown(const PlannedThrow& how);

// So many seconds of all of them, who also hit each other. `ground` is what stops them, `around` what bears
// them as well (things that move).
void step_balls(std::span<Ball> balls, const Ground& ground, const Surroundings& around, float dt);

// What a ball and somebody whom it meets give each other: `normal` from him to it, unit, `other` his velocity
// and `mass` what of him it has to move. Returns the newton seconds that he gets, along -normal; 0 where they
// part already.
float hit(Ball& ball, Vec3 normal, Vec3 other, float mass);

}  // namespace flaneur
