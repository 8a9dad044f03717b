// Lanes of roads, curves of junctions, and what of them nobody can use.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/base/planar.h"
#include "sim/lanes/draft.h"
#include "sim/lanes/lines.h"

namespace flaneur {

namespace {

constexpr float k_least_width = 1.9f;  // metres, of what can be driven on
constexpr float k_car_beside = 2.05f,
                k_bus_beside = 3;    // between the middles of lanes that are driven at one time
constexpr float k_sharpest = 0.15f;  // sine of the angle at which two roads part, at least
constexpr float k_corner = 2.5f;     // metres from where kerbs would meet to where a curve begins
constexpr float k_most_of_road = 0.42f,
                k_most_back = 22;   // of a road's length, metres: that a junction takes
constexpr float k_at_end = 8;       // metres before a junction within which one waits before a crossing
constexpr float k_before_line = 1;  // metres from a crossing's stripes to where one stops
constexpr float k_leaving = 16;     // metres after a junction within which its crossings are
constexpr float k_room_beside = 0.95f, k_room_beside_tracks = 1.3f;  // metres to each side that are free

// How far from a junction one is clear of the other roads that meet there.
float set_back(const LaneMaking& m, uint32_t node, uint32_t road) {
    const Vec2 mine = leaves(m.plan.roads[road], node);
    const float half = m.plan.roads[road].width / 2;
    float most = 0;
    const std::vector<uint32_t>& here = m.roads_at[node];
    for (const uint32_t other : here) {
        if (other == road) continue;
        const Vec2 theirs = leaves(m.plan.roads[other], node);
        const float cosine = dot(mine, theirs), sine = std::max(std::fabs(cross(mine, theirs)), k_sharpest);
        if (cosine < -0.9f) {
            most = std::max(most, here.size() == 2 ? 1.5f : 2);
            continue;
        }
        // Where both edges meet; beyond a blunt corner they do before the junction.
        const float meet = (m.plan.roads[other].width / 2 + half * cosine) / sine;
        most = std::max(most, std::max(meet, 0.0f) + k_corner);
    }
    return std::min({most, k_most_back, k_most_of_road * length_along(m.plan.roads[road].line)});
}

void lay_road(LaneMaking& m, uint32_t number) {
    const Road& road = m.plan.roads[number];
    const int count = road.forward + road.backward;
    const float left = road.width / 2 - road.parked_left, right = -road.width / 2 + road.parked_right;
    const float whole = length_along(road.line), from = m.back_from[number], to = whole - m.back_to[number];
    if (count == 0 || (left - right) / static_cast<float>(count) < k_least_width || to - from < 1) return;
    const float width = (left - right) / static_cast<float>(count);
    const std::vector<Vec2> middle = rounded(road.line);
    const float scale = length_along(middle) / whole;
    auto lay = [&](bool is_back, int k, int of) {
        // Those who go along keep to one side, those who come back to the other.
        const bool from_right = is_back == m.plan.drives_left;
        const float off = (static_cast<float>(k) + 0.5f) * width,
                    aside = from_right ? right + off : left - off;
        add_lane(m, number, beside(piece_of(middle, from * scale, to * scale), aside), is_back, k, of, width);
    };
    for (int k = 0; k < road.forward; ++k) lay(false, k, road.forward);
    for (int k = 0; k < road.backward; ++k) lay(true, k, road.backward);
}

Vec2 end_of(const Draft& d) { return normalize_or(d.line.back() - d.line[d.line.size() - 2], {1, 0}); }
Vec2 start_of(const Draft& d) { return normalize_or(d.line[1] - d.line[0], {1, 0}); }

// Whether one who keeps to a lane's place among others goes so: nobody turns across those beside it.
bool may_turn(const Draft& in, const Draft& out, float turn, bool drives_left) {
    constexpr float k_turns = 0.6f, k_back = 2.7f;  // radians
    if (std::fabs(turn) > k_back) return false;
    const float to_kerb = drives_left ? turn : -turn;
    if (to_kerb > k_turns) return in.place == 0 && out.place == 0;
    if (to_kerb < -k_turns) return in.place == in.of - 1 && out.place == out.of - 1;
    return out.place == std::min(in.place, out.of - 1);
}

void join(LaneMaking& m, uint32_t node) {
    for (const uint32_t a : m.into[node])
        for (const uint32_t b : m.out_of[node]) {
            if (m.drafts[a].lane.is_track || m.drafts[b].lane.is_track) continue;
            const float turn = angle_between(end_of(m.drafts[a]), start_of(m.drafts[b]));
            if (!may_turn(m.drafts[a], m.drafts[b], turn, m.plan.drives_left)) continue;
            Draft d;
            d.line = evenly(curve_between(m.drafts[a].line, m.drafts[b].line));
            if (length_along(d.line) < 0.2f) continue;
            d.from = a, d.to = b;
            d.lane.node = node;
            d.lane.turn = turn;
            d.lane.rank = m.drafts[a].lane.rank;
            d.lane.width = std::min(m.drafts[a].lane.width, m.drafts[b].lane.width);
            d.lane.speed = std::min(m.drafts[a].lane.speed, m.drafts[b].lane.speed);
            const auto number = static_cast<uint32_t>(m.drafts.size());
            m.drafts[a].nexts.push_back(number);
            d.nexts.push_back(b);
            m.drafts.push_back(std::move(d));
        }
}

// Whether an obstacle stands on it.
bool is_blocked(const Draft& d, std::span<const Obstacle> obstacles) {
    Vec2 low = d.line[0], high = low;
    for (const Vec2 p : d.line) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    const float room = d.lane.is_track ? k_room_beside_tracks : k_room_beside;
    for (const Obstacle& o : obstacles) {
        const Vec2 at = on_ground(o.position);
        const float reach = length(o.half) + room;
        if (at.x < low.x - reach || at.z < low.z - reach || at.x > high.x + reach || at.z > high.z + reach)
            continue;
        const Vec2 ahead = heading_direction(o.yaw), aside{ahead.z, -ahead.x};
        for (const Vec2 p : d.line) {
            const float x = std::fabs(dot(p - at, aside)) - o.half.x,
                        z = std::fabs(dot(p - at, ahead)) - o.half.z;
            if (length(Vec2{std::max(x, 0.0f), std::max(z, 0.0f)}) < room) return true;
        }
    }
    return false;
}

// Leaves out, again and again, what leads nowhere and what nobody comes to.
void leave_out(LaneMaking& m, std::span<const Obstacle> obstacles) {
    std::vector<Draft>& all = m.drafts;
    for (Draft& d : all) d.is_left_out |= !is_curve(d.lane) && is_blocked(d, obstacles);
    for (bool is_any = true; is_any;) {
        is_any = false;
        std::vector<uint8_t> comes(all.size(), 0);
        for (const Draft& d : all)
            if (!d.is_left_out)
                for (const uint32_t next : d.nexts) comes[next] = 1;
        for (size_t i = 0; i < all.size(); ++i) {
            Draft& d = all[i];
            if (d.is_left_out) continue;
            std::erase_if(d.nexts, [&](uint32_t next) { return all[next].is_left_out; });
            if ((d.nexts.empty() && !d.lane.is_gate_out) || (!comes[i] && !d.lane.is_gate_in))
                d.is_left_out = is_any = true;
        }
    }
}

float nearest_between(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    float least = 1e9f;
    for (const Vec2 p : a)
        for (size_t k = 0; k + 1 < b.size(); ++k)
            least = std::min(least, length_squared(p - lerp(b[k], b[k + 1], closest_on(b[k], b[k + 1], p))));
    return std::sqrt(least);
}

// Curves of one junction that cannot be driven at one time: that cross, touch, or end in one lane.
void find_conflicts(LaneMaking& m) {
    std::vector<std::vector<uint32_t>> curves(m.roads_at.size());
    for (uint32_t i = 0; i < m.drafts.size(); ++i)
        if (is_curve(m.drafts[i].lane) && !m.drafts[i].is_left_out)
            curves[m.drafts[i].lane.node].push_back(i);
    for (Draft& d : m.drafts)
        std::erase_if(d.conflicts, [&](uint32_t other) { return m.drafts[other].is_left_out; });
    for (const std::vector<uint32_t>& here : curves)
        for (const uint32_t a : here)
            for (const uint32_t b : here) {
                Draft &x = m.drafts[a], &y = m.drafts[b];
                if (b <= a || x.from == y.from || x.lane.is_track != y.lane.is_track) continue;
                const float beside =
                    clamp(std::max(x.lane.width, y.lane.width) - 0.1f, k_car_beside, k_bus_beside);
                if (x.to != y.to && nearest_between(x.line, y.line) > beside) continue;
                x.conflicts.push_back(b);
                y.conflicts.push_back(a);
            }
}

void find_crossings(const Draft& d, const Crossings& crossings, bool leaves_junction, bool is_met,
                    std::vector<LaneCrossing>& out) {
    const float whole = d.lane.length, apart = whole / static_cast<float>(d.line.size() - 1);
    const size_t first = out.size();
    Vec2 middle = d.line[d.line.size() / 2];
    for (uint32_t c = 0; c < crossings.all.size(); ++c) {
        const Crossing& crossing = crossings.all[c];
        if (length(on_ground(crossing.centre) - middle) > whole / 2 + 20) continue;
        LaneCrossing found{c, 1e9f, -1, 0};
        for (size_t k = 0; k < d.line.size(); ++k) {
            const OnCrossing at = on_crossing(crossing, d.line[k]);
            if (std::fabs(at.aside) > crossing.half_width || std::fabs(at.over) > crossing.half_length)
                continue;
            const float metres = static_cast<float>(k) * apart;
            found.from = std::min(found.from, metres - apart / 2),
            found.to = std::max(found.to, metres + apart / 2);
        }
        if (found.to < 0) continue;
        found.leaves = is_curve(d.lane) ||
                       (leaves_junction && found.from < k_leaving && found.from < whole - found.to) ||
                       (is_met && found.from < 2);
        out.push_back(found);
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
              [](const LaneCrossing& a, const LaneCrossing& b) {
                  return std::tie(a.from, a.crossing) < std::tie(b.from, b.crossing);
              });
}

void find_stops(const Draft& d, std::span<const Vec2> stops, std::vector<float>& out) {
    constexpr float k_near = 6, k_bus = 2.5f, k_off_ends = 14;  // metres
    if (is_curve(d.lane) || d.lane.width < k_bus) return;
    const size_t first = out.size();
    const float apart = d.lane.length / static_cast<float>(d.line.size() - 1);
    for (const Vec2 stop : stops) {
        float least = k_near, at = -1;
        for (size_t k = 0; k < d.line.size(); ++k)
            if (const float far = length(d.line[k] - stop); far < least)
                least = far, at = static_cast<float>(k) * apart;
        if (at > k_off_ends && at < d.lane.length - k_off_ends) out.push_back(at);
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
}

// Where one waits who may not go on: before the crossing that lies there, if one does.
float stop_of(const Lane& lane, std::span<const LaneCrossing> crossings) {
    float at = lane.length - 0.3f;
    for (const LaneCrossing& c : crossings)
        if (c.leaves == 0 && c.to > lane.length - k_at_end) at = std::min(at, c.from - k_before_line);
    return std::max(at, 0.5f);
}

Lanes finished(const LaneMaking& m, const Crossings& crossings, std::span<const Vec2> stops) {
    Lanes lanes;
    lanes.drives_left = m.plan.drives_left;
    std::vector<uint32_t> number(m.drafts.size(), k_no_lane);
    for (size_t i = 0; i < m.drafts.size(); ++i)
        if (!m.drafts[i].is_left_out)
            number[i] = static_cast<uint32_t>(lanes.all.size()), lanes.all.emplace_back();
    for (size_t i = 0; i < m.drafts.size(); ++i) {
        if (m.drafts[i].is_left_out) continue;
        const Draft& d = m.drafts[i];
        Lane lane = d.lane;
        auto size = [](const auto& list) { return static_cast<uint32_t>(list.size()); };
        lane.first = size(lanes.places), lane.count = size(d.line);
        lane.length = length_along(d.line);
        for (const Vec2 p : d.line) lanes.places.push_back(at_height(p, 0));
        lane.first_next = size(lanes.nexts), lane.next_count = size(d.nexts);
        for (const uint32_t next : d.nexts) lanes.nexts.push_back(number[next]);
        lane.first_conflict = size(lanes.conflicts), lane.conflict_count = size(d.conflicts);
        for (const uint32_t other : d.conflicts) lanes.conflicts.push_back(number[other]);
        lane.first_crossing = size(lanes.crossings), lane.first_stop = size(lanes.stops);
        const Draft measured{.line = d.line, .lane = lane};
        const bool is_road = !is_curve(lane);
        find_crossings(measured, crossings, is_road && m.roads_at[d.from].size() > 2,
                       is_road && m.roads_at[d.from].size() > 1, lanes.crossings);
        lane.crossing_count = size(lanes.crossings) - lane.first_crossing;
        lane.stop = stop_of(lane, crossings_of(lanes, lane));
        lane.is_track ? find_halts(m, d, lane.stop, lanes.stops) : find_stops(measured, stops, lanes.stops);
        lane.stop_count = size(lanes.stops) - lane.first_stop;
        lanes.all[number[i]] = lane;
    }
    return lanes;
}

}  // namespace

Vec2 leaves(const Road& road, uint32_t node) {
    const std::vector<Vec2>& l = road.line;
    const bool is_start = road.from == node;
    const Vec2 a = is_start ? l.front() : l.back();
    Vec2 b = a;
    for (size_t k = 1; k < l.size() && length(b - a) < 4; ++k) b = is_start ? l[k] : l[l.size() - 1 - k];
    return normalize_or(b - a, {1, 0});
}

float angle_between(Vec2 a, Vec2 b) { return -arctan2(cross(a, b), dot(a, b)); }

void add_lane(LaneMaking& m, uint32_t number, const std::vector<Vec2>& line, bool is_back, int place, int of,
              float width) {
    const Road& road = m.plan.roads[number];
    Draft d;
    d.line = evenly(line);
    if (is_back) std::reverse(d.line.begin(), d.line.end());
    d.from = is_back ? road.to : road.from;
    d.to = is_back ? road.from : road.to;
    d.place = place, d.of = of;
    d.road = number;
    d.lane.width = width;
    d.lane.speed = road.speed;
    d.lane.rank = road.rank;
    d.lane.is_gate_in = m.plan.nodes[d.from].is_gate;
    d.lane.is_gate_out = m.plan.nodes[d.to].is_gate;
    const auto draft = static_cast<uint32_t>(m.drafts.size());
    m.out_of[d.from].push_back(draft);
    m.into[d.to].push_back(draft);
    m.drafts.push_back(std::move(d));
}

Lanes make_lanes(const RoadPlan& plan, const Crossings& crossings, std::span<const Vec2> stops,
                 std::span<const Obstacle> obstacles) {
    LaneMaking m{plan, {}, {}, {}, {}, {}, {}};
    m.roads_at.resize(plan.nodes.size());
    m.into.resize(plan.nodes.size());
    m.out_of.resize(plan.nodes.size());
    for (uint32_t r = 0; r < plan.roads.size(); ++r)
        for (const uint32_t node : {plan.roads[r].from, plan.roads[r].to}) m.roads_at[node].push_back(r);
    for (uint32_t r = 0; r < plan.roads.size(); ++r) {
        m.back_from.push_back(set_back(m, plan.roads[r].from, r));
        m.back_to.push_back(set_back(m, plan.roads[r].to, r));
    }
    for (uint32_t r = 0; r < plan.roads.size(); ++r)
        plan.roads[r].is_track ? lay_track(m, r) : lay_road(m, r);
    for (uint32_t node = 0; node < plan.nodes.size(); ++node) join(m, node), join_tracks(m, node);
    cut_at_tracks(m);
    leave_out(m, obstacles);
    find_conflicts(m);
    return finished(m, crossings, stops);
}

}  // namespace flaneur
