// Whether those who stand do so as people do: they are not frozen, do not march on the spot, rock to and fro
// or slide.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/world.h"
#include "tools/flaneur/city/check.h"

namespace flaneur {

// One who has been within k_stands_within metres for so long.
struct Stand {
    bool is = false;
    uint32_t generation = 0, ticks = 0;
    Vec3 from;
    float heading = 0, turned = 0;              // radians
    uint32_t lifts = 0, turns = 0, swings = 0;  // feet lifted; changes of the way it turns, and goes
    float last_turn = 0;                        // radians in a tick
    Vec2 last_velocity{};
    uint32_t quiet = 0, longest_quiet = 0;  // ticks in which no joint has left where it was
    std::array<Vec3, k_joint_count> joints{};
    std::array<Vec3, 2> ankles{}, toes{};
    std::array<bool, 2> swings_foot{};
    float slid = 0;  // metres in a tick, of a foot that stands
};

struct StandingTally {
    std::vector<Stand> stands;  // by walker
    uint64_t all = 0, frozen = 0, march = 0, rock = 0;
    float slid = 0;
};

// Looks at a world after each of its ticks.
void look_at_standing(const World& world, StandingTally& tally);
// Of nobody who stood, none.
std::vector<Finding> standing_findings(const StandingTally& tally);

}  // namespace flaneur
