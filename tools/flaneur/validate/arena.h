// Floors with walls round them, on which people are put to the test.
#pragma once

#include <span>
#include <vector>

#include "assets/trajectories/trajectories.h"
#include "sim/ground/ground.h"
#include "sim/ground/rectangle.h"
#include "sim/navigation/navmesh.h"

namespace flaneur {

struct Arena {
    Ground ground;                      // indexed
    std::vector<WalkablePolygon> area;  // from wall to wall
};

// Corners counter-clockwise seen from above: (0, 0), (0, 1), (1, 1), (1, 0) in x and z.
struct FloorQuad {
    Vec3 corners[4];
    Surface kind = Surface::plaza;
};
// Level, at height 0.
FloorQuad floor_of(const Rectangle& rectangle);

// Walls of 3 m stand round all floors together, and nowhere within them. Floors may overlap and touch; those
// that touch at other heights need `risers` between them.
Arena make_arena(std::span<const FloorQuad> floors, std::span<const Face> risers = {});
Arena make_arena(std::span<const Rectangle> floors);

// As fine as necks of 0.6 m need it: cells of 5 cm, and people's middles keep 0.25 m, half a body, from
// walls.
NavmeshSettings arena_mesh();

bool is_on(const Arena& arena, Vec2 place);
inline bool is_in(const Rectangle& r, Vec2 p) {
    return p.x >= r.low.x && p.x <= r.high.x && p.z >= r.low.z && p.z <= r.high.z;
}

}  // namespace flaneur
