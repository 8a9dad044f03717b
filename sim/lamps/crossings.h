// Where people cross carriageways: strips between two kerbs, and the lamp that rules each, if one does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"
#include "sim/lamps/lamps.h"

namespace flaneur {

inline constexpr uint32_t k_no_lamp = ~0u;

// A parallelogram on the ground. Kerb 0 is at `over` = -half_length, kerb 1 at +half_length; those who drive
// go along `along`, either way, and stop before the strip, at a line `half_width` and a bit more from its
// middle.
struct Crossing {
    Vec3 centre;                // on the ground, metres
    Vec2 across{0, 1};          // unit: how people go, from kerb 0 to kerb 1
    Vec2 along{1, 0};           // unit: the carriageway and its kerbs; not parallel to `across`
    float half_length = 3.5f;   // metres along `across`, from the middle to a kerb
    float half_width = 2;       // metres along `along`
    uint32_t plan = k_no_lamp;  // index into Crossings::plans
};

struct Crossings {
    std::vector<Crossing> all;
    std::vector<LampPlan> plans;
};
inline bool is_ruled(const Crossing& crossing) { return crossing.plan != k_no_lamp; }

// A place against a crossing: metres along `across` and `along` from its middle.
struct OnCrossing {
    float over = 0, aside = 0;
};
OnCrossing on_crossing(const Crossing& crossing, Vec2 place);

// A kerb: its number is twice that of its crossing, and one more for kerb 1. Metres from it towards the
// carriageway, along `across`: negative on the pavement.
inline float beyond_kerb(const Crossing& crossing, uint32_t kerb, OnCrossing at) {
    return (kerb % 2 == 0 ? at.over : -at.over) + crossing.half_length;
}
// The way over the carriageway from it, a unit.
inline Vec2 way_over(const Crossing& crossing, uint32_t kerb) {
    return kerb % 2 == 0 ? crossing.across : -crossing.across;
}
// The place `back` metres behind the kerb, square to it, and `aside` along it.
Vec2 behind_kerb(const Crossing& crossing, uint32_t kerb, float back, float aside);

// Gives crossings lamps, those of which `ruled` (one each) is not 0. Those within 26 m of each other, or of
// one that is within 26 m of another, are of one junction; carriageways that run the same way within 45
// degrees share a direction.
void set_lamps(Crossings& crossings, std::span<const uint8_t> ruled, uint64_t seed);
// Takes them away.
void take_lamps(Crossings& crossings);

// The ruled crossing whose lamp a post at `place` would bear, the nearest of those with an end within 6 m;
// k_no_lamp: none.
uint32_t crossing_of_post(const Crossings& crossings, Vec3 place);

// The ruled crossings near a place, by squares of the ground plane: all whose strip, or a pavement beside
// one, is within `k_kerb_reach` metres.
inline constexpr float k_kerb_reach = 6;
struct CrossingGrid {
    Vec2 low;
    int width = 0, height = 0;  // squares
    std::vector<uint32_t> first, items;
};
CrossingGrid make_crossing_grid(const Crossings& crossings);
std::span<const uint32_t> crossings_near(const CrossingGrid& grid, Vec2 place);

}  // namespace flaneur
