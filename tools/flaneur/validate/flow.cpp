#include "tools/flaneur/validate/flow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "sim/base/math.h"
#include "tools/flaneur/measure/plan.h"
#include "tools/flaneur/measure/voronoi.h"
#include "tools/flaneur/validate/arena.h"

namespace flaneur {
namespace {

constexpr double k_speed_window = 0.2;  // seconds before and after

using Sightings = std::span<const Sighting>;

Sightings frame_of(const Trajectories& tracks, uint32_t frame) {
    const auto first = std::lower_bound(tracks.sightings.begin(), tracks.sightings.end(), frame,
                                        [](const Sighting& s, uint32_t f) { return s.frame < f; });
    auto last = first;
    while (last != tracks.sightings.end() && last->frame == frame) ++last;
    return {first, last};
}

std::optional<Vec2> place_of(const Trajectories& tracks, uint32_t frame, uint32_t id) {
    const auto found =
        std::lower_bound(tracks.sightings.begin(), tracks.sightings.end(), std::tuple(frame, id),
                         [](const Sighting& s, auto key) { return std::tuple(s.frame, s.id) < key; });
    if (found == tracks.sightings.end() || found->frame != frame || found->id != id) return std::nullopt;
    return found->at;
}

// Over the window about a frame, or the half of it in which the person is there.
std::optional<double> speed_of(const Trajectories& tracks, const Sighting& who) {
    const auto window = static_cast<uint32_t>(std::max(1L, std::lround(k_speed_window * wide(tracks.fps))));
    uint32_t from = who.frame >= window ? who.frame - window : who.frame, to = who.frame + window;
    std::optional<Vec2> before = place_of(tracks, from, who.id), after = place_of(tracks, to, who.id);
    if (!before) before = who.at, from = who.frame;
    if (!after) after = who.at, to = who.frame;
    if (from == to) return std::nullopt;
    return wide(length(*after - *before)) * wide(tracks.fps) / (to - from);
}

// What of the walkable area lies in a convex polygon, the holes' rings with a minus; all of it where no area
// is known.
struct Part {
    std::vector<std::vector<Vec2>> rings, holes;
};
Part walkable_in(const std::vector<WalkablePolygon>& area, std::span<const Vec2> convex) {
    if (area.empty()) return {{{convex.begin(), convex.end()}}, {}};
    Part part;
    for (const WalkablePolygon& polygon : area) {
        part.rings.push_back(part_within(polygon.outer, convex));
        for (const std::vector<Vec2>& hole : polygon.holes) part.holes.push_back(part_within(hole, convex));
    }
    return part;
}

double square_metres(const Part& part) {
    double sum = 0;
    for (const std::vector<Vec2>& ring : part.rings) sum += area_of(ring);
    for (const std::vector<Vec2>& hole : part.holes) sum -= area_of(hole);
    return sum;
}

// Cut by the larger polygon last: what is left may be too small to cut by.
Part part_of(Part part, std::span<const Vec2> convex) {
    for (std::vector<Vec2>& ring : part.rings) ring = part_within(ring, convex);
    for (std::vector<Vec2>& hole : part.holes) hole = part_within(hole, convex);
    return part;
}

FlowSample sample_of(const Trajectories& tracks, const Rectangle& zone, Sightings people) {
    const Vec2 corners[] = {zone.low, {zone.high.x, zone.low.z}, zone.high, {zone.low.x, zone.high.z}};
    const double whole = square_metres(walkable_in(tracks.area, corners));
    const Rectangle near = widened(zone, 3 * k_cell_reach), close = widened(zone, k_cell_reach);
    std::vector<Vec2> places;
    std::vector<const Sighting*> who;
    for (const Sighting& s : people)
        if (is_in(near, s.at)) places.push_back(s.at), who.push_back(&s);
    FlowSample sample;
    sample.seconds = people.empty() ? 0 : people[0].frame / wide(tracks.fps);
    double covered = 0, weighed = 0, inside = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        if (!is_in(close, places[i])) continue;
        const std::vector<Vec2> cell = voronoi_cell(places, i);
        const Part mine = walkable_in(tracks.area, cell);
        const double own = square_metres(mine), part = square_metres(part_of(mine, corners));
        const bool is_inside = is_in(zone, places[i]);
        sample.people += is_inside;
        if (own > 0) sample.density += part / own;
        const std::optional<double> speed = speed_of(tracks, *who[i]);
        if (!speed) continue;
        covered += part;
        weighed += part * *speed;
        if (is_inside) sample.mean_speed += *speed, ++inside;
    }
    if (inside > 0) sample.mean_speed /= inside;
    sample.classic = sample.people / whole;
    sample.density /= whole;
    sample.speed = covered > 0 ? weighed / covered : 0;
    if (covered <= 0) sample.density = 0;
    return sample;
}

}  // namespace

std::vector<FlowSample> flow_samples(const Trajectories& tracks, const Rectangle& zone, double every,
                                     double first, double last) {
    std::vector<FlowSample> samples;
    for (double at = first; at <= last; at += every) {
        const FlowSample sample = sample_of(
            tracks, zone, frame_of(tracks, static_cast<uint32_t>(std::lround(at * wide(tracks.fps)))));
        if (sample.density > 0) samples.push_back(sample);
    }
    return samples;
}

std::vector<double> crossings_at(const Trajectories& tracks, float x) {
    std::map<uint32_t, Sighting> last;
    std::vector<double> seconds;
    for (const Sighting& s : tracks.sightings) {
        const auto [before, is_new] = last.try_emplace(s.id, s);
        const Sighting from = before->second;
        before->second = s;
        if (is_new || from.at.x >= x || s.at.x < x) continue;
        const double share = wide((x - from.at.x) / (s.at.x - from.at.x));
        seconds.push_back((from.frame + share * (s.frame - from.frame)) / wide(tracks.fps));
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds;
}

MeanFlow mean_of(std::span<const FlowSample> samples) {
    MeanFlow mean;
    for (const FlowSample& s : samples) {
        mean.classic += s.classic;
        mean.density += s.density;
        mean.speed += s.speed;
        mean.mean_speed += s.mean_speed;
    }
    mean.samples = samples.size();
    const auto count = static_cast<double>(std::max<size_t>(samples.size(), 1));
    return {mean.classic / count, mean.density / count, mean.speed / count, mean.mean_speed / count,
            mean.samples};
}

double weidmann_speed(double density) {
    if (density <= 0) return 1.34;
    return std::max(0.0, 1.34 * (1 - std::exp(-1.913 * (1 / density - 1 / 5.4))));
}

}  // namespace flaneur
