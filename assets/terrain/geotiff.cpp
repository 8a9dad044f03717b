// GeoTIFF: TIFF with the keys of OGC 19-008r4 that say where its samples lie.
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "assets/terrain/terrain.h"

namespace flaneur {

namespace {

// Tags.
constexpr uint32_t k_pixel_scale = 33550, k_tie_points = 33922, k_geo_keys = 34735, k_no_data = 42113;
// Keys of the directory, and values of theirs.
constexpr uint16_t k_model_type = 1024, k_raster_type = 1025, k_angular_units = 2054, k_projected = 3072,
                   k_vertical_units = 4099;
constexpr uint16_t k_geographic = 2, k_pixel_is_point = 2, k_degree = 9102, k_metre = 9001;

constexpr uint32_t k_widest = 100'000;  // samples a side
// Bytes, unpacked: of a tile or a row, of a strip, which is unpacked from its beginning, and of all tiles or
// strips that a window takes.
constexpr tmsize_t k_largest_block = 64 << 20, k_largest_strip = 256 << 20;
constexpr int64_t k_most_unpacked = int64_t{2} << 30;

struct CloseTiff {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffPtr = std::unique_ptr<TIFF, CloseTiff>;

int silent(TIFF*, void*, const char*, const char*, va_list) { return 1; }

// None where it cannot be opened. What libtiff has to say is not printed.
TiffPtr open_tiff(const std::string& path) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, k_largest_strip);  // whatever a tag says
    TIFFOpenOptionsSetErrorHandlerExtR(options, silent, nullptr);
    TIFFOpenOptionsSetWarningHandlerExtR(options, silent, nullptr);
    TiffPtr tiff(TIFFOpenExt(path.c_str(), "r", options));
    TIFFOpenOptionsFree(options);
    return tiff;
}

// The values of a tag that libtiff does not know; none where it is missing or of another type.
template <class T>
std::vector<T> values_of(TIFF* tiff, uint32_t tag, TIFFDataType type) {
    uint32_t count = 0;
    const void* data = nullptr;
    const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
    if (!field || TIFFFieldDataType(field) != type || !TIFFGetField(tiff, tag, &count, &data) || !data)
        return {};
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), data, count * sizeof(T));
    return values;
}

// A key whose value stands in the directory itself; 0: not there.
uint16_t key_of(const std::vector<uint16_t>& directory, uint16_t key) {
    for (size_t i = 4; i + 3 < directory.size(); i += 4) {
        if (directory[i] == key && directory[i + 1] == 0) return directory[i + 3];
    }
    return 0;
}

// Where the samples lie: west, north, steps, columns and rows; or why that cannot be known.
Result<Terrain> georeference(const std::string& path, TIFF* tiff) {
    auto refused = [&](const std::string& why) { return Error{"The terrain " + path + " " + why}; };
    uint32_t columns = 0, rows = 0;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &columns);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &rows);
    if (columns < 2 || rows < 2 || columns > k_widest || rows > k_widest)
        return refused("has " + std::to_string(columns) + " x " + std::to_string(rows) +
                       " samples; 2 to 100000 a side are read.");
    std::vector<double> scale = values_of<double>(tiff, k_pixel_scale, TIFF_DOUBLE);
    std::vector<double> tie = values_of<double>(tiff, k_tie_points, TIFF_DOUBLE);
    std::vector<uint16_t> keys = values_of<uint16_t>(tiff, k_geo_keys, TIFF_SHORT);
    if (scale.size() < 2 || tie.size() < 6 || keys.size() < 4)
        return refused(
            "is a TIFF that does not say where it lies (ModelPixelScale, ModelTiepoint and GeoKeyDirectory "
            "are "
            "wanted); export it as a GeoTIFF.");
    if (uint16_t model = key_of(keys, k_model_type); model != k_geographic) {
        uint16_t code = key_of(keys, k_projected);
        return refused("is in projected coordinates" +
                       (code > 0 && code < 32767 ? " (EPSG:" + std::to_string(code) + ")" : std::string()) +
                       ", not in longitude and latitude; gdalwarp -t_srs EPSG:4326 makes it so.");
    }
    uint16_t angle = key_of(keys, k_angular_units), height = key_of(keys, k_vertical_units);
    if (angle != 0 && angle != k_degree)
        return refused("is not in degrees; gdalwarp -t_srs EPSG:4326 makes it so.");
    if (height != 0 && height != k_metre)
        return refused("has heights that are not in metres (unit EPSG:" + std::to_string(height) +
                       "); convert it first.");
    // The tie point is a sample's middle, or the corner of the area that it stands for.
    double half = key_of(keys, k_raster_type) == k_pixel_is_point ? 0 : 0.5;
    Terrain terrain{tie[3] + (half - tie[0]) * scale[0],
                    tie[4] - (half - tie[1]) * scale[1],
                    scale[0],
                    scale[1],
                    static_cast<int>(columns),
                    static_cast<int>(rows),
                    {}};
    bool sound = scale[0] > 1e-7 && scale[1] > 1e-7 && scale[0] < 10 && scale[1] < 10 &&
                 std::fabs(terrain.west) < 1000 && std::fabs(terrain.north) < 1000;
    if (!sound) return refused("lies nowhere on earth, to go by its ModelTiepoint and ModelPixelScale.");
    return terrain;
}

// Adds the part of a row that lies in the window.
void take(Terrain& terrain, const TerrainWindow& window, int row, int first_column, int columns,
          const uint8_t* samples, bool floats, double no_data) {
    if (row < window.first_row || row >= window.first_row + window.rows) return;
    int begin = std::max(first_column, window.first_column);
    int end = std::min(first_column + columns, window.first_column + window.columns);
    for (int column = begin; column < end; ++column) {
        auto from = static_cast<size_t>(column - first_column);
        float height = 0;
        if (floats) {
            std::memcpy(&height, samples + from * 4, 4);
        } else {
            int16_t whole = 0;
            std::memcpy(&whole, samples + from * 2, 2);
            height = whole;
        }
        bool sound = height > -1000 && height < 10000 && static_cast<double>(height) != no_data;
        auto to = static_cast<size_t>(row - window.first_row) * static_cast<size_t>(window.columns) +
                  static_cast<size_t>(column - window.first_column);
        if (sound) terrain.heights[to] = height;
    }
}

bool read_tiles(TIFF* tiff, Terrain& terrain, const TerrainWindow& window, bool floats, double no_data) {
    uint32_t width = 0, height = 0;
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
    tmsize_t size = TIFFTileSize(tiff);
    if (width == 0 || height == 0 || width > k_widest || height > k_widest || size <= 0 ||
        size > k_largest_block)
        return false;
    std::vector<uint8_t> tile(static_cast<size_t>(size));
    int w = static_cast<int>(width), h = static_cast<int>(height);
    int top = window.first_row / h * h, bottom = window.first_row + window.rows;
    int left = window.first_column / w * w, right = window.first_column + window.columns;
    int64_t tiles = (int64_t{bottom} - top + h - 1) / h * ((int64_t{right} - left + w - 1) / w);
    if (size > k_most_unpacked / tiles) return false;
    for (int y = top; y < bottom; y += h) {
        for (int x = left; x < right; x += w) {
            if (TIFFReadTile(tiff, tile.data(), static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0, 0) < 0)
                return false;
            size_t row_bytes = width * (floats ? 4u : 2u);
            for (int r = 0; r < h && (static_cast<size_t>(r) + 1) * row_bytes <= tile.size(); ++r)
                take(terrain, window, y + r, x, w, &tile[static_cast<size_t>(r) * row_bytes], floats,
                     no_data);
        }
    }
    return true;
}

bool read_strips(TIFF* tiff, Terrain& terrain, const TerrainWindow& window, bool floats, double no_data,
                 int columns, int rows) {
    tmsize_t size = TIFFScanlineSize(tiff);
    if (size < static_cast<tmsize_t>(columns) * (floats ? 4 : 2) || size > k_largest_block) return false;
    // A strip's rows come one after the other.
    uint32_t high = 0;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &high);
    int strip = static_cast<int>(std::clamp<uint32_t>(high, 1, static_cast<uint32_t>(rows)));
    int first = window.first_row / strip * strip, last = window.first_row + window.rows;
    if (size > k_largest_strip / strip || size > k_most_unpacked / (last - first)) return false;
    std::vector<uint8_t> row(static_cast<size_t>(size));
    for (int r = first; r < last; ++r) {
        if (TIFFReadScanline(tiff, row.data(), static_cast<uint32_t>(r), 0) < 0) return false;
        take(terrain, window, r, 0, columns, row.data(), floats, no_data);
    }
    return true;
}

}  // namespace

Result<Terrain> read_geotiff(const std::string& path, const LonLatBox& box) {
    TiffPtr tiff = open_tiff(path);
    if (!tiff)
        return Error{"The terrain " + path + " is no TIFF that can be read; download or export it again."};
    Result<Terrain> found = georeference(path, tiff.get());
    if (!found) return found;
    uint16_t bits = 0, format = SAMPLEFORMAT_UINT, samples = 0;
    TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &format);
    TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &samples);
    bool floats = bits == 32 && format == SAMPLEFORMAT_IEEEFP;
    if (samples != 1 || !(floats || (bits == 16 && format == SAMPLEFORMAT_INT)))
        return Error{"The terrain " + path + " has " + std::to_string(samples) + " values a sample, of " +
                     std::to_string(bits) +
                     " bits; one of 16-bit signed whole numbers or 32-bit floats is read "
                     "(gdal_translate -ot Float32 makes it so)."};
    Result<TerrainWindow> window = terrain_window(path, *found, box);
    if (!window) return window.error();
    Terrain terrain = *found;
    terrain.west += window->first_column * terrain.step_east;
    terrain.north -= window->first_row * terrain.step_south;
    terrain.columns = window->columns;
    terrain.rows = window->rows;
    terrain.heights.assign(static_cast<size_t>(window->columns) * static_cast<size_t>(window->rows),
                           std::numeric_limits<float>::quiet_NaN());
    std::vector<char> text = values_of<char>(tiff.get(), k_no_data, TIFF_ASCII);
    text.push_back('\0');
    double no_data = text.size() > 1 ? std::strtod(text.data(), nullptr) : -32768;
    bool whole = TIFFIsTiled(tiff.get()) ? read_tiles(tiff.get(), terrain, *window, floats, no_data)
                                         : read_strips(tiff.get(), terrain, *window, floats, no_data,
                                                       found->columns, found->rows);
    if (!whole)
        return Error{"The terrain " + path +
                     " cannot be read to its end, or is packed in a way or in strips that are not read; "
                     "convert it with gdal_translate -co TILED=YES."};
    return terrain;
}

}  // namespace flaneur
