// libFuzzer's target for maps: any bytes become a sound city or are refused. How they begin says how they are
// packed; every other map is read from a file, and what lies about one place of it drawn.
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "assets/cities.h"
#include "assets/osm/map.h"
#include "tests/folder.h"

namespace {

using namespace flaneur;

// libosmium does not close a file whose blobs it cannot read; a million such files would be one too many.
void close_all(const std::string& path) {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code gone;
        if (std::filesystem::read_symlink(entry, gone) == path) close(std::stoi(entry.path().filename()));
    }
}

Result<City> city_of_bytes(std::string_view bytes) {
    const char* format = bytes.starts_with("<")          ? "osm"
                         : bytes.starts_with("\x1f\x8b") ? "osm.gz"
                         : bytes.starts_with("BZh")      ? "osm.bz2"
                                                         : "pbf";
    if (bytes.size() % 2 != 0) {
        static const TestFolder folder;
        const std::string path = folder.write(std::string("fuzz.") + format, bytes);
        auto city = load_osm(path, {"", 1, MapPlace{0.0003, 0.0003}, 100});
        if (!city) close_all(path);
        return city;
    }
    auto map = parse_osm(bytes, format);
    return map ? city_of(*map, "fuzz", {}) : map.error();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    auto city = city_of_bytes({reinterpret_cast<const char*>(data), size});
    if (!city) return 0;
    for (uint32_t i : city->ground.indices)
        if (i >= city->ground.vertices.size()) std::abort();
    for (uint32_t i : city->roof_indices)
        if (i >= city->roof_vertices.size()) std::abort();
    for (const Vec3& v : city->roof_vertices)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) std::abort();
    for (const Face& f : city->ground.faces)
        if (!std::isfinite(f.a.y) || !std::isfinite(f.b_top)) std::abort();
    return 0;
}
