#include "assets/terrain/terrain.h"

#include <zip.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>

#include "assets/files/file.h"

namespace flaneur {

namespace {

constexpr int k_border = 3;      // samples beyond the box that the spline reads, and one to spare
constexpr int k_fill_rings = 8;  // holes are filled so many samples deep
constexpr int64_t k_most_samples = 32'000'000;
constexpr int16_t k_srtm_hole = -32768;

// Reads so many bytes to `to`; false where they end early.
using ReadBytes = std::function<bool(void* to, size_t bytes)>;

std::string degrees(const LonLatBox& box) {
    char text[120];
    std::snprintf(text, sizeof text, "%.4f to %.4f degrees east, %.4f to %.4f north", box.west, box.east,
                  box.south, box.north);
    return text;
}

// "N43E007" in front: the tile's south-west corner.
std::optional<LonLatBox> tile_of(const std::string& name) {
    auto number = [&](size_t from, size_t digits) {
        int value = 0;
        for (size_t i = from; i < from + digits; ++i) {
            if (i >= name.size() || name[i] < '0' || name[i] > '9') return -1;
            value = value * 10 + (name[i] - '0');
        }
        return value;
    };
    int latitude = number(1, 2), longitude = number(4, 3);
    if (name.size() < 7 || latitude < 0 || latitude > 90 || longitude < 0 || longitude > 180) return {};
    char ns = name[0], ew = name[3];
    if ((ns != 'N' && ns != 'S' && ns != 'n' && ns != 's') ||
        (ew != 'E' && ew != 'W' && ew != 'e' && ew != 'w'))
        return {};
    double south = ns == 'S' || ns == 's' ? -latitude : latitude;
    double west = ew == 'W' || ew == 'w' ? -longitude : longitude;
    return LonLatBox{west, south, west + 1, south + 1};
}

// Holes take the mean of the samples beside them, ring after ring; what is left is sea.
void fill_holes(Terrain& terrain) {
    auto at = [&](int column, int row) -> float& {
        return terrain.heights[static_cast<size_t>(row) * static_cast<size_t>(terrain.columns) +
                               static_cast<size_t>(column)];
    };
    for (int ring = 0; ring < k_fill_rings; ++ring) {
        std::vector<std::pair<float*, float>> filled;
        for (int row = 0; row < terrain.rows; ++row) {
            for (int column = 0; column < terrain.columns; ++column) {
                if (!std::isnan(at(column, row))) continue;
                float sum = 0, count = 0;
                for (int r = std::max(0, row - 1); r <= std::min(terrain.rows - 1, row + 1); ++r) {
                    for (int c = std::max(0, column - 1); c <= std::min(terrain.columns - 1, column + 1);
                         ++c) {
                        if (std::isnan(at(c, r))) continue;
                        sum += at(c, r);
                        ++count;
                    }
                }
                if (count > 0) filled.push_back({&at(column, row), sum / count});
            }
        }
        if (filled.empty()) break;
        for (auto [to, height] : filled) *to = height;
    }
    for (float& height : terrain.heights) {
        if (std::isnan(height)) height = 0;
    }
}

Result<Terrain> read_tile(const std::string& path, const std::string& name, size_t bytes,
                          const LonLatBox& box, const ReadBytes& read) {
    std::optional<LonLatBox> tile = tile_of(name);
    if (!tile) {
        return Error{"The terrain " + path +
                     " does not say where it lies: an SRTM tile is called after its "
                     "south-west corner, as N43E007.hgt is. Give it its name back."};
    }
    int side = bytes == 2u * 1201 * 1201 ? 1201 : bytes == 2u * 3601 * 3601 ? 3601 : 0;
    if (side == 0) {
        return Error{
            "The terrain " + path + " has " + std::to_string(bytes) +
            " bytes; an SRTM tile has 2884802 (1201 samples a side) or 25934402 (3601). It may be cut "
            "short; download it again."};
    }
    Terrain terrain{tile->west, tile->north, 1.0 / (side - 1), 1.0 / (side - 1), side, side, {}};
    Result<TerrainWindow> window = terrain_window(path, terrain, box);
    if (!window) return window.error();
    terrain.west += window->first_column * terrain.step_east;
    terrain.north -= window->first_row * terrain.step_south;
    terrain.columns = window->columns;
    terrain.rows = window->rows;
    std::vector<uint8_t> row(static_cast<size_t>(side) * 2);
    for (int r = 0; r < window->first_row + window->rows; ++r) {
        if (!read(row.data(), row.size()))
            return Error{"The terrain " + path + " cannot be read to its end."};
        for (int c = window->first_column;
             r >= window->first_row && c < window->first_column + window->columns; ++c) {
            auto at = static_cast<size_t>(c) * 2;
            auto height = static_cast<int16_t>(static_cast<uint16_t>(row[at] << 8 | row[at + 1]));
            terrain.heights.push_back(height == k_srtm_hole ? std::numeric_limits<float>::quiet_NaN()
                                                            : height);
        }
    }
    return terrain;
}

Result<Terrain> read_hgt(const std::string& path, const LonLatBox& box) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    std::error_code unknown;
    uintmax_t bytes = std::filesystem::file_size(path, unknown);
    if (!file || unknown) return Error{"Cannot read the terrain " + path + ": check that it may be read."};
    return read_tile(path, std::filesystem::path(path).filename().string(), bytes, box,
                     [&](void* to, size_t size) { return std::fread(to, 1, size, file.get()) == size; });
}

// The first .hgt in the archive.
Result<Terrain> read_zipped_hgt(const std::string& path, const LonLatBox& box) {
    int wrong = 0;
    std::unique_ptr<zip_t, void (*)(zip_t*)> archive(zip_open(path.c_str(), ZIP_RDONLY, &wrong), zip_discard);
    if (!archive) {
        return Error{"The terrain " + path + " is no zip archive that can be read; download it again."};
    }
    zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        zip_stat_t about;
        if (zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &about) != 0) continue;
        if (!(about.valid & ZIP_STAT_NAME) || !(about.valid & ZIP_STAT_SIZE)) continue;
        std::filesystem::path name = about.name;
        if (!has_ending(about.name, ".hgt")) continue;
        std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
            zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(i), 0), zip_fclose);
        if (!file) break;
        return read_tile(path, name.filename().string(), about.size, box, [&](void* to, size_t size) {
            return zip_fread(file.get(), to, size) == static_cast<zip_int64_t>(size);
        });
    }
    return Error{"The terrain " + path + " has no .hgt file in it that can be read."};
}

}  // namespace

Result<TerrainWindow> terrain_window(const std::string& path, const Terrain& raster, const LonLatBox& box) {
    double east = raster.west + (raster.columns - 1) * raster.step_east;
    double south = raster.north - (raster.rows - 1) * raster.step_south;
    // A sample's width beyond the last one is as good as on it.
    if (box.west < raster.west - raster.step_east || box.east > east + raster.step_east ||
        box.south < south - raster.step_south || box.north > raster.north + raster.step_south) {
        char tile[60];
        double tile_south = std::floor(box.south), tile_west = std::floor(box.west);
        std::snprintf(tile, sizeof tile, "%c%02.0f%c%03.0f", tile_south < 0 ? 'S' : 'N',
                      std::fabs(tile_south), tile_west < 0 ? 'W' : 'E', std::fabs(tile_west));
        return Error{"The terrain " + path + " (" + degrees({raster.west, south, east, raster.north}) +
                     ") does not cover the map (" + degrees(box) + "); the SRTM tile that does begins with " +
                     tile + "."};
    }
    auto clamped = [](double at, int count) {
        return static_cast<int>(std::max(0.0, std::min(at, static_cast<double>(count - 1))));
    };
    int first_column = clamped((box.west - raster.west) / raster.step_east - k_border, raster.columns);
    int last_column = clamped((box.east - raster.west) / raster.step_east + k_border, raster.columns);
    int first_row = clamped((raster.north - box.north) / raster.step_south - k_border, raster.rows);
    int last_row = clamped((raster.north - box.south) / raster.step_south + k_border, raster.rows);
    TerrainWindow window{first_column, first_row, last_column - first_column + 1, last_row - first_row + 1};
    if (static_cast<int64_t>(window.columns) * window.rows > k_most_samples) {
        return Error{"The terrain " + path + " has more than " + std::to_string(k_most_samples) +
                     " samples within the map; resample it to some metres (gdalwarp -tr does)."};
    }
    return window;
}

Result<Terrain> read_terrain(const std::string& path, const LonLatBox& box) {
    std::error_code no_file;
    if (!std::filesystem::is_regular_file(path, no_file))
        return Error{"There is no file " + path + " to read the terrain from; check the path."};
    Result<Terrain> terrain = has_ending(path, ".hgt")   ? read_hgt(path, box)
                              : has_ending(path, ".zip") ? read_zipped_hgt(path, box)
                              : has_ending(path, ".tif") || has_ending(path, ".tiff")
                                  ? read_geotiff(path, box)
                                  : Error{"The terrain " + path +
                                          " is of a kind that is not read; give an SRTM "
                                          "tile (.hgt, .hgt.zip) or a GeoTIFF (.tif)."};
    if (!terrain) return terrain;
    auto is_hole = [](float height) { return std::isnan(height); };
    if (std::all_of(terrain->heights.begin(), terrain->heights.end(), is_hole))
        return Error{"The terrain " + path + " has nothing but voids where the map lies (" + degrees(box) +
                     "); take it from another source."};
    fill_holes(*terrain);
    return terrain;
}

float height_at(const Terrain& terrain, double longitude, double latitude) {
    double column = (longitude - terrain.west) / terrain.step_east;
    double row = (terrain.north - latitude) / terrain.step_south;
    column = std::max(0.0, std::min(column, static_cast<double>(terrain.columns - 1)));
    row = std::max(0.0, std::min(row, static_cast<double>(terrain.rows - 1)));
    auto weights = [](double t, double* w) {
        double s = 1 - t;
        w[0] = s * s * s / 6;
        w[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
        w[2] = (3 * s * s * s - 6 * s * s + 4) / 6;
        w[3] = t * t * t / 6;
    };
    double first_column = std::floor(column), first_row = std::floor(row), across[4], down[4];
    weights(column - first_column, across);
    weights(row - first_row, down);
    double height = 0;
    for (int r = 0; r < 4; ++r) {
        int y = std::clamp(static_cast<int>(first_row) + r - 1, 0, terrain.rows - 1);
        for (int c = 0; c < 4; ++c) {
            int x = std::clamp(static_cast<int>(first_column) + c - 1, 0, terrain.columns - 1);
            height += down[r] * across[c] *
                      static_cast<double>(
                          terrain.heights[static_cast<size_t>(y) * static_cast<size_t>(terrain.columns) +
                                          static_cast<size_t>(x)]);
        }
    }
    return static_cast<float>(height);
}

}  // namespace flaneur
