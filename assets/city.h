// Cities from nothing and from maps.
#pragma once

#include <cstdint>
#include <string>

#include "sim/base/result.h"
#include "sim/city/city.h"

namespace flaneur {

struct DistrictOptions {
    uint64_t seed = 1;
    int blocks = 4;  // blocks along each side, 1..32
};

// The built-in district: streets, sidewalks with 0.12 m kerbs and crossings, blocks of buildings, a square, a
// flight of steps up to a terrace, and from two blocks on a sloping street. Indexed, ready for use.
City generate_district(const DistrictOptions& options);

// An OpenStreetMap extract (.osm, .osm.pbf), projected to metres about its middle: +x east, +z south, +y up.
// Refuses an extract with neither buildings nor roads.
Result<City> load_osm(const std::string& path);

// sRGB wall colours that Building::style chooses from, R in the lowest byte.
extern const uint32_t k_wall_colours[];
extern const int k_wall_colour_count;

}  // namespace flaneur
