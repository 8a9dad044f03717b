// Cities from nothing and from maps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assets/city.h"
#include "assets/place.h"
#include "sim/base/result.h"

namespace flaneur {

struct DistrictOptions {
    uint64_t seed = 1;
    int blocks = 4;      // blocks along each side, 1..32
    bool trams = false;  // with two blocks or more, an avenue from edge to edge has a pair of tracks
};

// The built-in district: bent streets of several widths with 0.12 m kerbs, sidewalks and crossings, lanes for
// people on foot, rows of houses around courtyards, villas, slabs; a square with a flight of steps up to a
// church; with two blocks or more a park and a hill with a stair street; with three or more an avenue cut
// through at a slant. Country lies around it. Indexed, ready for use.
City generate_district(const DistrictOptions& options);

struct CityOptions {
    std::string terrain;  // under a map: an SRTM tile or a GeoTIFF, see docs/city.md; empty: level ground
    float scale = 1;      // of a glTF scene: metres to a unit
    // Of a map: draws the square that reaches `radius` metres to each side of `center`. Without a center that
    // is where there is most to see; without a radius, the whole map if it can be built in some 30 s on two
    // cores, else as much of it, and 1200 m about a given center.
    std::optional<MapPlace> center{};
    float radius = 0;  // k_least_map_radius..k_most_map_radius; 0: none
    TellProgress tell{};
};

// An OpenStreetMap extract (.osm, .osm.pbf), projected to metres about its middle: +x east, +z south, +y up.
// With terrain, y = 0 is the sea where the map has sea, and else the lowest ground. Of a map that is larger
// than what is drawn no more is kept while it is read; a note says what was chosen.
// Refuses an extract with neither buildings nor roads, and terrain that does not cover the map.
Result<City> load_osm(const std::string& path, const CityOptions& options = {});

// A city from a file: a glTF scene (.glb, .gltf, see docs/city.md) or an OpenStreetMap extract. Refuses
// terrain and a center or radius of a glTF scene.
Result<City> load_city(const std::string& path, const CityOptions& options = {});

// sRGB wall colours that Building::style chooses from, R in the lowest byte.
extern const uint32_t k_wall_colours[];
extern const int k_wall_colour_count;

}  // namespace flaneur
