#include "assets/traced/ways.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <tuple>

#include "assets/traced/hall.h"
#include "assets/traced/path.h"
#include "assets/traced/sway.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/crowd/crowd.h"

namespace flaneur {

namespace {

constexpr double k_tick_rate = 60;
constexpr double k_most_weight = 0.5;                         // seconds, of a spot
constexpr double k_gathers = 1.2;                             // seconds in which one gets into its stride
constexpr float k_least_height = 0.6f, k_most_height = 2.3f;  // metres, of bodies
constexpr double k_level_cutoff = 1;                          // 1/s, of heights
constexpr uint32_t k_short = 72;  // ticks; who is seen for less is so in full all the time

using Sightings = std::vector<Sighting>;

// What is between two sightings of one.
struct Step {
    double seconds = 0, metres = 0;
};
Step step_between(const Sighting& a, const Sighting& b, double fps) {
    return {(static_cast<double>(b.frame) - static_cast<double>(a.frame)) / fps,
            static_cast<double>(length(b.at - a.at))};
}
bool is_jump(const Step& s) { return s.metres > 0.5 + k_fastest * s.seconds; }

// Takes out single spots far off the others.
uint32_t leave_out_strays(Sightings& all, double fps) {
    Sightings kept;
    for (size_t i = 0; i < all.size(); ++i) {
        const bool is_stray = i > 0 && i + 1 < all.size() && is_jump(step_between(all[i - 1], all[i], fps)) &&
                              is_jump(step_between(all[i], all[i + 1], fps)) &&
                              !is_jump(step_between(all[i - 1], all[i + 1], fps));
        if (!is_stray) kept.push_back(all[i]);
    }
    const auto strays = static_cast<uint32_t>(all.size() - kept.size());
    all = std::move(kept);
    return strays;
}

double usual_step(const Sightings& all, double fps) {
    std::vector<double> steps;
    for (size_t i = 1; i < all.size(); ++i) steps.push_back(step_between(all[i - 1], all[i], fps).seconds);
    if (steps.empty()) return 1 / fps;
    const auto middle = steps.begin() + static_cast<ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

struct Making {
    const Trajectories& from;
    Entering how;
    uint64_t seed;
    uint32_t first_frame, last_frame;
    RecordedWays made{};
    std::vector<float> off{}, off_raw{};
    size_t swaying = 0;
};

// A height that most of somebody's heads are below: that of who stands upright.
float height_of(const Making& m, std::span<const Sighting> all, float known) {
    float height = known;
    if (height <= 0 && m.from.heights == HeightsOf::heads) {
        std::vector<float> heights;
        for (const Sighting& s : all) heights.push_back(s.height - level_at(m.from, s.at));
        const auto upper = heights.begin() + static_cast<ptrdiff_t>(heights.size() * 9 / 10);
        std::nth_element(heights.begin(), upper, heights.end());
        height = *upper;
    }
    return height >= k_least_height && height <= k_most_height ? height : 0;
}

// When somebody is there.
void set_times(const Making& m, std::span<const Sighting> piece, TracedWay& way) {
    auto tick_of = [&](uint32_t frame) {
        const double seconds = static_cast<double>(frame - m.first_frame) / static_cast<double>(m.from.fps);
        return k_trace_lead + static_cast<uint32_t>(std::lround(seconds * k_tick_rate));
    };
    const uint32_t from = tick_of(piece.front().frame), to = tick_of(piece.back().frame);
    const bool is_step = m.how == Entering::step || to - from < k_short;
    way.begin = from - k_trace_lead;
    way.seen = is_step ? from - k_shown : from;
    way.gone = is_step ? to + k_shown : to;
    if (piece.front().frame == m.first_frame) way.seen = way.begin;
    if (piece.back().frame == m.last_frame) way.gone = to + k_shown;
    if (m.first_frame == m.last_frame) way.gone += static_cast<uint32_t>(k_picture * k_tick_rate);
    way.end = std::max(way.gone, to);
}

std::vector<SeenAt> spots_of(const Making& m, std::span<const Sighting> piece) {
    std::vector<SeenAt> spots;
    auto time_of = [&](const Sighting& s) {
        return static_cast<double>(s.frame - m.first_frame) / static_cast<double>(m.from.fps);
    };
    for (size_t i = 0; i < piece.size(); ++i) {
        const double time = time_of(piece[i]), before = i > 0 ? time - time_of(piece[i - 1]) : 0,
                     after = i + 1 < piece.size() ? time_of(piece[i + 1]) - time : 0;
        const double weight = std::min(std::max((before + after) / 2, 1e-3), k_most_weight);
        spots.push_back(
            {time, static_cast<double>(piece[i].at.x), static_cast<double>(piece[i].at.z), weight});
    }
    return spots;
}

Spline heading_of(const Making& m, std::span<const Sighting> piece, const std::vector<SeenAt>& spots,
                  const Path& path) {
    std::vector<double> times, weights;
    std::vector<float> yaws;
    for (size_t i = 0; i < piece.size(); ++i) {
        if (piece[i].facing == Vec2{}) continue;
        times.push_back(spots[i].time), weights.push_back(spots[i].weight);
        yaws.push_back(heading_of(piece[i].facing));
    }
    if (!times.empty()) return heading_of_measured(path, times, yaws, weights);
    const float stands = random_between({m.seed, piece[0].id, 0, Purpose::spawn}, -k_pi, k_pi);
    return heading_along(path, static_cast<double>(stands));
}

void note_distances(Making& m, std::span<const Sighting> piece, const std::vector<SeenAt>& spots,
                    const Path& path) {
    for (size_t i = 0; i < piece.size(); ++i) {
        const double x = value_at(path.x, spots[i].time), z = value_at(path.z, spots[i].time);
        auto far = [&](double dx, double dz) { return static_cast<float>(std::sqrt(dx * dx + dz * dz)); };
        m.off.push_back(far(spots[i].x - x, spots[i].z - z));
        m.off_raw.push_back(
            far(static_cast<double>(piece[i].at.x) - x, static_cast<double>(piece[i].at.z) - z));
    }
}

// From standing, `seconds` before, into the stride of who then goes: how far it has gone less than who has
// gone like that all the time, in seconds of that.
double gathering(double seconds) {
    const double t = std::min(seconds, k_gathers);
    return t - t * t / (2 * k_gathers);
}

void add_way(Making& m, std::span<const Sighting> piece, float height, double usual) {
    TracedWay way{.id = piece[0].id, .height = height};
    set_times(m, piece, way);
    way.stretch = usual <= 0.2 ? 6 : usual <= 0.6 ? 15 : 30;
    static_assert(k_trace_lead % 6 == 0 && k_trace_lead % 15 == 0 && k_trace_lead % 30 == 0);
    std::vector<SeenAt> spots = spots_of(m, piece);
    const double step = way.stretch / k_tick_rate;
    const double begin = (way.begin / k_tick_rate);
    const auto stretches = static_cast<size_t>((spots.back().time - begin) / step) + 2;
    m.swaying += take_out_sway(spots);
    const Path path = follow_spots(spots, begin, step, stretches);
    const Spline heading = heading_of(m, piece, spots, path);
    note_distances(m, piece, spots, path);
    Spline level{begin, step, std::vector<double>(stretches + 3, 0)};
    if (m.from.heights == HeightsOf::ground) {
        std::vector<TimedValue> heights;
        for (size_t i = 0; i < piece.size(); ++i)
            heights.push_back({spots[i].time, static_cast<double>(piece[i].height), spots[i].weight});
        level = fit_spline(heights, begin, step, stretches, {k_level_cutoff, 0});
    }

    way.knots = static_cast<uint32_t>(m.made.traces.knots.size());
    auto add = [&](double x, double y, double z, double yaw) {
        const Vec2 at{static_cast<float>(x), static_cast<float>(z)};
        const float high = m.from.heights == HeightsOf::ground ? static_cast<float>(y) : level_at(m.from, at);
        m.made.traces.knots.push_back({at_height(at, high), static_cast<float>(yaw)});
    };
    const std::vector<double>&px = path.x.points, &pz = path.z.points;
    const double vx = slope_at(path.x, begin), vz = slope_at(path.z, begin);
    for (uint32_t k = k_trace_lead / way.stretch; k > 0; --k) {
        const double back = gathering(k * step);
        add(px[0] - vx * back, level.points[0], pz[0] - vz * back, heading.points[0]);
    }
    for (size_t k = 0; k < px.size(); ++k) add(px[k], level.points[k], pz[k], heading.points[k]);
    const uint32_t wanted = (way.end - way.begin) / way.stretch + 4;
    const double ends = m.first_frame == m.last_frame ? 0 : step;
    const double ex = slope_at(path.x, spots.back().time) * ends,
                 ez = slope_at(path.z, spots.back().time) * ends;
    for (uint32_t k = 1; m.made.traces.knots.size() < size_t{way.knots} + wanted; ++k)
        add(px.back() + ex * k, level.points.back(), pz.back() + ez * k, heading.points.back());
    m.made.traces.ways.push_back(way);
}

void add_person(Making& m, Sightings all, float known) {
    const auto fps = static_cast<double>(m.from.fps);
    WaysFigures& f = m.made.figures;
    ++f.people;
    f.strays += leave_out_strays(all, fps);
    const double usual = usual_step(all, fps), bridged = std::max(k_bridged, 2.5 * usual);
    const float height = height_of(m, all, known);
    size_t first = 0;
    for (size_t i = 1; i <= all.size(); ++i) {
        if (i < all.size()) {
            const Step step = step_between(all[i - 1], all[i], fps);
            const bool jumps = is_jump(step);
            if (!jumps && step.seconds <= bridged) {
                f.bridged += step.seconds > 1.5 * usual;
                continue;
            }
            f.jumps += jumps;
        }
        add_way(m, std::span(all).subspan(first, i - first), height, usual);
        first = i;
    }
}

uint32_t most_at_once(const std::vector<TracedWay>& ways) {
    std::vector<std::pair<uint32_t, int>> changes;
    for (const TracedWay& way : ways) changes.push_back({way.begin, 1}), changes.push_back({way.end + 1, -1});
    std::ranges::sort(changes);
    int count = 0, most = 0;
    for (const auto& [tick, change] : changes) most = std::max(most, count += change);
    return static_cast<uint32_t>(most);
}

// The one that 95 % are below, and the largest.
std::pair<float, float> spread(std::vector<float>& all) {
    if (all.empty()) return {};
    const auto at = all.begin() + static_cast<ptrdiff_t>((all.size() - 1) * 95 / 100);
    std::nth_element(all.begin(), at, all.end());
    return {*at, *std::max_element(at, all.end())};
}

}  // namespace

RecordedWays make_ways(const Trajectories& recorded, Entering how, uint64_t seed) {
    Sightings all = recorded.sightings;
    Making m{recorded, how, seed, all.front().frame, all.back().frame};
    std::stable_sort(all.begin(), all.end(),
                     [](const Sighting& a, const Sighting& b) { return a.id < b.id; });
    for (size_t first = 0, last = 0; first < all.size(); first = last) {
        const uint32_t id = all[first].id;
        while (last < all.size() && all[last].id == id) ++last;
        const Tracked* known = tracked_of(recorded, id);
        if (known && known->kind != TrackedKind::person) {
            ++m.made.figures.not_people;
            continue;
        }
        add_person(m,
                   {all.begin() + static_cast<ptrdiff_t>(first), all.begin() + static_cast<ptrdiff_t>(last)},
                   known ? known->height : 0);
    }
    Traces& traces = m.made.traces;
    std::ranges::sort(traces.ways, [](const TracedWay& a, const TracedWay& b) {
        return std::pair(a.begin, a.id) < std::pair(b.begin, b.id);
    });
    traces.most = most_at_once(traces.ways);
    WaysFigures& f = m.made.figures;
    f.ways = static_cast<uint32_t>(traces.ways.size());
    f.sways = static_cast<double>(m.swaying) / static_cast<double>(std::max<size_t>(m.off.size(), 1));
    std::tie(f.near, f.farthest) = spread(m.off);
    std::tie(f.near_raw, f.farthest_raw) = spread(m.off_raw);
    return std::move(m.made);
}

std::vector<std::string> told(const WaysFigures& f) {
    char text[240];
    std::vector<std::string> all;
    std::snprintf(text, sizeof text,
                  "%u people on %u ways; %u gaps bridged, %u jumps, %u stray spots left out%s.", f.people,
                  f.ways, f.bridged, f.jumps, f.strays,
                  f.not_people > 0 ? ", and all that are no persons" : "");
    all.emplace_back(text);
    std::snprintf(
        text, sizeof text,
        "Bodies keep to what was recorded within %.1f cm (95 %%) and %.1f cm (all), less the sway of "
        "heads in %.0f %% of it; with that, %.1f and %.1f cm.",
        static_cast<double>(100 * f.near), static_cast<double>(100 * f.farthest), 100 * f.sways,
        static_cast<double>(100 * f.near_raw), static_cast<double>(100 * f.farthest_raw));
    all.emplace_back(text);
    return all;
}

}  // namespace flaneur
