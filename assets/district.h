// The parts of the built-in district: what its streets leave free is filled block by block.
#pragma once

#include <array>

#include "assets/ground_plan.h"
#include "assets/masses.h"
#include "sim/base/rng.h"

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

using Quad = std::array<Vec2, 4>;  // wound positively: north-west, north-east, south-east, south-west

// A block between sidewalks. Side k runs from corner k to corner k + 1: north, east, south, west.
struct Block {
    Quad corners;
    std::array<bool, 4> busy{};  // sides on a broad street or the square: shops, higher houses
    Dice dice;
};

struct District {
    City city;
    GroundPlan plan;
};

// Wall colours by kind of house, indices of k_wall_colours.
uint8_t plaster_style(Dice& dice);
uint8_t stone_style(Dice& dice);

float terrain_at(const District& d, Vec2 p);
// Where lines p-q and r-s meet; they must not be parallel.
Vec2 meeting(Vec2 p, Vec2 q, Vec2 r, Vec2 s);
// Side k moved inwards by distance[k].
Quad inset_quad(const Quad& quad, const std::array<float, 4>& distance);
Ring ring_of(const Quad& quad);
void add_area(District& d, int rank, Surface kind, Lift lift, Rings rings, Vec2 axis = {1, 0});

struct House {
    Ring footprint;  // positively wound
    std::vector<uint32_t> street_edges;
    float eaves = 12;  // above the lowest ground, metres
    RoofKind roof = RoofKind::flat;
    float roof_height = 0.8f;
    float overhang = 0, cornice = 0.3f;
    bool gable_across = false;
    uint8_t style = 0;
    bool shop = false;
    float lift = 0;  // of the ground it stands on, above the terrain
};
// Adds the building and takes its ground away; returns its index.
uint32_t add_house(District& d, Dice& dice, const House& house);
void add_prop(District& d, Dice& dice, PropKind kind, Vec2 at, float yaw, float height, float radius = 0);
void add_tree(District& d, Dice& dice, Vec2 at, float size = 1);

// Houses shoulder to shoulder along side `from`-`to` of `depth`, given the strip's outer and inner lines.
// `corner_start`, `corner_end`: the strip's ends stand at street corners.
void fill_strip(District& d, Block& block, const Quad& strip, int side, bool corner_start, bool corner_end,
                int storeys, bool gateway);

void fill_perimeter(District& d, Block& block);
void fill_villas(District& d, Block& block);
void fill_park(District& d, Block& block);
void fill_slabs(District& d, Block& block);
void fill_square(District& d, Block& block);

}  // namespace flaneur
