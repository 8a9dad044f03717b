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
    uint32_t street = 0;  // index into OsmImport::raised
    uint32_t line = 0;    // index into its lines
};

// How high raised ways lie: at the terrain where they meet ways on the ground, a level's height above it
// where they cross something or belong to walkways that touch the ground by steps only, as far as the slope
// allows that people and cars can climb, and evenly between. Pieces are at most 4 m long, in the order of the
// ways.
std::vector<DeckPiece> solve_decks(const OsmImport& in);

// Takes the ground away from below what is too low to walk under. Before the ground is laid.
void clear_ground_below(OsmImport& in, const std::vector<DeckPiece>& decks);

// Decks with their pavements, steps, undersides and railings. After the ground is laid; indexes the city.
void lay_decks(OsmImport& in, const std::vector<DeckPiece>& decks);

// Rails on what is laid.
void lay_osm_rails(OsmImport& in, const std::vector<DeckPiece>& decks);

}  // namespace flaneur
