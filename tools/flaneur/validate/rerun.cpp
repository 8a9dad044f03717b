// People whom others have measured: where they are looked at, and a corridor of them walked once more.
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/math.h"
#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/validate/play.h"
#include "tools/flaneur/validate/tests.h"

namespace flaneur {
namespace {

constexpr float k_beyond = 0.2f, k_end = 4;    // metres
constexpr float k_more = 60;                   // seconds
constexpr double k_first = 0.2, k_last = 0.8;  // of the time that is looked at

float at_share(std::vector<float> values, double share) {
    const auto at = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

struct Coordinates {
    std::vector<float> x, z;
};
Coordinates coordinates_of(const Trajectories& tracks) {
    Coordinates all;
    for (const Sighting& s : tracks.sightings) all.x.push_back(s.at.x), all.z.push_back(s.at.z);
    return all;
}

Rectangle box_of(const Trajectories& tracks) {
    constexpr double k_least = 0.002;
    const Coordinates all = coordinates_of(tracks);
    return widened({{at_share(all.x, k_least), at_share(all.z, k_least)},
                    {at_share(all.x, 1 - k_least), at_share(all.z, 1 - k_least)}},
                   k_beyond);
}

// All of the width, the middle 4 m of the length.
Rectangle middle_of(const Rectangle& box) {
    const float middle = (box.low.x + box.high.x) / 2;
    return {{middle - 2, box.low.z}, {middle + 2, box.high.z}};
}

double seconds_of(const Trajectories& tracks) {
    return (tracks.sightings.back().frame - tracks.sightings.front().frame) / wide(tracks.fps);
}

using Ways = std::map<uint32_t, std::vector<Sighting>>;
Ways ways_of(const Trajectories& tracks) {
    Ways ways;
    for (const Sighting& s : tracks.sightings) ways[s.id].push_back(s);
    return ways;
}

// What somebody likes to walk at: faster than that they went in a twentieth of the time, by seconds.
float liked_speed(const std::vector<Sighting>& way, float fps) {
    const auto second = static_cast<size_t>(std::max(1L, std::lround(fps)));
    std::vector<float> speeds;
    for (size_t i = 0; i + second < way.size(); ++i)
        speeds.push_back(length(way[i + second].at - way[i].at) * fps /
                         static_cast<float>(way[i + second].frame - way[i].frame));
    return speeds.empty() ? 1.34f : clamp(at_share(speeds, 0.95), 0.3f, 2);
}

// The corridor lies along x: turned so, if it does not.
Trajectories along_x(Trajectories tracks) {
    const Rectangle box = box_of(tracks);
    if (box.high.x - box.low.x >= box.high.z - box.low.z) return tracks;
    for (Sighting& s : tracks.sightings) s.at = {s.at.z, -s.at.x};
    tracks.area.clear();
    return tracks;
}

std::vector<Guest> guests_of(const Trajectories& tracks, const Rectangle& box) {
    std::vector<Guest> guests;
    const uint32_t start = tracks.sightings[0].frame;
    for (const auto& [id, way] : ways_of(tracks)) {
        const Vec2 first = way.front().at, last = way.back().at;
        const bool east = last.x > first.x;
        const float z = clamp(last.z, box.low.z + 0.3f, box.high.z - 0.3f);
        const size_t soon = std::min(way.size() - 1, static_cast<size_t>(tracks.fps / 2));
        const Vec2 velocity = soon > 0 ? (way[soon].at - first) *
                                             (tracks.fps / static_cast<float>(way[soon].frame - way[0].frame))
                                       : Vec2{};
        Guest guest{.from = at_height(first, 0),
                    .goal = {east ? box.high.x + k_end - 0.5f : box.low.x - k_end + 0.5f, 0, z},
                    .exit = {{last.x, box.low.z - 9}, {box.high.x + 9, box.high.z + 9}},
                    .speed = liked_speed(way, tracks.fps),
                    .heading = east ? k_east : -k_east,
                    .enters = static_cast<float>(way[0].frame - start) / tracks.fps,
                    .velocity = velocity};
        guest.starts = guest.enters;
        if (!east) guest.exit = {{box.low.x - 9, box.low.z - 9}, {last.x, box.high.z + 9}};
        guests.push_back(guest);
    }
    return guests;
}

}  // namespace

std::vector<WalkablePolygon> area_or_box(const Trajectories& tracks) {
    if (!tracks.area.empty()) return tracks.area;
    const Rectangle box = box_of(tracks);
    return {{{box.low, {box.high.x, box.low.z}, box.high, {box.low.x, box.high.z}}, {}}};
}

Rectangle busiest_square(const Trajectories& tracks) {
    const Coordinates all = coordinates_of(tracks);
    const Vec2 middle{at_share(all.x, 0.5), at_share(all.z, 0.5)};
    return widened({middle, middle}, 1);
}

bool is_corridor(const Trajectories& measured) {
    constexpr int k_parts = 5;
    const Trajectories tracks = along_x(measured);
    const Rectangle box = box_of(tracks);
    const Vec2 size = box.high - box.low;
    size_t through = 0;
    const Ways ways = ways_of(tracks);
    for (const auto& [id, way] : ways)
        through += std::fabs(way.back().at.x - way.front().at.x) > 0.5f * size.x;
    if (static_cast<double>(through) < 0.9 * static_cast<double>(ways.size())) return false;
    std::vector<float> across[k_parts];
    for (const Sighting& s : tracks.sightings) {
        const float part = clamp((s.at.x - box.low.x) / size.x, 0, 0.999f) * k_parts;
        across[static_cast<int>(part)].push_back(s.at.z);
    }
    return std::all_of(across, across + k_parts, [&](const std::vector<float>& z) {
        return z.size() > 1 && at_share(z, 0.99) - at_share(z, 0.01) > 0.6f * size.z;
    });
}

namespace {

// A corridor walked once more by people of chance `seed`.
struct Rerun {
    MeanFlow mean;
    size_t left = 0;
};

Result<Rerun> rerun(const Trajectories& tracks, const Rectangle& box, std::span<const Guest> guests,
                    uint64_t seed) {
    const Rectangle floor[] = {{{box.low.x - k_end, box.low.z}, {box.high.x + k_end, box.high.z}}};
    const double lasts = seconds_of(tracks);
    Result<Play> played =
        play(make_arena(floor), guests,
             {.seconds = static_cast<float>(lasts) + k_more, .sample_ticks = 6, .seed = seed});
    if (!played) return played.error();
    played->tracks.area = tracks.area;
    return Rerun{mean_of(flow_samples(played->tracks, middle_of(box), 1, k_first * lasts, k_last * lasts)),
                 count_left(*played)};
}

}  // namespace

Result<Findings> test_rerun(ValidationNotes& notes) {
    constexpr uint64_t k_runs = 4;
    Findings findings;
    for (const Measured& measured : notes.measured) {
        if (!is_corridor(measured.tracks)) continue;
        Trajectories tracks = along_x(measured.tracks);
        const Rectangle box = box_of(tracks);
        tracks.area = area_or_box(tracks);
        const std::vector<Guest> guests = guests_of(tracks, box);
        const double lasts = seconds_of(tracks), begins = tracks.sightings.front().frame / wide(tracks.fps);
        const MeanFlow theirs = mean_of(
            flow_samples(tracks, middle_of(box), 1, begins + k_first * lasts, begins + k_last * lasts));
        double speed = 0, density = 0;
        size_t fewest = guests.size();
        for (uint64_t seed = 1; seed <= k_runs; ++seed) {
            Result<Rerun> ours = rerun(tracks, box, guests, seed);
            if (!ours) return ours.error();
            speed += ours->mean.speed / k_runs;
            density += ours->mean.density / k_runs;
            fewest = std::min(fewest, ours->left);
        }
        auto told = [&](const char* what, double is, double was, const char* unit) {
            findings.push_back({what + (" in " + measured.name), told_number(was, unit) + " +- 15 %",
                                told_number(is, unit), verdict_of(std::fabs(is / was - 1) <= 0.15)});
        };
        told("mean speed", speed, theirs.speed, "m/s");
        told("density", density, theirs.density, "/m2");
        findings.push_back({"who gets through " + measured.name,
                            std::to_string(guests.size()) + " within a minute more", std::to_string(fewest),
                            verdict_of(fewest == guests.size())});
    }
    return findings;
}

}  // namespace flaneur
