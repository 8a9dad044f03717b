// The parts of the built-in district: streets are laid, then what they leave free is filled block by block.
#pragma once

#include <optional>

#include "assets/district/plan.h"
#include "assets/plan/ground_plan.h"
#include "assets/plan/masses.h"

namespace flaneur {

struct District {
    City city;
    GroundPlan plan;
    StreetPlan streets;
    std::vector<Vec2> tram_stops;
    uint32_t trims = 0;  // the first of the buildings that lend their colour to things of a Trim
};

// What is neither wall nor roof takes its colour from a building that lends it.
enum class Trim : uint32_t { coping, metal, stone, burgundy, bottle_green, mustard, canvas };
inline constexpr uint32_t k_trim_count = 7;
void lend_colours(District& d);
inline uint32_t trim(const District& d, Trim t) { return d.trims + static_cast<uint32_t>(t); }

// Wall colours by kind of house, indices of k_wall_colours.
uint8_t plaster_style(Dice& dice);
uint8_t stone_style(Dice& dice);

float terrain_at(const District& d, Vec2 p);
void add_area(District& d, int rank, Surface kind, Lift lift, Rings rings, Vec2 axis = {1, 0});
// A paved strip along a line.
void add_path(District& d, const std::vector<Vec2>& line, float width, Surface kind = Surface::path);
// The ring moved inwards by so many metres, its largest part; none where nothing is left.
std::optional<Ring> shrunk(const Ring& ring, float distance);
Ring circle(Vec2 centre, float radius, int corners);

// A street front: the straight side of a block, its block to the right of a-b on a map.
struct Front {
    Vec2 a, b;
    uint32_t way = ~0u;  // of the street plan
    bool busy = false;   // shops, higher houses
    bool arcade = false;
};

struct Block {
    Ring outline;               // positively wound
    Ring ring;                  // the same with fewer corners, for lots
    std::vector<Front> fronts;  // one an edge of the ring, in order
    Dice dice;
};

struct House {
    Ring footprint;  // positively wound
    std::vector<uint32_t> street_edges;
    std::optional<uint32_t> door_edge;
    float eaves = 12;  // above the ground at the door, metres
    float storey = 3.2f;
    RoofKind roof = RoofKind::flat;
    float roof_height = 0.8f;
    float overhang = 0, cornice = 0.3f;
    bool gable_across = false;
    uint8_t style = 0;
    bool shop = false;
    float lift = k_kerb;  // of the ground it stands on, above the terrain
    float sunk = 0;       // how far below its lowest ground the walls begin
};
// Adds the building, with what hangs on its front, and takes its ground away; returns its index.
uint32_t add_house(District& d, Dice& dice, const House& house);
// An upper part that stands on others: from `bottom` metres above the ground.
uint32_t add_upper(District& d, Dice& dice, const House& house, float bottom);
void add_prop(District& d, Dice& dice, PropKind kind, Vec2 at, float yaw, float height, float radius = 0);
void add_tree(District& d, Dice& dice, Vec2 at, float size = 1);
// With a place to sit.
void add_bench(District& d, Dice& dice, Vec2 at, Vec2 facing);
void add_destination(District& d, DestinationKind kind, Vec2 at, Vec2 facing, float weight);
// A wall that follows the ground, in lengths of a few metres; it stands to the right of a-b on a map.
void add_long_wall(District& d, Vec2 a, Vec2 b, float thickness, float height);
// A square pillar from the ground to `top`.
void add_pillar(District& d, Vec2 at, Vec2 along, float half, float top);

// Chimneys and dormers, or a stair head, on the roof of a house whose front is a-b.
void dress_roof(District& d, Dice& dice, const House& house, uint32_t building, Vec2 a, Vec2 b, float depth);
// Balconies and awnings on the front a-b, whose ground floor begins at `foot`.
void dress_front(District& d, Dice& dice, const House& house, float foot, Vec2 a, Vec2 b);

// Houses shoulder to shoulder along the block's fronts, with lots `depth` metres deep. False where the block
// is too small for them.
bool fill_row(District& d, Block& block, float depth, int storeys, bool closed);

void lay_streets(District& d, uint64_t seed);
// Where one drives, and the rails in the street: after list_obstacles().
void lay_lanes(District& d);
void fill_houses(District& d, Block& block);
void fill_villas(District& d, Block& block);
void fill_park(District& d, Block& block);
void fill_slabs(District& d, Block& block);
void fill_square(District& d, Block& block);
// Beyond the outermost street `way`, whose blocks lie to its right.
void fill_belt(District& d, uint32_t way, uint64_t seed);

// Props and places were put on the map; now there is ground for them to stand on, or not. After index_city().
void settle(City& city);
// The country around the map, as scenery.
void add_horizon(District& d, uint64_t seed);

}  // namespace flaneur
