// Heights of the ground from elevation files, as smooth ground.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

// Degrees; west <= east, south <= north.
struct LonLatBox {
    double west = 0, south = 0, east = 0, north = 0;
};

// Samples at equal steps of longitude and latitude, rows from north to south.
struct Terrain {
    double west = 0, north = 0;            // of the first sample, degrees
    double step_east = 0, step_south = 0;  // between samples, degrees, above 0
    int columns = 0, rows = 0;
    std::vector<float> heights;  // metres above the sea
};

// Reads what `box` needs of an SRTM tile (.hgt of 1201 or 3601 samples a side, also in a .zip; its name says
// where it lies, as N43E007.hgt does) or of a GeoTIFF (.tif; 16-bit whole numbers or 32-bit floats, in strips
// or tiles, longitude and latitude in degrees, metres). Holes are filled from their surroundings; what lies
// far from any sample is sea, 0 m high. Refuses other kinds, and files that do not cover the box.
Result<Terrain> read_terrain(const std::string& path, const LonLatBox& box);

// The uniform cubic B-spline over the samples: it smooths their noise, has no edges, and stays between the
// lowest and the highest of the 16 samples about it. Beyond the samples the border goes on.
float height_at(const Terrain& terrain, double longitude, double latitude);

// For the readers of the formats: the samples that `box` needs, of a raster of columns x rows whose first
// sample lies at (west, north). None, and why, where the raster does not cover the box.
struct TerrainWindow {
    int first_column = 0, first_row = 0, columns = 0, rows = 0;
};
Result<TerrainWindow> terrain_window(const std::string& path, const Terrain& raster, const LonLatBox& box);
Result<Terrain> read_geotiff(const std::string& path, const LonLatBox& box);

}  // namespace flaneur
