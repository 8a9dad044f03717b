// From overlapping flat areas to a city's ground: areas are cut by rank into pieces that do not overlap,
// small, with common corners, then lifted, triangulated and joined by kerbs, risers and walls where heights
// differ.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "assets/city.h"
#include "assets/plan/polygons.h"

namespace flaneur {

inline constexpr float k_kerb = 0.12f;          // sidewalks above roads, metres
inline constexpr float k_dropped_kerb = 0.02f;  // where a crossing meets the sidewalk

// The height of an area above the terrain, metres: clamp(base + dot(p - origin, slope), low, high).
struct Lift {
    float base = 0, low = 0, high = 0;
    Vec2 origin, slope;
    bool absolute = false;  // the terrain does not count: water, terraces
};
inline Lift flat(float height) { return {height, height, height, {}, {}}; }
inline Lift level(float height) { return {height, height, height, {}, {}, true}; }
float lift_at(const Lift& lift, Vec2 p);

// Where areas overlap, the lower rank wins, then the earlier one. Neighbours in that order that agree in all
// but their rings are one area.
struct Area {
    int rank = 0;
    bool solid = false;  // no ground: a building or a wall stands here
    Surface kind = Surface::path;
    Vec2 axis{1, 0};  // becomes City::ground_axes
    Lift lift;
    // Positively wound rings, each followed by its holes, if any. Rings may overlap.
    Rings rings;
};

struct GroundPlan {
    Vec2 low, high;   // nothing is laid outside, metres
    float cell = 32;  // pieces are cut along squares of this size, metres
    std::vector<Area> areas;
    std::function<float(Vec2)> terrain;  // height; flat at 0 where empty
    bool facets = false;                 // pieces are cut along the diagonals of the squares too
};

// The side of the squares, whole millimetres.
int64_t cell_of(const GroundPlan& plan);

// The terrain's height, metres.
inline float terrain_at(const GroundPlan& plan, Vec2 p) { return plan.terrain ? plan.terrain(p) : 0; }

// The height of the ground of an area.
float height_of(const GroundPlan& plan, const Area& area, Vec2 p);

// Replaces the terrain by planes over the halves of the plan's squares (low, high and cell are set before),
// through its heights at their corners. However the ground is cut, each piece then lies in one plane, and no
// sliver of it is steep.
void facet_terrain(GroundPlan& plan);

// A piece of ground, with the area that it belongs to. Neighbours share corners exactly: an edge of one is an
// edge of the other, the other way round.
struct Piece {
    uint32_t area = 0;
    Region region;
};
std::vector<Piece> cut_pieces(const GroundPlan& plan);

// Appends the ground and the faces between its levels to `city`: kerbs and risers up to 0.35 m, garden walls
// above.
void lay_ground(const GroundPlan& plan, City& city);

}  // namespace flaneur
