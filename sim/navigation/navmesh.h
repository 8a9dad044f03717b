// Where people can go and by which way: Recast builds the mesh from a Ground; Detour says where one is on it,
// and shortcuts (shortcuts.h) which way leads from one place to another.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "sim/ground/ground.h"
#include "sim/ground/rectangle.h"

namespace flaneur {

struct NavmeshSettings {
    float cell = 0.2f;          // horizontal voxel, metres
    float cell_height = 0.05f;  // vertical voxel, metres; must resolve a kerb
    float agent_radius = 0.3f;  // kept from walls, metres
    float agent_height = 1.9f;  // headroom, metres
    float max_climb = 0.3f;     // highest kerb or step, metres
    float max_slope_degrees = 40;
    float tile = 48;  // edge of a tile, metres; of ground of more than 8192 tiles it is doubled to 96, 192...
};

struct Navmesh;  // dtNavMesh and one query object for each thread
struct NavmeshDelete {
    void operator()(Navmesh*) const;
};
using NavmeshPtr = std::unique_ptr<Navmesh, NavmeshDelete>;

// A place on the mesh. `polygon` is Detour's reference; 0 is nowhere.
struct NavPoint {
    Vec3 position;
    uint32_t polygon = 0;
};

// Builds on `threads` threads (0: all cores); tiles are put together in a fixed order, so the mesh does not
// depend on the number of threads. `progress`, if given, is called with 0..1, on the calling thread; where it
// answers false, the build is given up, within a tile, with an error. Refuses one without walkable ground.
Result<NavmeshPtr> build_navmesh(const Ground& ground, const NavmeshSettings& settings, int threads,
                                 const std::function<bool(float)>& progress = {});

// What it was made with.
const NavmeshSettings& settings_of(const Navmesh& mesh);

// The mesh as bytes, to be kept, and the same mesh made of them again in little time. The bytes must be those
// of this ground and these settings, unharmed: they are trusted but for their length.
std::string navmesh_bytes(const Navmesh& mesh);
Result<NavmeshPtr> restore_navmesh(const Ground& ground, const NavmeshSettings& settings,
                                   std::string_view bytes, int threads);

// The mesh of a ground that is as it was, but for what has come, gone or moved within `changed`; `bytes` are
// those of the mesh it had, made with the same settings. Only tiles that these areas touch are built again,
// and the mesh is the same, bit by bit, as build_navmesh() makes of the whole ground. Ground whose bounds
// have changed is built anew.
Result<NavmeshPtr> rebuild_navmesh(const Ground& ground, const NavmeshSettings& settings,
                                   std::string_view bytes, Vec2 low, Vec2 high,
                                   std::span<const Rectangle> changed, int threads);

// From the polygons of one mesh to those of another that are the same: where they are in tiles that no change
// has touched.
struct NavmeshPassage {
    std::vector<uint32_t>
        bases;  // by tile of the one: what polygons of it are counted from in the other, or 0
    const Navmesh* from = nullptr;
};
NavmeshPassage passage(const Navmesh& from, const Navmesh& to);
// 0: it is there no more.
uint32_t passed(const NavmeshPassage& passage, uint32_t polygon);

// Of where people can go: outlines and kinds of all polygons, and what they are joined to.
uint64_t hash_navmesh(const Navmesh& mesh);

// Sets up one query object for each of `threads` threads. Functions below that take `thread` may run at the
// same time if their `thread`s differ, and give the same answer on every thread.
void prepare_queries(Navmesh& mesh, int threads);

// The closest place within `reach` (half extents), if there is one.
std::optional<NavPoint> nearest(const Navmesh& mesh, int thread, Vec3 point, Vec3 reach = {2, 2, 2});

// A random place by area among sidewalks, plazas, paths, crossings and steps, from three numbers in [0, 1).
// Leaves out pieces of mesh under 300 square metres; ground with none of these surfaces is offered
// whole.
NavPoint random_place(const Navmesh& mesh, int thread, float u, float v, float w);

// The same among the places of the map cells (as large as tiles) that touch the square of half edge `radius`
// about `centre`; anywhere if there are none.
NavPoint random_place_near(const Navmesh& mesh, int thread, Vec2 centre, float radius, float u, float v,
                           float w);

// Square metres of those places; 0 if there are none.
double place_area_near(const Navmesh& mesh, Vec2 centre, float radius);

// The number of the connected piece of mesh that a polygon belongs to (pieces are numbered by falling area).
uint32_t island(const Navmesh& mesh, uint32_t polygon);

// Whether that piece is large enough that people are sent about in it: 300 square metres, or the largest.
bool is_worth_walking(const Navmesh& mesh, uint32_t polygon);

// Who has wheels goes nowhere onto steps (Surface::steps), and may leave them.
enum class By : uint8_t { feet, wheels };

// Whether there is a way from one polygon to another. Who is on steps with wheels is taken to get off them to
// where it would.
bool are_joined(const Navmesh& mesh, uint32_t from, uint32_t to, By by = By::feet);

// The kind of ground that a polygon of the mesh stands for.
Surface surface_of(const Navmesh& mesh, uint32_t polygon);

// Whether there may be steps within k_steps_ahead of a place of the ground plane.
inline constexpr float k_steps_ahead = 5;  // metres
bool is_near_steps(const Navmesh& mesh, Vec2 place);

// The corners of the cheapest way from `from` (exclusive) to `to` (inclusive), at most `capacity`, written to
// `corners`; returns how many. Sidewalks and paths are cheap, crossings and then plazas a little
// dearer, grass and roads dear. A way that does not reach goes as near as it can. 0 if `from` is nowhere.
int find_path(const Navmesh& mesh, int thread, NavPoint from, NavPoint to, Vec3* corners, int capacity,
              By by = By::feet);

// Moves along the mesh from `from` towards `to`, sliding along its borders: never through a wall. The
// result's height is the mesh's, coarse; ask `ground_at` for the surface.
NavPoint move_along(const Navmesh& mesh, int thread, NavPoint from, Vec3 to, By by = By::feet);

// A straight piece of the mesh's border. Walking from `a` to `b` has the mesh on the side where cross(b - a,
// p - a) > 0.
struct BorderLine {
    Vec3 a, b;
};

// The unit vector from a border line into the mesh, on the ground plane.
inline Vec2 inward_of(const BorderLine& line) {
    const Vec2 ab = on_ground(line.b) - on_ground(line.a);
    return normalize_or(Vec2{-ab.z, ab.x}, {0, 0});
}

// The first border over which the straight way between two places of the mesh leaves it, if any does. So
// many of its first and last metres are not looked at.
std::optional<BorderLine> first_border(const Navmesh& mesh, Vec3 from, Vec3 to, float forgiven_start = 0,
                                       float forgiven_end = 0);

// Whether the straight way between two places of the mesh does not leave it. Its first 2 cm and last 5 cm are
// forgiven, for places on the border.
bool is_clear(const Navmesh& mesh, Vec3 from, Vec3 to);

// The border lines within `radius` of `point` and near its height, nearest first (ties by order in the mesh),
// at most `capacity` (up to 32); returns how many.
int borders_near(const Navmesh& mesh, Vec3 point, float radius, BorderLine* lines, int capacity);

// Triangles for drawing and tests: three corners each.
std::vector<Vec3> navmesh_triangles(const Navmesh& mesh);
// The kind of ground of each of them.
std::vector<Surface> navmesh_kinds(const Navmesh& mesh);

}  // namespace flaneur
