// People who come to a floor, walk where they are told and leave it, all by the library's door (sim/sim.h).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/result.h"
#include "sim/sim.h"
#include "tools/flaneur/validate/arena.h"

namespace flaneur {

inline constexpr float k_east = k_pi / 2;  // a heading: along +x

struct Guest {
    Vec3 from, goal;
    Rectangle exit{{1, 1}, {0, 0}};  // who is in it has left; this one is nowhere
    float speed = 1.34f;             // m/s that it likes; 0: as people of its kind do
    float heading = 0;
    float enters = 0;  // seconds: set down then, or when there is room,
    float starts = 0;  // and told to go, not before it is there
    Vec2 velocity{};   // m/s, with which it is set down
    std::optional<uint32_t> kind{};
};

// Seconds; none: that never happened.
struct GuestFate {
    std::optional<float> entered, moved, left;  // moved: faster than k_moving
};
inline constexpr float k_moving = 0.2f;  // m/s

struct PlayOptions {
    float seconds = 60;         // at most: it ends when all have left
    uint32_t sample_ticks = 0;  // between two frames of `tracks`; divides 60; 0: none
    uint64_t seed = 1;
    std::vector<Kind> kinds{{standard_body(1.72f)}};
    // Before each tick, with those who are there, in the order of the guests; gone ones have the id that they
    // had.
    std::function<void(World&, std::span<const WalkerId>)> before_tick{};
};

struct Play {
    std::vector<GuestFate> fates;  // one a guest
    Trajectories tracks;           // ids are guests' places in the list
    float seconds = 0;             // how long it took
};

// Fails where the floor cannot be walked on, where somebody can never be set down, and when the program is
// asked to stop.
Result<Play> play(const Arena& arena, std::span<const Guest> guests, const PlayOptions& options);

// When the last one left; none: somebody is still there.
std::optional<float> last_left(const Play& play);
size_t count_left(const Play& play);

// So many people over a rectangle, on a lattice as dense as that needs, each moved a little by chance: never
// nearer to another than a body's width. Fewer, where bodies of k_body_width do not fit so densely.
inline constexpr float k_body_width = 0.5f;
std::vector<Vec2> spread(const Rectangle& over, size_t count, uint64_t seed);

// What people like to walk at, 1.34 +- 0.26 m/s, within 0.8 .. 1.9.
float weidmann_wish(uint64_t seed, uint32_t number);

}  // namespace flaneur
