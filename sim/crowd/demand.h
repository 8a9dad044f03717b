// Where people want to go: by what is there, how far it is, and the time of day.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/rng.h"
#include "sim/base/vec.h"
#include "sim/navigation/navmesh.h"
#include "sim/navigation/weighted_grid.h"

namespace flaneur {

// Where people come from and go to.
enum class DestinationKind : uint8_t { door, shop, bench, stop, edge, square };
inline constexpr int k_destination_count = 6;

inline bool is_entrance(DestinationKind kind) {
    return kind == DestinationKind::door || kind == DestinationKind::shop;
}

struct Destination {
    DestinationKind kind = DestinationKind::door;
    Vec3 position;     // on the ground, where one stands
    Vec2 facing;       // unit, the way one looks there: at the door, off the bench, out of the map
    float weight = 1;  // of its kind: how often it is chosen against others
};

// How many of those who get to a destination of a kind, by DestinationKind, leave the crowd there, 0..1; as
// many come in at such places instead.
using Leaving = std::array<float, k_destination_count>;
inline constexpr Leaving k_nobody_leaves{};
// By judgement: most go home or to work by a door, shops let people out again, and the map ends for good.
inline constexpr Leaving k_usual_leaving{0.8f, 0.3f, 0, 0.7f, 1, 0};

// A destination on the mesh.
struct Attraction {
    NavPoint place;
    Vec2 facing;  // unit: the way one looks there
};

struct Demand {
    float hour = 17.5f;  // of the day, 0..24, when the simulation begins
    Leaving leaving = k_nobody_leaves;
    // By kind, in the order of the grid's items.
    std::vector<Attraction> attractions[k_destination_count];
    WeightedGrid grids[k_destination_count];
};

// Sets destinations on the mesh, which lies between `low` and `high` on the ground plane; those farther than
// 3 m from it are left out, as are those on pieces of mesh too small to walk about in.
Demand make_demand(std::span<const Destination> destinations, Vec2 low, Vec2 high, const Navmesh& mesh,
                   float hour, const Leaving& leaving = k_nobody_leaves);

// How much people want to be at such a place at an hour of the day (0..24, wrapped), against other kinds:
// homes and work at the rush hours, shops by day, squares and benches in the evening.
float demand_at(DestinationKind kind, float hour);

// How long they stay, seconds: between `least` and `most`; those who leave there stay shorter, but at stops.
struct Stay {
    float least, most;
};
Stay stay_at(DestinationKind kind, bool leaves = false);

struct Trip {
    DestinationKind kind;
    NavPoint place;  // on the same piece of mesh as `from`, 0..2 m beside the destination's own
    Vec2 facing;
    bool leaves = false;  // the crowd, there; doors of houses and shops then are its very place
};
// A trip of 40 m to some 500 m, as the crow flies, for one who is at `from`; none if nothing draws them, as
// where there are no destinations: then they stroll. `ticks` counts from the beginning.
std::optional<Trip> choose_trip(const Demand& demand, const Navmesh& mesh, int thread, NavPoint from, By by,
                                uint32_t ticks, RandomKey key);

// Where one comes in: a place at which people leave, by how much they want to be there at that time, within
// `reach` of `centre` if there is one. `facing` is the way in. None where nobody leaves anywhere.
std::optional<Trip> choose_entrance(const Demand& demand, const Navmesh& mesh, int thread, Vec2 centre,
                                    float reach, uint32_t ticks, RandomKey key);

}  // namespace flaneur
