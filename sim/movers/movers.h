// Rigid things that move and that nobody is: planks of a bridge that sways, platforms, a leaf of a door, what
// people carry. Plain data: solids, and where they are. A thing goes by itself, its place and its turn being
// functions of the tick, or is led by whoever writes its placement each tick.
//
//     Movers movers = make_movers({swaying_platform, box});     // as plain Mover structs
//     for (uint32_t tick = 0;; ++tick) {
//         step_movers(movers, tick);                            // those that go by themselves
//         movers.places[1] = {hand, turn};                      // one that is led
//     }
//
// Drawn by add_movers() of tools/extract/extract.h, between ticks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/base/vec.h"
#include "sim/ground/surroundings.h"
#include "sim/movers/sway.h"

namespace flaneur {

// What a solid is of, for whoever draws it.
enum class Matter : uint8_t { wood, dark_wood, stone, steel, rope, cardboard, paint };
inline constexpr int k_matter_count = 7;

// A box or an upright cylinder, in the thing's own frame, turned about its middle. Of a box `half` is half
// its edges; of a cylinder, whose axis is its y, half.y is half its height, half.x and half.z its radius.
struct MoverSolid {
    enum class Form : uint8_t { box, cylinder };
    Form form = Form::box;
    Vec3 middle{}, half{0.5f, 0.5f, 0.5f};  // metres
    Quat turn{};
    Matter matter = Matter::wood;
    float shade = 1;    // of the matter's colour, 0..1.5
    bool bears = true;  // whether feet stand on it: see mover_below()
    bool operator==(const MoverSolid&) const = default;
};

// Where a frame is and how it is turned.
struct Placement {
    Vec3 position{};
    Quat turn{};
};
inline Vec3 to_world(const Placement& p, Vec3 own) { return p.position + rotate(p.turn, own); }
inline Vec3 to_own(const Placement& p, Vec3 world) { return rotate(conjugate(p.turn), world - p.position); }
// Between two ticks; `between` 0 is `before`, 1 `last`.
Placement placement_between(const Placement& before, const Placement& last, float between);

struct Mover {
    // What moves it: two functions of the tick; whoever leads it.
    enum class Kind : uint8_t { by_itself, led };
    std::string name;
    Kind kind = Kind::by_itself;
    std::vector<MoverSolid> solids;
    Sway place;          // of one by itself, metres
    Sway angles;         // the same, radians: about y, then about the turned z, then about the turned x
    Placement at_first;  // of one that is led
};
// Of one that goes by itself.
Placement placement_at(const Mover& mover, uint32_t tick);

struct Movers {
    std::vector<Mover> all;
    std::vector<float> radius;                       // of each: of a ball about its origin that holds it
    std::vector<Placement> places, previous_places;  // after the last tick and the one before
};

Movers make_movers(std::vector<Mover> all);
// Those that go by themselves are where they shall be after tick `tick`; those that are led stay where they
// are until they are written anew. Allocates nothing.
void step_movers(Movers& movers, uint32_t tick);
// After the places of a saved state were read.
void forget_previous(Movers& movers);

// What bears a point from below.
struct MoverHit {
    uint32_t mover = 0;
    Vec3 point, normal;  // in the world
};
// The highest top of a solid that bears, between `up` metres above the point and `down` below it. Tops that
// are steeper than 60 degrees bear nobody.
std::optional<MoverHit> mover_below(const Movers& movers, Vec3 point, float up, float down);

// A ground with movers on it, for who asks `Surroundings`: the higher of both. Walls are the ground's alone.
// Both must outlive what asks.
struct MovingGround {
    const Ground* ground = nullptr;
    const Movers* movers = nullptr;
};
Surroundings surroundings_of(const MovingGround& ground);

}  // namespace flaneur
