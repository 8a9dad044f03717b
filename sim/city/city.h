// A city as plain arrays: what people stand on, bump into and touch, and what is drawn. One truth for eye and
// foot: the triangles that `ground` reports are the triangles that the renderer draws.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// What a piece of ground is. All but water can be walked on; navigation prefers some over others.
enum class Surface : uint8_t { road, sidewalk, crossing, plaza, path, steps, grass, water };
inline constexpr int k_surface_count = 8;

// What a vertical face is. Facades and garden walls stop walkers and can be touched; kerbs and risers are
// stepped over.
enum class FaceKind : uint8_t { facade, garden_wall, kerb, riser };

// A vertical quad. Seen from its free side, `a` is the lower left corner and `b` the lower right one, so its
// outward normal is cross(b - a, up). Bottom and top may slope.
struct Face {
    Vec3 a, b;
    float a_top = 0, b_top = 0;  // heights (y, not extents) of the upper corners
    FaceKind kind = FaceKind::facade;
    uint32_t building = ~0u;  // index into City::buildings, or ~0u
};

struct Building {
    float base = 0, top = 0;  // lowest ground and eaves, metres
    float storey = 3.2f;      // height of a storey, for windows
    uint8_t style = 0;        // index of a wall colour, see k_wall_colours in assets
    uint8_t has_shop = 0;     // 1: a shop front at street level
    uint32_t seed = 0;        // for everything that varies without meaning
    // sRGB, R in the lowest byte; 0: what the style and the seed make of it.
    uint32_t wall_colour = 0, roof_colour = 0;
};

enum class PropKind : uint8_t {
    tree,
    lamp,
    bench,
    bollard,
    bin,
    car,
    fountain,
    statue,
    planter,
    signal,
    shelter
};
inline constexpr int k_prop_count = 11;

struct Prop {
    PropKind kind = PropKind::tree;
    Vec3 position;     // on the ground
    float yaw = 0;     // about +y from +z, radians
    float height = 0;  // metres
    float radius = 0;  // crown of a tree, basin of a fountain, metres
    uint32_t seed = 0;
};

// Half of what a prop takes of the ground: x to its side, z along its yaw. A trunk's, not a crown's.
Vec2 half_footprint(const Prop& prop);

// Where people come from and go to.
enum class DestinationKind : uint8_t { door, shop, bench, stop, edge, square };
inline constexpr int k_destination_count = 6;

struct Destination {
    DestinationKind kind = DestinationKind::door;
    Vec3 position;     // on the ground, where one stands
    Vec2 facing;       // unit, the way one looks there: at the door, off the bench, out of the map
    float weight = 1;  // of its kind: how often it is chosen against others
};

// What a triangle of scenery is to walkers: nothing, ground (as the city's ground says again), or a wall.
enum class SceneryUse : uint8_t { backdrop, ground, solid };

// Triangles of any slope that are drawn as they are, with pictures: what a glTF city is made of.
struct Scenery {
    struct Vertex {
        Vec3 position, normal;
        Vec2 uv;
        uint32_t colour = ~0u;  // sRGB with alpha, R in the lowest byte; times the picture's
    };
    struct Picture {
        int width = 0, height = 0;
        std::vector<uint8_t> rgba;  // sRGB, rows from the top
    };
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;   // three a triangle, counter-clockwise from outside
    std::vector<uint32_t> pictures;  // one a triangle: index into `images`, or ~0u
    std::vector<SceneryUse> uses;    // one a triangle; solid ones stop walkers and can be touched
    std::vector<Picture> images;
    bool holds_ground = false;  // the ground is among these triangles and need not be drawn again
};

inline Vec3 scenery_corner(const Scenery& s, uint32_t triangle, uint32_t corner) {
    return s.vertices[s.indices[triangle * 3 + corner]].position;
}

// A uniform grid over the ground plane: cell (i, j) holds items[first[c] .. first[c + 1]) with c = j * width
// + i.
struct Grid {
    Vec2 origin;
    float cell = 4;
    int width = 0, height = 0;
    std::vector<uint32_t> first, items;
};

// A ground triangle as `ground` reads it, and a wall as `closest_wall` does.
struct GridTriangle {
    Vec3 a, b, c;
    Surface kind = Surface::road;
};
struct GridWall {
    Vec2 a, along;  // from end to end on the ground plane
    float per_length_squared = 0;
    float foot = 0, foot_rise = 0, top = 0, top_rise = 0;  // heights at a, and by how much b's differ
};

struct City {
    std::string name;
    Vec2 low, high;       // bounds on the ground plane
    float latitude = 48;  // degrees north; tells where the sun stands, and nobody else asks

    // Ground: triangles wound counter-clockwise seen from above (normals up), one kind each. Where a level
    // stops at a kerb or a step, the edge is there twice, once at each height, with a Face between.
    std::vector<Vec3> ground_vertices;
    std::vector<uint32_t> ground_indices;  // three a triangle
    std::vector<Surface> ground_kinds;     // one a triangle
    // One a triangle, a unit direction: the way people walk over a crossing (its stripes lie square to it),
    // up a flight of steps, down a dropped kerb; (1, 0) where there is none; zero on bare asphalt.
    std::vector<Vec2> ground_axes;

    std::vector<Face> faces;
    std::vector<Building> buildings;

    // Roofs and whatever else is only looked at: triangles, wound counter-clockwise from outside.
    std::vector<Vec3> roof_vertices;
    std::vector<uint32_t> roof_indices;
    std::vector<uint32_t> roof_buildings;  // one a triangle: index into buildings

    std::vector<Prop> props;
    std::vector<Destination> destinations;
    Scenery scenery;

    // Filled by index_city.
    Grid triangle_grid, wall_grid,
        scenery_grid;                          // ground; facades and garden walls; what of scenery is solid
    std::vector<GridTriangle> grid_triangles;  // one for each ground triangle
    std::vector<GridWall> grid_walls;          // one for each item of wall_grid, side by side in memory

    // How much of each sort of thing an import found, and how much of it it built (-1: nobody counted).
    struct Tally {
        std::string what;
        int found = 0, built = 0;
    };
    std::vector<Tally> tallies;
    std::vector<std::string> notes;  // what an import skipped or repaired, a counted sentence each
};

// Builds the grids and bounds. To be called once, after the arrays are filled.
void index_city(City& city);

struct GroundHit {
    float height = 0;
    Vec3 normal{0, 1, 0};
    Surface kind = Surface::road;
};

// The highest ground at `point`'s x, z whose height lies in [point.y - down, point.y + up]. None outside the
// city or on a place without ground (inside a building).
std::optional<GroundHit> ground(const City& city, Vec3 point, float up = 0.5f, float down = 3);
// The same for many points, in some two thirds of the time where they lie far apart; `hits` takes one for
// each.
void ground(const City& city, std::span<const Vec3> points, float up, float down,
            std::optional<GroundHit>* hits);

struct RayHit {
    float distance = 0;
    Vec3 normal;
    enum class What : uint8_t { ground, face, scenery } what = What::face;
    uint32_t index = 0;  // of the ground triangle, the face or the triangle of the scenery
};

// The first ground triangle, facade, garden wall or solid scenery along origin + t * direction, 0 <= t <=
// reach. `direction` is a unit vector. Faces and triangles are hit from both sides.
std::optional<RayHit> raycast(const City& city, Vec3 origin, Vec3 direction, float reach);

struct WallPoint {
    Vec3 point;
    Vec3 normal;  // out of the wall, horizontal
    float distance = 0;
    uint32_t face = ~0u;  // index into City::faces, or ~0u: scenery
};

// The closest point of any facade, garden wall or solid scenery within `radius` of `point`, at a height that
// the wall has.
std::optional<WallPoint> closest_wall(const City& city, Vec3 point, float radius);

// The hash of everything above; latitude, tallies, notes and grids excepted.
uint64_t hash_city(const City& city);

}  // namespace flaneur
