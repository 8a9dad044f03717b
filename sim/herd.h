// Creatures of six legs among the people of a city. Each goes as one of the crowd, which has its ways, its
// errands and whom it meets; nobody draws the person's body. Its feet find pavements, kerbs, steps and walls
// by rays, as on a small world.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/result.h"
#include "sim/creature/creature.h"
#include "sim/surface/surface_walk.h"

namespace flaneur {

struct World;

struct Herd {
    SurfaceWalkers walkers;           // one for each creature, where the crowd has it
    std::vector<Creature> creatures;  // their joints are linkages' places, the first linkages' of the world
    std::vector<uint32_t> goes_as;    // by creature: the walker, one after the other
};

// Sets so many creatures of 0.7 to 1.1 m down among the people, as the walkers that come next, and makes the
// world's linkages theirs. Refuses what finds no room.
Result<void> set_loose(World& world, uint32_t creatures);

inline bool is_creature(const Herd& herd, uint32_t walker) {
    return !herd.goes_as.empty() && walker - herd.goes_as.front() < herd.goes_as.size();
}

// Before the crowd's tick: a creature goes nowhere where it would be out of sight.
void keep_herd(World& world);
// After it: bodies and feet.
void step_herd(World& world);

}  // namespace flaneur
