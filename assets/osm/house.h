// What tags say of a building or a part of one, and what is usual where they are silent.
#pragma once

#include "assets/osm/map.h"
#include "assets/plan/masses.h"

namespace flaneur {

// What stands around a building, for what its tags leave open.
struct OsmSurroundings {
    float storeys = 4;     // usual near by
    bool pitched = false;  // small houses have pitched roofs there
    bool tiles = false;    // of terracotta
    bool old = false;      // in an old town: narrow lanes without traffic, wall to wall
};

struct OsmHouse {
    float bottom = 0, top = 3;  // above its lowest ground, metres; the top with its roof
    float storey = 3.2f;
    RoofKind roof = RoofKind::flat;
    float roof_height = 0;  // part of the height; of a flat roof a parapet's, on top of it
    Vec2 ridge;             // as in Mass
    uint8_t style = 0;
    uint32_t wall_colour = 0, roof_colour = 0;  // as in Building
    Finish finish = Finish::windows;
    bool canopy = false;          // a roof on posts: its top half metre is all there is
    bool default_height = false;  // neither height nor storeys were said
};

// `whole` are the tags of the building that it is a part of; its own where it is none.
OsmHouse house_of(const OsmTags& tags, const OsmTags& whole, const Region& outline,
                  const OsmSurroundings& around, uint64_t id);

// What is on the walls. `type` is the kind of building, `breadth` and `height` are metres.
Finish finish_of(const OsmTags& tags, const OsmTags& whole, std::string_view type, float breadth,
                 float height);
// By the kind of building, or of what is none, alone.
std::optional<Finish> named_finish(std::string_view name);
// A tower, a column, a monument and the like, which the map may not call a building; empty where it is none.
std::string_view structure_of(const OsmTags& tags);
// Whether man_made says that one stands there, though no building may be drawn.
bool is_structure(const OsmTags& tags);
// The outline of one that is a point of the map; none for what is none.
std::optional<Ring> round_structure(const OsmTags& tags, Vec2 at);
// Churches and mosques and their like: halls with tall windows.
bool is_hall_of_prayer(std::string_view type);

// What the map says of a building's storeys, by its height if need be.
std::optional<float> known_storeys(const OsmTags& tags);

// Garages, sheds, canopies and the like.
bool is_outbuilding(const OsmTags& tags);

// sRGB of "#a5694f", "#fff" or a name that is usual on maps, brought near to the colours of the house. 0 for
// anything else.
uint32_t parse_colour(std::string_view text, bool roof);

}  // namespace flaneur
