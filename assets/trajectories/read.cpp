#include <algorithm>
#include <cmath>
#include <tuple>

#include "assets/files/file.h"
#include "assets/trajectories/formats.h"

namespace flaneur {
namespace {

constexpr size_t k_most_bytes = size_t{1} << 30;
constexpr double k_farthest = 1e5;  // metres
constexpr int64_t k_last_frame = 100'000'000;

// The same without a reader's subject before it.
Result<Trajectories> parsed(const std::string& path, Result<Trajectories> (*parse)(std::string_view)) {
    const Result<Bytes> bytes = read_bytes(path, k_most_bytes);
    if (!bytes) return bytes.error();
    return parse({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace

Result<void> add_sighting(Trajectories& to, int64_t frame, int64_t id, double x, double y, double z) {
    if (to.sightings.size() >= k_most_sightings)
        return Error{"more than " + std::to_string(k_most_sightings) + " positions, which are too many"};
    if (frame < 0 || frame > k_last_frame)
        return Error{"frame " + std::to_string(frame) + ", which is not from 0 to " +
                     std::to_string(k_last_frame)};
    if (id < 0 || id > int64_t{UINT32_MAX}) return Error{"somebody with the number " + std::to_string(id)};
    if (!(std::fabs(x) <= k_farthest) || !(std::fabs(y) <= k_farthest) || !(std::fabs(z) <= k_farthest))
        return Error{"a place that is not finite or lies beyond 100 km"};
    to.sightings.push_back({static_cast<uint32_t>(frame),
                            static_cast<uint32_t>(id),
                            {static_cast<float>(x), 0 - static_cast<float>(y)},
                            static_cast<float>(z),
                            {}});
    return {};
}

Result<void> settle_trajectories(Trajectories& t) {
    if (!(t.fps > 0 && t.fps <= 1000))
        return Error{"has a rate of frames that is not from 0 to 1000 a second"};
    if (t.sightings.empty()) return Error{"has nobody in it"};
    auto key = [](const Sighting& s) { return std::tuple(s.frame, s.id); };
    std::sort(t.sightings.begin(), t.sightings.end(),
              [&](const Sighting& a, const Sighting& b) { return key(a) < key(b); });
    const auto twice =
        std::adjacent_find(t.sightings.begin(), t.sightings.end(),
                           [&](const Sighting& a, const Sighting& b) { return key(a) == key(b); });
    if (twice != t.sightings.end())
        return Error{"has number " + std::to_string(twice->id) + " twice in frame " +
                     std::to_string(twice->frame)};
    return {};
}

Result<Trajectories> read_trajectories(const std::string& path) {
    if (Result<void> found = find_file(path); !found)
        return Error{"Nobody's ways are read: " + found.error().message};
    Result<Trajectories> read =
        Error{"has an ending that tells no format: .txt, .csv, .sqlite, .h5 and .hdf5 are read"};
    if (has_ending(path, ".txt")) read = parsed(path, parse_petrack);
    if (has_ending(path, ".csv")) read = parsed(path, parse_trajectory_csv);
    if (has_ending(path, ".sqlite")) read = read_jupedsim(path);
    if (has_ending(path, ".h5") || has_ending(path, ".hdf5")) read = parsed(path, parse_juelich);
    Result<void> settled = read ? settle_trajectories(*read) : read.error();
    if (settled) return read;
    std::string why = settled.error().message;
    if (why.ends_with('.')) why.pop_back();
    return Error{"Nobody's ways are read, for " + path + " " + why + "."};
}

}  // namespace flaneur
