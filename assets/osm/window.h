// How much of a map is drawn: all of it, or a square about a place. Private to assets/osm.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/cities.h"
#include "assets/osm/map.h"

namespace flaneur {

// West, south, east and north, degrees. East may be beyond 180.
using OsmBox = std::array<double, 4>;

// Degrees of latitude, north or south, beyond which maps are projected about the pole.
inline constexpr double k_polar = 84;

OsmWindow window_about(const MapPlace& middle, float half);
// Whether a place lies in the window, or no more than `beyond` metres from it.
bool is_within(const OsmWindow& window, double longitude, double latitude, float beyond = 0);
// The same longitude, no more than half round the Earth from `about`.
double near_longitude(double longitude, double about);
// "52.5163,13.3777", as --center takes it, to some ten metres.
std::string shown_place(const MapPlace& place);

// A house or street of a map: where its first node is, how much there is to see in it, and how many nodes it
// has, which tell how long it takes to build.
struct OsmSight {
    double longitude = 0, latitude = 0;
    float interest = 0, nodes = 0;
};
// Of so many of them every second is left out, and counts twice.
inline constexpr size_t k_osm_most_sights = 1 << 20;
// Of a way with these tags, without its place; without nodes if it is neither.
OsmSight sight_of(std::string_view highway, std::string_view building, size_t nodes);
std::vector<OsmSight> sights_of(const OsmMap& map);
// Those of the map in a file, read without keeping it.
Result<std::vector<OsmSight>> survey_osm(const std::string& path, const TellProgress& tell);

// The box that the file states, or else that of its buildings and streets. None where there are neither.
std::optional<OsmBox> extent_of(const OsmMap& map);

struct OsmChoice {
    bool is_whole = false;       // all can be built in the time that somebody waits for it
    float width = 0, depth = 0;  // of all, metres
    OsmWindow window;            // else the widest square for which that holds, where there is most to see
};
// `extent`: of the map, where that is known; sights outside do not count. `radius`, if not 0, is the
// window's.
OsmChoice choose_window(const std::vector<OsmSight>& sights, const std::optional<OsmBox>& extent,
                        float radius);

// What of a map in memory the window touches; see cut_to.
OsmMap cut_map(const OsmMap& map, const OsmWindow& window);

// What is to be drawn of the map in a file, with a note where nobody chose it and that is not all. Where the
// middle is given, or the map holds too much, what lies outside is not kept while it is read.
Result<OsmMap> read_drawn(const std::string& path, const CityOptions& options);

}  // namespace flaneur
