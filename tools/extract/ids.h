// The ids of what is drawn: CityVertex::id and WalkerDraw::id, which Image::ids gives back.
#pragma once

#include <algorithm>
#include <cstdint>

namespace flaneur {

// What an id is of, and which numbers they have: Surface of the ground, or k_kerb_number; indices of
// City::buildings for houses and for what has no facade, which is a wall; of City::props for trees, cars and
// other props; WalkerId::index, of a walker with all that it carries and pushes; 0 for scenery; of
// Roam::creatures; of Troupe::plans, and after them of Linkages::all, and after them of Deeds::plans, for
// exhibits; of Movers::all, after them of Balls::all, and after them of
// Vehicles::all.
enum class IdKind : uint8_t {
    none,
    ground,
    house,
    wall,
    tree,
    car,
    prop,
    scenery,
    walker,
    creature,
    exhibit,
    mover
};
inline constexpr uint32_t k_kerb_number = 9;
// Of what nobody counts, such as a wall that is no building's, and of all numbers beyond.
inline constexpr uint32_t k_last_number = (1u << 20) - 1;

// Below 2^24, and the same in every picture of a city and its walkers.
constexpr uint32_t id_of(IdKind kind, uint32_t number) {
    return static_cast<uint32_t>(kind) * (k_last_number + 1) + std::min(number, k_last_number);
}
constexpr IdKind kind_of_id(uint32_t id) { return static_cast<IdKind>(id / (k_last_number + 1)); }
constexpr uint32_t number_of_id(uint32_t id) { return id % (k_last_number + 1); }

}  // namespace flaneur
