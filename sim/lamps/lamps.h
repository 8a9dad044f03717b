// Traffic lights: when who has green. A junction's lamps share a cycle; each of its directions drives in a
// stage of its own, and people walk over a carriageway in the stage after that of those who drive on it. All
// of it follows from the tick and the plan; nothing is kept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/rng.h"

namespace flaneur {

// All times of plans are whole numbers of so many ticks, in which lamps are drawn.
inline constexpr uint32_t k_lamp_ticks = 4;
// Metres a second that people are given to clear a carriageway after their green (Knoblauch et al. 1996: 85
// of 100 of all ages are faster).
inline constexpr float k_clearing_speed = 1.2f;

// Of a carriageway and the crossing over it; ticks of its cycle, each below `cycle`.
struct LampPlan {
    uint32_t cycle = 0;
    uint32_t shift = 0;                  // ticks that it is ahead of the world's
    uint32_t walk = 0, walk_ends = 0;    // people's green begins, and ends
    uint32_t drive = 0, drive_ends = 0;  // that of those who drive; then amber
    bool operator==(const LampPlan&) const = default;
};
inline constexpr uint32_t k_amber = 180;  // ticks

enum class Light : uint8_t { red, amber, green };

struct Lamp {
    Light light = Light::red;
    uint32_t since = 0;  // ticks that it has been so; 0 in the first
    uint32_t left = 0;   // ticks until it changes; at least 1
};
// What people see who walk over the carriageway, and those who drive on it: at the stop line before the
// crossing.
Lamp lamp_at(const LampPlan& plan, uint32_t tick);
Lamp lamp_of_drivers(const LampPlan& plan, uint32_t tick);

// Ticks between people's green and that of those who drive.
uint32_t clearance(const LampPlan& plan);

// The plans of a junction's directions, one for each: `breadths` are the widest carriageways of each, metres,
// at most 24. With a single one people stop all who drive. Cycles are of 60 to 90 s, by chance, and so is
// where they begin.
std::vector<LampPlan> plan_junction(std::span<const float> breadths, RandomKey key);

}  // namespace flaneur
