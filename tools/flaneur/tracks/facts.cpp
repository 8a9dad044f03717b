#include "tools/flaneur/tracks/facts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>

#include "sim/base/math.h"

namespace flaneur {
namespace {

double two_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return std::strtod(text, nullptr);
}

const char* name_of(HeightsOf heights) {
    switch (heights) {
        case HeightsOf::nothing:
            return "none";
        case HeightsOf::ground:
            return "of the ground";
        case HeightsOf::heads:
            return "of heads";
    }
    return "none";
}

const char* name_of(TrackedKind kind) {
    constexpr const char* k_names[] = {"people", "bicycles", "cars", "vans", "buses", "trams"};
    return k_names[static_cast<size_t>(kind)];
}

// Sightings by id, then by frame.
std::vector<uint32_t> by_person(const Trajectories& tracks) {
    std::vector<uint32_t> order(tracks.sightings.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return tracks.sightings[a].id < tracks.sightings[b].id; });
    return order;
}

}  // namespace

nlohmann::ordered_json facts_of(const Trajectories& tracks) {
    nlohmann::ordered_json facts;
    facts["kind"] = "trajectories";
    facts["format"] = tracks.format;
    std::vector<double> speeds;
    size_t everybody = 0, gaps = 0;
    const Sighting* last = nullptr;
    std::vector<size_t> kinds(6);
    auto tracked = tracks.tracked.begin();
    for (const uint32_t i : by_person(tracks)) {
        const Sighting& s = tracks.sightings[i];
        if (!last || last->id != s.id) {
            ++everybody;
            while (tracked != tracks.tracked.end() && tracked->id < s.id) ++tracked;
            const bool is_told = tracked != tracks.tracked.end() && tracked->id == s.id;
            ++kinds[is_told ? static_cast<size_t>(tracked->kind) : 0];
        } else {
            gaps += s.frame > last->frame + 1;
            const double way = wide(length(s.at - last->at));
            if (way > 0) speeds.push_back(way * wide(tracks.fps) / (s.frame - last->frame));
        }
        last = &s;
    }
    for (size_t kind = 0; kind < kinds.size(); ++kind)
        if (kinds[kind] > 0 || kind == 0) facts[name_of(static_cast<TrackedKind>(kind))] = kinds[kind];
    const uint32_t first = tracks.sightings.front().frame, end = tracks.sightings.back().frame;
    std::vector<size_t> at_once(1);
    uint32_t frame = first;
    for (const Sighting& s : tracks.sightings) {
        if (s.frame != frame) at_once.push_back(0), frame = s.frame;
        ++at_once.back();
    }
    facts["most_at_once"] = *std::max_element(at_once.begin(), at_once.end());
    facts["frames"] = {first, end};
    facts["frames_a_second"] = two_digits(wide(tracks.fps));
    facts["seconds"] = two_digits((end - first) / wide(tracks.fps));
    facts["gaps"] = gaps;
    Vec2 low = tracks.sightings[0].at, high = low;
    float lowest = tracks.sightings[0].height, highest = lowest;
    for (const Sighting& s : tracks.sightings) {
        low = {std::min(low.x, s.at.x), std::min(low.z, s.at.z)};
        high = {std::max(high.x, s.at.x), std::max(high.z, s.at.z)};
        lowest = std::min(lowest, s.height), highest = std::max(highest, s.height);
    }
    facts["width_m"] = two_digits(wide(high.x - low.x));
    facts["depth_m"] = two_digits(wide(high.z - low.z));
    std::sort(speeds.begin(), speeds.end());
    facts["usual_metres_a_second"] = speeds.empty() ? 0 : two_digits(speeds[speeds.size() / 2]);
    facts["heights"] = name_of(tracks.heights);
    if (tracks.heights != HeightsOf::nothing)
        facts["lowest_and_highest_m"] = {two_digits(wide(lowest)), two_digits(wide(highest))};
    facts["polygons"] = tracks.area.size();
    facts["holes"] = std::accumulate(
        tracks.area.begin(), tracks.area.end(), size_t{0},
        [](size_t sum, const WalkablePolygon& polygon) { return sum + polygon.holes.size(); });
    facts["walls"] = tracks.walls.size();
    facts["notes"] = tracks.assumed;
    return facts;
}

}  // namespace flaneur
