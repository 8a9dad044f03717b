// What people put into a city that is there: things that stand in the way, walls, closed streets, benches,
// lamps and entrances. A city with additions is the city with these in it, whenever they were put there.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "assets/city.h"
#include "sim/base/result.h"
#include "sim/ground/rectangle.h"

namespace flaneur {

enum class AddedKind : uint8_t { planter, car, tree, bench, lamp, entrance, wall, barrier };
inline constexpr std::string_view k_added_names[] = {"planter", "car",      "tree", "bench",
                                                     "lamp",    "entrance", "wall", "barrier"};
inline constexpr int k_added_kinds = 8;
inline constexpr size_t k_most_added = 1000;

struct Addition {
    AddedKind kind = AddedKind::planter;
    Vec3 at;         // on the ground, or up to 3 m above or below it
    Vec3 to;         // of walls and barriers: their other end, 0.5 to 200 m from `at`; else zero
    float turn = 0;  // of the others but entrances: degrees about +y from +z, which they face then; -360..360
    bool operator==(const Addition&) const = default;
};

// Whether it runs from one place to another. A wall is of stone, 2 m high; a barrier a row of planks, 1 m
// high, which closes a street where it reaches from wall to wall.
inline bool is_drawn_out(AddedKind kind) { return kind == AddedKind::wall || kind == AddedKind::barrier; }
inline constexpr float k_shortest_added = 0.5f, k_longest_added = 200;

// Whether its turn tells.
inline bool is_turned(AddedKind kind) { return !is_drawn_out(kind) && kind != AddedKind::entrance; }

// What it takes of the ground plane, with half a metre about it.
Rectangle area_of(const Addition& added);

// Where an entrance at `place` leads into: the nearest facade within 3 m. None: there is no house.
std::optional<WallPoint> entrance_at(const Ground& ground, Vec3 place);

// How something at `place` faces by default: away from the nearest wall within 4 m, degrees; 0 if there is
// none.
float usual_turn(const Ground& ground, Vec3 place);

// Puts them into an indexed city, which stays so: props and walls, obstacles, and what draws people. Refuses,
// in a sentence, one that is beyond the city, has no ground, lies in the water (of walls and barriers: an end
// of it), or is an entrance far from any house; the city is undefined then.
Result<void> add_to_city(City& city, std::span<const Addition> added);

}  // namespace flaneur
