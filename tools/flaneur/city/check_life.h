// How the street lives, held against what is known of people: who goes with whom, waits at lamps, sits, lines
// up and uses a phone, and that nobody is hit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/world.h"
#include "tools/flaneur/city/check.h"

namespace flaneur {

// Whether anything of it is on in a world: then its people have to be moved with all that they are.
bool is_lively(const World& world);

// What has been seen so far.
struct LifeTally {
    uint64_t looks = 0, people = 0, in_groups = 0, on_phones = 0, sitting = 0;
    uint64_t groups[5] = {};             // by size
    std::vector<float> speeds[5];        // m/s, of who walks, by the size of its group
    std::vector<float> abreast, ahead;   // metres, in pairs who walk side by side
    std::vector<float> at_kerb;          // metres from the next one who waits there
    std::vector<float> starts;           // seconds after green
    std::vector<float> in_line;          // metres from one in a line to the next
    std::vector<float> sat;              // minutes that those who sit down stay
    std::vector<float> standing, rings;  // metres to the nearest other in a circle of those who talk
    float hands = 0;                     // metres between palms that hold each other, at most
    float hit = -1;                      // metres that a vehicle was in a body, at most
    uint64_t crashes = 0;                // looks at two vehicles that were in each other
    std::vector<uint32_t> waited;        // by walker: the kerb at which it waited at the last look, and
    std::vector<uint32_t> sat_since;     // since which tick it sits
};

// Looks at a world between two ticks.
void look_at_life(const World& world, LifeTally& tally);

// As figures with bands; of what is off none. Sources: docs/life.
std::vector<Finding> life_findings(const World& world, LifeTally& tally);

}  // namespace flaneur
