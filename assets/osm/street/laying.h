// Roads and tracks of a map while they are laid. Private to assets/osm/street.
#pragma once

#include <map>

#include "assets/osm/map.h"
#include "sim/lanes/lanes.h"

namespace flaneur {

struct Laying {
    const OsmImport& in;
    Vec2 low, high;
    std::map<int64_t, uint32_t> uses;   // by node of the map, how often carriageways come to it
    std::map<int64_t, uint32_t> nodes;  // those that are nodes of the plan
    RoadPlan plan;
};

// Roads like `like` along a way, from node to node, and to gates where it leaves the map.
void lay_along(Laying& laying, const OsmWay& way, const Road& like);
// Roads that the extract cuts off lead out of it.
void open_ends(Laying& laying);
// Adds tracks of trams on the ground, and their stops. One that says no direction is driven as the side of
// traffic has it of two that lie side by side, and else as it was drawn.
void add_tram_tracks(Laying& laying);

}  // namespace flaneur
