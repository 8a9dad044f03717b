#include "assets/measures/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr float k_unknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TrackTable track_table(const Trajectories& trajectories) {
    const std::vector<Sighting>& all = trajectories.sightings;
    TrackTable table{.of = &trajectories};
    for (uint32_t i = 0; i < all.size(); ++i) {
        if (i > 0 && all[i].frame == all[i - 1].frame) continue;
        table.frames.push_back(all[i].frame);
        table.begins.push_back(i);
    }
    table.begins.push_back(static_cast<uint32_t>(all.size()));
    table.by_person.resize(all.size());
    std::iota(table.by_person.begin(), table.by_person.end(), 0);
    std::sort(table.by_person.begin(), table.by_person.end(), [&](uint32_t a, uint32_t b) {
        return std::tuple(all[a].id, all[a].frame) < std::tuple(all[b].id, all[b].frame);
    });
    table.ranks.resize(all.size());
    for (uint32_t rank = 0; rank < all.size(); ++rank) {
        const uint32_t i = table.by_person[rank];
        table.ranks[i] = rank;
        if (rank > 0 && all[i].id == table.ids.back()) continue;
        table.ids.push_back(all[i].id);
        table.firsts.push_back(rank);
    }
    table.firsts.push_back(static_cast<uint32_t>(all.size()));
    return table;
}

std::span<const Sighting> seen_in(const TrackTable& table, size_t k) {
    return std::span(table.of->sightings).subspan(table.begins[k], table.begins[k + 1] - table.begins[k]);
}

std::span<const uint32_t> sightings_of(const TrackTable& table, size_t k) {
    return std::span(table.by_person).subspan(table.firsts[k], table.firsts[k + 1] - table.firsts[k]);
}

std::optional<uint32_t> later(const TrackTable& table, uint32_t sighting, int64_t frames) {
    const std::vector<Sighting>& all = table.of->sightings;
    const Sighting& from = all[sighting];
    const int64_t frame = from.frame + frames, rank = table.ranks[sighting] + frames;
    auto is_it = [&](uint32_t i) { return all[i].id == from.id && all[i].frame == frame; };
    // Without gaps, it is that many rows on; with some, it is nearer.
    if (rank >= 0 && rank < static_cast<int64_t>(all.size()) &&
        is_it(table.by_person[static_cast<size_t>(rank)]))
        return table.by_person[static_cast<size_t>(rank)];
    const auto here = table.by_person.begin() + table.ranks[sighting];
    const auto low = frames < 0 ? table.by_person.begin() + std::max<int64_t>(rank, 0) : here;
    const auto high =
        frames < 0 ? here
                   : table.by_person.begin() + std::min<int64_t>(rank + 1, static_cast<int64_t>(all.size()));
    const auto found = std::lower_bound(low, high, std::tuple(from.id, frame), [&](uint32_t i, auto key) {
        return std::tuple(all[i].id, static_cast<int64_t>(all[i].frame)) < key;
    });
    if (found == high || !is_it(*found)) return std::nullopt;
    return *found;
}

std::pair<size_t, size_t> frames_in(const TrackTable& table, FrameRange range) {
    const auto first = std::lower_bound(table.frames.begin(), table.frames.end(), range.first);
    const auto last = std::upper_bound(first, table.frames.end(), range.last);
    return {static_cast<size_t>(first - table.frames.begin()),
            static_cast<size_t>(last - table.frames.begin())};
}

std::vector<Vec2> velocities(const TrackTable& table, uint32_t step, AtEnds ends) {
    const std::vector<Sighting>& all = table.of->sightings;
    std::vector<Vec2> velocities(all.size(), {k_unknown, k_unknown});
    for (uint32_t i = 0; i < all.size(); ++i) {
        int64_t n = step;
        std::optional<uint32_t> before = later(table, i, -n), after = later(table, i, n);
        if (ends == AtEnds::adaptive)
            while ((!before || !after) && --n > 0) before = later(table, i, -n), after = later(table, i, n);
        if (ends == AtEnds::single_sided && before.has_value() != after.has_value())
            (before ? after : before) = i;
        if (!before || !after) continue;
        const float seconds = static_cast<float>(all[*after].frame - all[*before].frame) / table.of->fps;
        velocities[i] = (all[*after].at - all[*before].at) / seconds;
    }
    return velocities;
}

std::vector<float> speeds_of(std::span<const Vec2> velocities) {
    std::vector<float> speeds;
    speeds.reserve(velocities.size());
    for (Vec2 v : velocities) speeds.push_back(length(v));
    return speeds;
}

std::vector<float> speeds_along(std::span<const Vec2> velocities, Vec2 direction) {
    std::vector<float> speeds;
    speeds.reserve(velocities.size());
    const Vec2 along = direction / length(direction);
    for (Vec2 v : velocities) speeds.push_back(dot(v, along));
    return speeds;
}

std::vector<Vec2> accelerations(const TrackTable& table, uint32_t step) {
    const std::vector<Sighting>& all = table.of->sightings;
    std::vector<Vec2> accelerations(all.size(), {k_unknown, k_unknown});
    const int64_t n = 2 * static_cast<int64_t>(step);
    const float seconds = static_cast<float>(n) / table.of->fps;
    for (uint32_t i = 0; i < all.size(); ++i) {
        const std::optional<uint32_t> before = later(table, i, -n), after = later(table, i, n);
        if (!before || !after) continue;
        accelerations[i] =
            ((all[*after].at - all[i].at) - (all[i].at - all[*before].at)) / (seconds * seconds);
    }
    return accelerations;
}

}  // namespace flaneur
