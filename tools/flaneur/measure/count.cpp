#include "tools/flaneur/measure/count.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/world.h"

namespace flaneur {
namespace {

double seconds_at(uint32_t tick) { return static_cast<double>(tick) / k_ticks_a_second; }

// How far to the right of a line, times its length.
double right_of(const CountLine& line, Vec2 p) {
    return (wide(line.b.x) - wide(line.a.x)) * (wide(p.z) - wide(line.a.z)) -
           (wide(line.b.z) - wide(line.a.z)) * (wide(p.x) - wide(line.a.x));
}
// How far along it, as a share of its length.
double along(const CountLine& line, double x, double z) {
    const double way_x = wide(line.b.x) - wide(line.a.x), way_z = wide(line.b.z) - wide(line.a.z);
    return ((x - wide(line.a.x)) * way_x + (z - wide(line.a.z)) * way_z) / (way_x * way_x + way_z * way_z);
}

// Who has gone to where the line does not reach any more, or far enough from it.
bool has_left(const CountLine& line, Vec2 p) {
    const double share = along(line, wide(p.x), wide(p.z)), metres = wide(length_of(line));
    const double beyond = std::max(-share, share - 1) * metres;
    return std::max(std::fabs(right_of(line, p)) / metres, beyond) > wide(k_clear);
}

// Whoever is exactly on the line is to the right of it.
bool meets(const CountLine& line, uint32_t tick, Vec2 from, const Present& to, LineCrossing& met) {
    const double before = right_of(line, from), after = right_of(line, to.at);
    if ((before >= 0) == (after >= 0)) return false;
    const double share = before / (before - after);
    const double x = wide(from.x) + share * (wide(to.at.x) - wide(from.x));
    const double z = wide(from.z) + share * (wide(to.at.z) - wide(from.z));
    const double place = along(line, x, z);
    if (place < 0 || place >= 1) return false;
    met = {(tick - 1 + share) / k_ticks_a_second,
           to.person,
           after >= 0,
           to.speed,
           {static_cast<float>(x), static_cast<float>(z)}};
    return true;
}

void keep(LineCount& line, const LineCrossing& crossing) {
    const auto at =
        std::upper_bound(line.crossings.begin(), line.crossings.end(), crossing,
                         [](const LineCrossing& a, const LineCrossing& b) {
                             return std::pair(a.seconds, a.person) < std::pair(b.seconds, b.person);
                         });
    line.crossings.insert(at, crossing);
}

// Whether a way keeps to one side of all of a line, east, west, north or south of it.
bool is_beside(const CountLine& line, Vec2 from, Vec2 to) {
    return std::max(from.x, to.x) < std::min(line.a.x, line.b.x) ||
           std::min(from.x, to.x) > std::max(line.a.x, line.b.x) ||
           std::max(from.z, to.z) < std::min(line.a.z, line.b.z) ||
           std::min(from.z, to.z) > std::max(line.a.z, line.b.z);
}

void follow(LineCount& line, uint32_t tick, Vec2 from, const Present& to) {
    if (line.open.empty() && is_beside(line.line, from, to.at)) return;
    const auto open = std::find_if(line.open.begin(), line.open.end(),
                                   [&](const LineCount::Open& o) { return o.who == to.id; });
    if (LineCrossing met; meets(line.line, tick, from, to, met)) {
        if (open != line.open.end())
            line.open.erase(open);  // has stepped back
        else if (has_left(line.line, to.at))
            keep(line, met);
        else
            line.open.push_back({to.id, met});
    } else if (open != line.open.end() && has_left(line.line, to.at)) {
        keep(line, open->crossing);
        line.open.erase(open);
    }
}

void sample(ZoneCount& zone, const Counts& counts) {
    ZoneSample now = zone_now(zone, counts);
    std::vector<Vec2> places;
    places.reserve(counts.present.size());
    for (const Present& one : counts.present) places.push_back(one.at);
    now.voronoi = static_cast<float>(voronoi_density(zone.zone.corners, places, k_zone_cells));
    zone.samples.push_back(now);
}

// What has not come yet, as it is told at an earlier tick.
void forget_after(Counts& counts, uint32_t tick) {
    for (LineCount& line : counts.lines) {
        line.since = std::min(line.since, tick);
        std::erase_if(line.crossings, [&](const LineCrossing& c) { return c.seconds > seconds_at(tick); });
    }
    for (ZoneCount& zone : counts.zones) {
        zone.since = std::min(zone.since, tick);
        std::erase_if(zone.samples, [&](const ZoneSample& s) { return s.tick >= tick; });
    }
}

void begin_gap(Counts& counts) {
    counts.before.clear();
    for (LineCount& line : counts.lines) line.open.clear();
}

}  // namespace

void set_plan(Counts& counts, const MeasurePlan& plan, uint32_t tick) {
    std::vector<LineCount> lines;
    for (const CountLine& line : plan.lines) {
        const auto old = std::find_if(counts.lines.begin(), counts.lines.end(),
                                      [&](const LineCount& l) { return l.line == line; });
        if (old != counts.lines.end())
            lines.push_back(std::move(*old));
        else
            lines.push_back({line, tick, {}, {}});
    }
    std::vector<ZoneCount> zones;
    for (const CountZone& zone : plan.zones) {
        const auto old = std::find_if(counts.zones.begin(), counts.zones.end(),
                                      [&](const ZoneCount& z) { return z.zone == zone; });
        if (old != counts.zones.end())
            zones.push_back(std::move(*old));
        else
            zones.push_back({zone, tick, area_of(zone.corners), {}});
    }
    counts.lines = std::move(lines);
    counts.zones = std::move(zones);
}

MeasurePlan plan_of(const Counts& counts) {
    MeasurePlan plan;
    for (const LineCount& line : counts.lines) plan.lines.push_back(line.line);
    for (const ZoneCount& zone : counts.zones) plan.zones.push_back(zone.zone);
    return plan;
}

void begin_anew(Counts& counts, uint32_t tick) {
    for (LineCount& line : counts.lines) line = {line.line, tick, {}, {}};
    for (ZoneCount& zone : counts.zones) zone = {zone.zone, tick, zone.area, {}};
}

void count_people(Counts& counts, uint32_t tick, std::span<const Present> present) {
    if (counts.tick != k_unticked && tick <= counts.tick) forget_after(counts, tick);
    if (tick != counts.tick && tick != counts.tick + 1) begin_gap(counts);
    counts.tick = counts.shown = tick;
    if (counts.present.data() != present.data()) counts.present.assign(present.begin(), present.end());
    for (const Present& one : present) {
        if (one.id.index >= counts.before.size()) counts.before.resize(one.id.index + 1);
        Counts::Before& before = counts.before[one.id.index];
        const bool is_known =
            before.tick != k_unticked && before.tick + 1 == tick && before.generation == one.id.generation;
        if (is_known)
            for (LineCount& line : counts.lines) follow(line, tick, before.at, one);
        before = {one.id.generation, tick, one.at};
    }
    if (tick % k_sample_ticks == 0)
        for (ZoneCount& zone : counts.zones) sample(zone, counts);
}

void count_people(Counts& counts, const World& world) {
    if (counts.lines.empty() && counts.zones.empty()) return;
    const Crowd& crowd = world.crowd;
    counts.present.clear();
    for (WalkerId id : crowd.slots.living)
        counts.present.push_back({id, on_ground(crowd.motion.position[id.index]),
                                  length(crowd.motion.velocity[id.index]), person_number(crowd, id)});
    count_people(counts, world.tick, counts.present);
}

bool is_off_ground(const CountLine& line, const World& world) {
    constexpr float k_beside = 1, k_step = 2, k_level = 4, k_levels = 1e4f;  // metres
    constexpr int k_most_steps = 1000;
    const float far = length_of(line);
    const int steps = std::clamp(static_cast<int>(std::min(far / k_step, 1e6f)) + 1, 1, k_most_steps);
    // Boxes that hold all of the line, however long.
    const float reach = far / static_cast<float>(2 * steps) + k_beside;
    for (int i = 0; i < steps; ++i) {
        const Vec2 at = lerp(line.a, line.b, (static_cast<float>(i) + 0.5f) / static_cast<float>(steps));
        // The mesh is looked for where the ground is, as it is found by distance; then at any height.
        const auto hit = ground_at(world.around, at_height(at, 0), k_levels, k_levels);
        if (hit && nearest(*world.navmesh, 0, at_height(at, hit->height), {reach, k_level, reach}))
            return false;
        if (nearest(*world.navmesh, 0, at_height(at, 0), {reach, k_levels, reach})) return false;
    }
    return true;
}

Flow flow_of(const LineCount& line, uint32_t tick, double seconds) {
    const double now = seconds_at(tick), since = std::max(now - seconds, seconds_at(line.since));
    Flow flow{.seconds = std::max(now - since, 0.0)};
    for (auto crossing = line.crossings.rbegin(); crossing != line.crossings.rend(); ++crossing) {
        if (crossing->seconds > now) continue;
        if (crossing->seconds <= since) break;
        ++(crossing->to_right ? flow.right : flow.left);
    }
    if (flow.seconds <= 0) return flow;
    const double a_second = (flow.left + flow.right) / flow.seconds;
    flow.per_minute = 60 * a_second;
    flow.per_metre_second = a_second / wide(length_of(line.line));
    return flow;
}

ZoneSample zone_now(const ZoneCount& zone, const Counts& counts) {
    if (counts.shown < counts.tick) {
        auto later = std::find_if(zone.samples.begin(), zone.samples.end(),
                                  [&](const ZoneSample& sample) { return sample.tick > counts.shown; });
        return later == zone.samples.begin() ? ZoneSample{.tick = counts.shown} : *(later - 1);
    }
    ZoneSample now{.tick = counts.tick};
    Vec2 low = zone.zone.corners[0], high = low;
    for (Vec2 c : zone.zone.corners) {
        low = {std::min(low.x, c.x), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.z, c.z)};
    }
    double speed = 0;
    for (const Present& one : counts.present) {
        if (one.at.x < low.x || one.at.z < low.z || one.at.x > high.x || one.at.z > high.z) continue;
        if (!is_within(zone.zone.corners, one.at)) continue;
        ++now.people;
        speed += wide(one.speed);
    }
    now.density = static_cast<float>(now.people / zone.area);
    if (now.people > 0) now.speed = static_cast<float>(speed / now.people);
    if (!zone.samples.empty()) now.voronoi = zone.samples.back().voronoi;
    return now;
}

}  // namespace flaneur
