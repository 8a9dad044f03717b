// Places on Earth, and how much of a map about one is drawn.
#pragma once

#include <functional>
#include <string_view>

namespace flaneur {

// Degrees on the WGS84 ellipsoid.
struct MapPlace {
    double latitude = 0, longitude = 0;  // -90..90 north, -180..180 east
    bool operator==(const MapPlace&) const = default;
};

// How far a city that is cut out of a map may reach from its middle to each side, metres: as far as
// one navigation mesh does in the densest streets that were measured.
inline constexpr double k_least_map_radius = 100, k_most_map_radius = 3000;

// Where a city comes from on Earth.
struct OnEarth {
    MapPlace middle;   // of what is drawn: the origin
    float radius = 0;  // to each side of it, metres, where the map was cut; 0: the whole map is drawn
    // The whole map's, metres; 0 where nobody knows.
    float map_width = 0, map_depth = 0;
};

// Whether one drives on the left there, by coarse outlines of the lands where one does.
bool is_driven_on_left(const MapPlace& place);

// What is being done, and how much of it is: 0..1.
using TellProgress = std::function<void(std::string_view what, float done)>;

}  // namespace flaneur
