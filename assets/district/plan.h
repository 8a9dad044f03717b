// The street plan of the built-in district: a bent lattice of streets with ways taken out, made into lanes or
// cut across by an avenue, and the blocks that they leave.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/plan/polygons.h"
#include "sim/base/rng.h"
#include "sim/base/vec.h"

namespace flaneur {

// Random numbers in a row, for work whose order is fixed: never two draws in one expression, or the compiler
// chooses which comes first (braces keep their order).
struct Dice {
    RandomKey key;
    uint32_t next = 0;

    float unit() { return random_unit(key, next++); }
    float between(float low, float high) { return random_between(key, low, high, next++); }
    int pick(int count) { return static_cast<int>(unit() * static_cast<float>(count)); }
    bool chance(float p) { return unit() < p; }
    uint32_t bits() { return static_cast<uint32_t>(random_bits(key, next++)); }
};

// Lanes and stairs are for people on foot; a way out leads off the map.
enum class WayKind : uint8_t { none, street, avenue, lane, stairs };

// From one node to the next.
struct Way {
    WayKind kind = WayKind::none;
    uint32_t from = 0, to = 0;
    bool leads_out = false;
    bool has_trees = false;
    bool has_tracks = false, has_tram_stop = false;
    float width = 8, sidewalk = 3.5f;  // the carriageway, or all of a lane; metres
    std::vector<Vec2> line;            // straight for its first and last metres

    bool carries_cars() const { return kind == WayKind::street || kind == WayKind::avenue; }
    // From the middle to the houses.
    float half() const { return width * 0.5f + (carries_cars() ? sidewalk : 0); }
};

enum class BlockUse : uint8_t { houses, villas, slabs, park, square };

// Ground between ways.
struct BlockPlan {
    Ring outline;  // between the houses' lines of the ways around it, positively wound
    Ring ring;     // the same with fewer corners
    std::vector<uint32_t> ways;
    BlockUse use = BlockUse::houses;
};

// A hill to the north that streets climb between the first two rows, evenly in its middle part, and gentle
// rises elsewhere: the sum of a profile from west to east and one from north to south, straight within each
// cell of the ground plan, so that pieces of one cell lie in one plane.
struct Relief {
    Vec2 origin;
    float cell = 12;
    std::vector<float> east, south;  // heights at the borders of cells
    float slope = 0;                 // of the hill, per metre
    float plane_top = 0,
          plane_foot = 0;  // z between which the hill is one plane where nothing rises eastwards

    float height(Vec2 p) const;
};

struct StreetPlan {
    int blocks = 4;
    Vec2 low, high;  // of the map
    std::vector<Vec2> nodes;
    std::vector<Way> ways;
    std::vector<BlockPlan> plots;
    std::vector<uint32_t> outer;  // ways that run round all blocks, these to their right
    Relief relief;

    // The ways that meet at a node.
    std::vector<std::vector<uint32_t>> ways_at;
};

// Square, park and stairs have places of their own; all else is drawn by lot. `blocks` along each
// side, 1..32; the map goes `belt` metres beyond the outermost streets and is to be cut into cells of `cell`
// metres. `tracks`: the second row is an avenue with tracks, from edge to edge.
StreetPlan plan_streets(uint64_t seed, int blocks, float belt, float cell, bool tracks);

// The corners of an outline that lots can be cut by: as few as leave room for a row of houses along each
// side.
Ring simple_outline(const Ring& outline);

// The point `s` metres from the start of a line, and the direction there.
struct Station {
    Vec2 at, along;
};
Station station(const std::vector<Vec2>& line, float s);

}  // namespace flaneur
