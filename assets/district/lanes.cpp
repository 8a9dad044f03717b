// Where one drives in the built-in district: on both sides of streets, but in one direction where cars park
// at both kerbs and leave no room for two.
#include "sim/lanes/lanes.h"

#include <algorithm>

#include "assets/district/district.h"
#include "assets/plan/rails.h"
#include "assets/plan/streets.h"

namespace flaneur {

static constexpr float k_parked = 2.1f;     // metres from the kerb
static constexpr float k_both_park = 8;     // metres of a carriageway, above which cars park on both sides
static constexpr float k_two_lanes = 4.9f;  // metres that two lanes take, at least
static constexpr float k_track_width = 2.65f;
static constexpr float k_off_edge = 4;  // metres from the map's edge to a gate
static constexpr float k_street_speed = 30 / 3.6f, k_avenue_speed = 50 / 3.6f;  // m/s

// Up to the map's edge.
static std::vector<Vec2> within_map(const District& d, const std::vector<Vec2>& line) {
    float s = length_of(line);
    auto is_off = [&](Vec2 p) {
        const Vec2 low = d.plan.low + Vec2{k_off_edge, k_off_edge},
                   high = d.plan.high - Vec2{k_off_edge, k_off_edge};
        return p.x < low.x || p.z < low.z || p.x > high.x || p.z > high.z;
    };
    while (s > 1 && is_off(station(line, s).at)) s -= 0.5f;
    return part_of(line, 0, s);
}

// Lines of the lattice that run side by side are driven in turns to and fro.
static bool is_driven_back(const StreetPlan& plan, const Way& way) {
    const auto n = static_cast<uint32_t>(plan.blocks) + 1;
    const bool is_row = way.to == way.from + 1;
    return (is_row ? way.from / n : way.from % n) % 2 == (is_row ? 1 : 0);
}

// The avenue with tracks, from the western edge of the map to the eastern one.
static std::vector<Vec2> line_of_tracks(const District& d) {
    std::vector<Vec2> line;
    for (const Way& way : d.streets.ways) {
        if (!way.has_tracks) continue;
        const std::vector<Vec2> part = way.leads_out ? within_map(d, way.line) : way.line;
        line.insert(line.end(), part.begin(), part.end());
    }
    std::sort(line.begin(), line.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    const auto last =
        std::unique(line.begin(), line.end(), [](Vec2 a, Vec2 b) { return length(b - a) < 0.1f; });
    line.erase(last, line.end());
    return line;
}

// One track a direction, in the middle of the lanes there; the avenue is straight.
static void lay_tracks(District& d, RoadPlan& plan) {
    const std::vector<Vec2> middle = line_of_tracks(d);
    if (middle.empty()) return;
    const auto avenue = std::ranges::find(d.streets.ways, true, &Way::has_tracks);
    const float aside = (avenue->width - 2 * k_parked) / 4;
    const Vec2 along = normalize_or(middle.back() - middle.front(), {1, 0}), right{-along.z, along.x};
    Rails rails{d.city};
    for (const bool is_back : {false, true}) {
        Road track{.line = middle, .speed = k_avenue_speed, .is_track = true};
        for (Vec2& p : track.line) p += right * (is_back ? -aside : aside);
        if (is_back) std::reverse(track.line.begin(), track.line.end());
        track.width = k_track_width;
        for (const bool ends : {false, true}) {
            (ends ? track.to : track.from) = static_cast<uint32_t>(plan.nodes.size());
            plan.nodes.push_back({ends ? track.line.back() : track.line.front(), true});
        }
        constexpr float k_piece = 2;  // metres
        const float whole = length_of(track.line);
        auto place = [&](float s) {
            const Vec2 p = station(track.line, s).at;
            return at_height(p, terrain_at(d, p));
        };
        for (float s = 0; s + k_piece <= whole; s += k_piece) lay_rails(rails, place(s), place(s + k_piece));
        plan.roads.push_back(std::move(track));
    }
    plan.tram_stops = d.tram_stops;
}

void lay_lanes(District& d) {
    const StreetPlan& streets = d.streets;
    RoadPlan plan;
    plan.nodes.reserve(streets.nodes.size());
    for (const Vec2 at : streets.nodes) plan.nodes.push_back({at, false});
    for (const Way& way : streets.ways) {
        if (!way.carries_cars()) continue;
        Road road;
        road.line = way.leads_out ? within_map(d, way.line) : way.line;
        road.from = way.from, road.to = way.to;
        if (way.leads_out) plan.nodes[way.to] = {road.line.back(), true};
        road.width = way.width;
        road.parked_left = k_parked;
        road.parked_right = way.width > k_both_park ? k_parked : 0;
        const bool is_avenue = way.kind == WayKind::avenue;
        road.speed = is_avenue ? k_avenue_speed : k_street_speed;
        road.rank = is_avenue;
        if (way.width - road.parked_left - road.parked_right < k_two_lanes && road.parked_right > 0) {
            const bool is_back = is_driven_back(streets, way);
            road.forward = is_back ? 0 : 1, road.backward = is_back ? 1 : 0;
        }
        plan.roads.push_back(std::move(road));
    }
    std::vector<Vec2> stops;
    for (const Destination& place : d.city.destinations)
        if (place.kind == DestinationKind::stop) stops.push_back(on_ground(place.position));
    lay_tracks(d, plan);
    d.city.lanes = make_lanes(plan, d.city.crossings, stops, d.city.ground.obstacles);
    settle_lanes(d.city.lanes, d.city.ground);
}

}  // namespace flaneur
