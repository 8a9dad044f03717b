// libFuzzer's target for maps: any bytes become a sound city or are refused.
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "assets/cities.h"
#include "assets/osm/map.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    std::string_view bytes(reinterpret_cast<const char*>(data), size);
    auto map = parse_osm(bytes, size > 0 && data[0] == '<' ? "osm" : "pbf");
    if (!map) return 0;
    auto city = city_of(*map, "fuzz", {});
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
