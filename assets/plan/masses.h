// Solid shapes of a city: buildings and walls, from footprints. Each adds its faces and roof triangles; the
// ground under it is left out by giving the footprint to the GroundPlan as a solid area.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/city.h"
#include "assets/plan/ground_plan.h"
#include "assets/plan/polygons.h"

namespace flaneur {

// Places of Area::rank, from what cuts everything to what is left over.
enum GroundRank : int {
    k_rank_solid,
    k_rank_steps,
    k_rank_terrace,
    k_rank_basin,
    k_rank_crossing,
    k_rank_road,
    k_rank_dropped_kerb,
    k_rank_platform,
    k_rank_sidewalk,
    k_rank_plaza,
    k_rank_path,
    k_rank_track,
    k_rank_water,
    k_rank_grass,
    k_rank_apron,
    k_rank_tram,
    k_rank_rest,
};

// A ridge runs along the outline's longer side where Mass says nothing else. Gable, gambrel and round roofs
// take outlines that about fill a rectangle; pyramid, dome and onion those whose corners are all seen from
// the middle (a pyramid over others is a hip roof); hip and mansard any. What does not fit becomes flat; flat
// roofs get a parapet where the outline can be inset.
enum class RoofKind : uint8_t {
    flat,
    gable,
    half_hip,
    hip,
    pyramid,
    skillion,
    gambrel,
    round,
    mansard,
    dome,
    onion
};
inline constexpr int k_roof_count = 11;

struct Mass {
    Region footprint;
    float bottom = 0, eaves = 3;  // heights, metres
    RoofKind roof = RoofKind::flat;
    float roof_height = 0;      // from the eaves to the ridge; of a flat roof, its parapet's height
    float overhang = 0;         // of a gable or hip roof, metres
    float cornice = 0;          // how far the cornice stands out, metres; only along `street_edges`
    bool underside = false;     // closed from below: a part that others or nothing carry
    bool gable_across = false;  // over four corners, the ridge runs from edge 0 to edge 2, not from 1 to 3
    Vec2 ridge;                 // along the ridge, its high side to the left of a skillion's; none: see above
    FaceKind kind = FaceKind::facade;
    uint32_t building = ~0u;
    std::vector<uint32_t> street_edges;  // edges of the outer ring, by their first corner
};
// Returns the roof that it has got.
RoofKind add_mass(City& city, const Mass& mass);

// An upright box about `centre` (its bottom's), `half` metres along `along` and square to it, in roof
// triangles.
void add_box(City& city, Vec3 centre, Vec2 along, Vec2 half, float height, uint32_t building);

// A straight wall with a level or sloping top, from a to b, standing on the right of a-b; its ground goes out
// of the plan. `foot` is below all ground along it. Belongs to `building`, for its colour.
void add_garden_wall(City& city, GroundPlan& plan, Vec2 a, Vec2 b, float thickness, float foot, float a_top,
                     float b_top, uint32_t building);

}  // namespace flaneur
