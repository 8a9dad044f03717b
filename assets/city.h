// A city: the ground that people walk on, and all that is only drawn. One truth for eye and foot: the
// triangles that `ground_at` reports are the triangles that the renderer draws.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/place.h"
#include "sim/base/vec.h"
#include "sim/crowd/demand.h"
#include "sim/ground/ground.h"
#include "sim/lamps/crossings.h"
#include "sim/lanes/lanes.h"

namespace flaneur {

// What is on a building's walls: windows; panes from ground to roof; nothing; or courses of stone.
enum class Finish : uint8_t { windows, glass, plain, stone };

struct Building {
    float base = 0, top = 0;  // lowest ground and eaves, metres
    float storey = 3.2f;      // height of a storey, for windows
    uint8_t style = 0;        // index of a wall colour, see k_wall_colours in assets/cities.h
    uint8_t has_shop = 0;     // 1: a shop front at street level
    Finish finish = Finish::windows;
    uint32_t seed = 0;  // for everything that varies without meaning
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
    shelter,
    barrier  // of a closed street; `radius` is half its width
};
inline constexpr int k_prop_count = 12;

struct Prop {
    PropKind kind = PropKind::tree;
    Vec3 position;     // on the ground
    float yaw = 0;     // about +y from +z, radians
    float height = 0;  // metres
    float radius = 0;  // crown of a tree, basin of a fountain, half a barrier, metres
    uint32_t seed = 0;
};

// Half of what a prop takes of the ground: x to its side, z along its yaw. A trunk's, not a crown's.
Vec2 half_footprint(const Prop& prop);

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

struct City {
    Ground ground;                    // its faces' buildings count `buildings`
    float latitude = 48;              // degrees north; tells where the sun stands, and nobody else asks
    std::optional<OnEarth> on_earth;  // of a map

    // One a ground triangle, a unit direction: the way people walk over a crossing (its stripes lie square to
    // it), up a flight of steps, down a dropped kerb, along the rails between which sleepers lie; (1, 0)
    // where there is none; zero on bare asphalt and bare ballast.
    std::vector<Vec2> ground_axes;

    std::vector<Building> buildings;

    // Roofs and whatever else is only looked at: triangles, wound counter-clockwise from outside.
    std::vector<Vec3> roof_vertices;
    std::vector<uint32_t> roof_indices;
    std::vector<uint32_t> roof_buildings;  // one a triangle: index into buildings

    // Rails that lie flush in streets: dark lines on the ground, from a to b.
    struct Groove {
        Vec3 a, b;
    };
    std::vector<Groove> grooves;

    std::vector<Prop> props;
    std::vector<Destination> destinations;
    Scenery scenery;

    // Where people cross streets; those with signals are ruled by their lamps. Not in its hash.
    Crossings crossings;

    // Where one drives. Not in its hash either.
    Lanes lanes;

    // How much of each sort of thing an import found, and how much of it it built (-1: nobody counted).
    struct Tally {
        std::string what;
        int found = 0, built = 0;
    };
    std::vector<Tally> tallies;
    std::vector<std::string> notes;  // what an import skipped or repaired, a counted sentence each
};

// Facades are fitted with bays about so wide, metres, each with a window or a door in its middle.
inline constexpr float k_bay_width = 2.7f;
// Of the facade from `a` to `b`, where the door is that one has before one at `place`.
Vec2 door_on(Vec2 a, Vec2 b, Vec2 place);

// Makes the ground's solids of the scenery, and indexes it. To be called once, after the arrays are filled;
// props may be added, and moved onto the ground, until list_obstacles is called.
void index_city(City& city);

// Sets crossings onto the ground, which is indexed, within 60 m of height 0.
void settle_crossings(City& city);

// Makes the ground's obstacles of the props.
void list_obstacles(City& city);

// The hash of the ground, and of everything above but latitude, place on Earth, crossings, lanes, tallies and
// notes.
uint64_t hash_city(const City& city);

}  // namespace flaneur
