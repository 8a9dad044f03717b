// Bridges and other ways above the ground: how high they lie, and building them.
#pragma once

#include <vector>

#include "assets/osm/map.h"

namespace flaneur {

inline constexpr float k_level_height = 4.8f;  // of one `layer` above the one below it, metres
inline constexpr float k_deck = 0.45f;         // from a deck's top to its underside, metres
inline constexpr float k_headroom = 2.45f;     // where there is less below a deck, there is no ground, metres

inline constexpr float k_sleeper = 2.6f;  // its length, metres

// A straight piece of a raised way. Heights are those of a terrain that runs through the air: a
// carriageway's, or a kerb's height below a pavement's.
struct DeckPiece {
    Vec2 a, b;
    float a_height = 0, b_height = 0;
    bool starts_on_ground = false, ends_on_ground = false;
    bool starts_open = false, ends_open = false;  // see open_ends
    uint32_t street = 0;                          // index into OsmImport::raised
    uint32_t line = 0;                            // index into its lines
};

// How high raised ways lie: at the terrain where they meet ways on the ground, a level's height above it
// where they cross something or belong to walkways that touch the ground by steps only, as far as the slope
// allows that people and cars can climb, and evenly between. Open ends come down to the ground where what
// they lead over stays as high, or else by flights of steps that are added to OsmImport::raised, if there is
// room. Pieces are at most 4 m long, in the order of the ways.
std::vector<DeckPiece> solve_decks(OsmImport& in);

// Where a raised way ends in the air: no way goes on, and no house takes it.
struct DeckEnd {
    Vec2 at, out;  // and the direction in which it ends
    float height = 0;
    uint32_t piece = 0;  // whose start or end it is
    bool is_start = false;
};
std::vector<DeckEnd> open_ends(const OsmImport& in, const std::vector<DeckPiece>& decks);
// At the border of the map ways go on beyond.
bool is_at_border(const GroundPlan& plan, Vec2 p);
// Whether the ground along a line, so far to either side, is free of houses and walls and has none of these.
bool has_room(const OsmImport& in, const std::vector<Vec2>& line, float half,
              const std::vector<Surface>& not_on);
// Adds a flight of steps from the end to the ground; false where there is no room for one.
bool add_flight_down(OsmImport& in, const std::vector<DeckPiece>& decks, const DeckEnd& end);
// Stands a pier below each open end. Before the ground is laid.
void add_piers(OsmImport& in, const std::vector<DeckPiece>& decks);

// Takes the ground away from below what is too low to walk under. Before the ground is laid.
void clear_ground_below(OsmImport& in, const std::vector<DeckPiece>& decks);

// Decks with their pavements, steps, undersides and railings. After the ground is laid; indexes the city.
void lay_decks(OsmImport& in, const std::vector<DeckPiece>& decks);

// Rails on what is laid.
void lay_osm_rails(OsmImport& in, const std::vector<DeckPiece>& decks);

}  // namespace flaneur
