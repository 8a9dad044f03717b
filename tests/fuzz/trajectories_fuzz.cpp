// libFuzzer's target for trajectories: any bytes become places that are finite, in order, or are refused, and
// ground as well, or none.
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <tuple>

#include "assets/trajectories/geometry.h"
#include "assets/trajectories/trajectories.h"
#include "tests/folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    static const TestFolder folder;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (const Result<WalkableGeometry> ground = parse_geometry(bytes))
        for (const WalkablePolygon& polygon : ground->area)
            if (polygon.outer.size() < 3) std::abort();
    const Result<Trajectories> read = read_trajectories(folder.write("fuzz.bin", bytes));
    if (!read && !read.error().message.ends_with('.')) std::abort();
    if (!read) return 0;
    if (read->sightings.empty() || !(read->fps > 0)) std::abort();
    const Sighting* last = nullptr;
    for (const Sighting& s : read->sightings) {
        if (!std::isfinite(s.at.x + s.at.z + s.height + s.facing.x + s.facing.z)) std::abort();
        if (last && std::tuple(last->frame, last->id) >= std::tuple(s.frame, s.id)) std::abort();
        last = &s;
    }
    for (const WalkablePolygon& polygon : read->area)
        if (polygon.outer.size() < 3) std::abort();
    return 0;
}
