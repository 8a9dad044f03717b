// The ground that people stand on, the walls that stop them, and what feet, hands and eyes ask of both.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// What a piece of ground is. All but water and railway tracks can be walked on; navigation prefers some over
// others.
enum class Surface : uint8_t { road, sidewalk, crossing, plaza, path, steps, grass, water, track };
inline constexpr int k_surface_count = 9;
inline bool is_walked(Surface s) { return s != Surface::water && s != Surface::track; }
// Where one drives, with what is marked there for people to cross.
inline bool is_carriageway(Surface s) { return s == Surface::road || s == Surface::crossing; }

// What a vertical face is. Facades and garden walls stop walkers and can be touched; kerbs and risers are
// stepped over.
enum class FaceKind : uint8_t { facade, garden_wall, kerb, riser };

// A vertical quad. Seen from its free side, `a` is the lower left corner and `b` the lower right one, so its
// outward normal is cross(b - a, up). Bottom and top may slope.
struct Face {
    Vec3 a, b;
    float a_top = 0, b_top = 0;  // heights (y, not extents) of the upper corners
    FaceKind kind = FaceKind::facade;
    uint32_t building = ~0u;  // whose face it is, by the caller's own count; ~0u: nobody's
};

// A wall of any slope, counter-clockwise from outside. Stops walkers and can be touched.
struct Solid {
    Vec3 a, b, c;
};

// What stands in the way of paths, but is neither touched nor seen by rays: trunks, posts, benches, cars. A
// box on the ground: `half` is half its width to its side (x) and along its yaw (z).
struct Obstacle {
    Vec3 position;
    float yaw = 0;  // about +y from +z, radians
    Vec2 half;
};

// A uniform grid over the ground plane: cell (i, j) holds items[first[c] .. first[c + 1]) with c = j * width
// + i.
struct Grid {
    Vec2 origin;
    float cell = 4;
    int width = 0, height = 0;
    std::vector<uint32_t> first, items;
};

// A ground triangle as `ground_at` reads it, and a wall as `closest_wall` does.
struct GridTriangle {
    Vec3 a, b, c;
    Surface kind = Surface::road;
};
// What of the ground lies in a cell, where that is one plane all over: its height at `at` and by how much it
// rises a metre along x and z.
inline constexpr uint32_t k_no_slab = ~0u;
struct Slab {
    Vec2 at, rise;
    float height = 0;
    Vec3 normal{0, 1, 0};
    Surface kind = Surface::road;
};
struct GridWall {
    Vec2 a, along;  // from end to end on the ground plane
    float per_length_squared = 0;
    float foot = 0, foot_rise = 0, top = 0, top_rise = 0;  // heights at a, and by how much b's differ
};

// Fill the arrays, then call index_ground once. Metres, +y up.
struct Ground {
    std::string name;  // for messages

    // Triangles wound counter-clockwise seen from above (normals up), one kind each. Where a level stops at a
    // kerb or a step, the edge is there twice, once at each height, with a Face between.
    std::vector<Vec3> vertices;
    std::vector<uint32_t> indices;  // three a triangle
    std::vector<Surface> kinds;     // one a triangle
    std::vector<Face> faces;
    std::vector<Solid> solids;
    std::vector<Obstacle> obstacles;

    // Filled by index_ground.
    Vec2 low, high;                             // bounds on the ground plane
    Grid triangle_grid, wall_grid, solid_grid;  // triangles; facades and garden walls; solids
    std::vector<GridTriangle> grid_triangles;   // one for each triangle
    std::vector<uint32_t> slab_of_cell;         // of triangle_grid: index into `slabs`, or k_no_slab
    std::vector<Slab> slabs;
    std::vector<GridWall> grid_walls;  // one for each item of wall_grid, side by side in memory
};

// Builds the grids and bounds.
void index_ground(Ground& ground);

struct GroundHit {
    float height = 0;
    Vec3 normal{0, 1, 0};
    Surface kind = Surface::road;
};

// The highest ground at `point`'s x, z whose height lies in [point.y - down, point.y + up]. None outside the
// bounds or on a place without ground (inside a building).
std::optional<GroundHit> ground_at(const Ground& ground, Vec3 point, float up = 0.5f, float down = 3);
// The same for many points, in some two thirds of the time where they lie far apart; `hits` takes one for
// each.
void ground_at(const Ground& ground, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits);

struct RayHit {
    float distance = 0;
    Vec3 normal;
    enum class What : uint8_t { ground, face, solid } what = What::face;
    uint32_t index = 0;  // of the ground triangle, the face or the solid
};

// The first ground triangle, facade, garden wall or solid along origin + t * direction, 0 <= t <= reach.
// `direction` is a unit vector. Faces and triangles are hit from both sides.
std::optional<RayHit> raycast(const Ground& ground, Vec3 origin, Vec3 direction, float reach);

struct WallPoint {
    Vec3 point;
    Vec3 normal;  // out of the wall, horizontal
    float distance = 0;
    uint32_t face = ~0u;  // index into Ground::faces, or ~0u: a solid
};

// The closest point of any facade, garden wall or solid within `radius` of `point`, at a height that the wall
// has.
std::optional<WallPoint> closest_wall(const Ground& ground, Vec3 point, float radius);

// Of all that index_ground is given, the name too.
uint64_t hash_ground(const Ground& ground);

}  // namespace flaneur
