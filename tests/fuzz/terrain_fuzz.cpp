// libFuzzer's target for terrain: any bytes become heights that are finite or are refused. How they begin
// says whether they are an archive, a TIFF or a tile; of tiles, whose size says what they are, every other
// one is drawn out to it.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "assets/terrain/terrain.h"
#include "tests/folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    static const TestFolder folder;
    constexpr LonLatBox k_box{7.41, 43.73, 7.42, 43.74};
    constexpr size_t k_tile_bytes = 2 * 1201 * 1201;
    std::string_view bytes(reinterpret_cast<const char*>(data), size);
    bool zip = bytes.starts_with("PK"), tiff = bytes.starts_with("II") || bytes.starts_with("MM");
    std::string path = folder.write(zip ? "fuzz.zip" : tiff ? "fuzz.tif" : "N43E007.hgt", bytes);
    if (!zip && !tiff && size % 2 == 0) std::filesystem::resize_file(path, k_tile_bytes);
    auto terrain = read_terrain(path, k_box);
    if (!terrain) return 0;
    if (terrain->heights.size() != static_cast<size_t>(terrain->columns) * static_cast<size_t>(terrain->rows))
        std::abort();
    for (float height : terrain->heights)
        if (!std::isfinite(height)) std::abort();
    for (double longitude : {-200.0, k_box.west, 7.4151, k_box.east, 200.0})
        for (double latitude : {-90.0, k_box.south, 43.7349, k_box.north, 90.0})
            if (!std::isfinite(height_at(*terrain, longitude, latitude))) std::abort();
    return 0;
}
