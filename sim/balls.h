// The balls of a world, and the people whom they hit.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/ball/ball.h"

namespace flaneur {

struct World;

struct Balls {
    std::vector<Ball> all;
    std::vector<Vec3> previous_places;  // of each, before the last tick
    std::vector<PlannedThrow> planned;
};

// Before ticks that throw some, which then allocate nothing.
void make_room_for_balls(World& world);
// A tick: those that are due are thrown (throw_ball() in sim/sim.h; beyond k_most_balls the oldest is gone),
// all go on, and whom they hit is pushed as much the more as he is hit higher: at the feet hardly, at the
// chest with all that the ball gives.
void step_balls(World& world);

uint64_t hash_balls(const Balls& balls);

}  // namespace flaneur
