// Walls, fences and hedges of the map.
#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "assets/plan/masses.h"
#include "assets/plan/streets.h"

namespace flaneur {

namespace {

struct BarrierKind {
    std::string_view name;
    float height, thickness;  // metres
};
constexpr BarrierKind k_barriers[] = {
    {"wall", 1.8f, 0.25f},          {"city_wall", 4, 1},    {"retaining_wall", 1.1f, 0.35f},
    {"fence", 1.3f, 0.08f},         {"hedge", 1.3f, 0.6f},  {"guard_rail", 0.8f, 0.15f},
    {"jersey_barrier", 0.9f, 0.5f}, {"handrail", 1, 0.08f},
};

const BarrierKind* barrier_of(const OsmTags& tags) {
    std::string_view name = tags["barrier"];
    auto found = std::find_if(std::begin(k_barriers), std::end(k_barriers),
                              [&](const BarrierKind& b) { return b.name == name; });
    bool unbuilt = is_hidden(tags) || parse_number(tags["layer"]).value_or(0) != 0;
    return found == std::end(k_barriers) || unbuilt ? nullptr : found;
}

// A place where a wall leaves room.
struct Gap {
    Vec2 at;
    float radius;  // metres
};

// Gates, and where ways cross the straight wall from a to b.
std::vector<Gap> gaps_of(const OsmImport& in, const std::vector<Gap>& gates, Vec2 a, Vec2 b) {
    std::vector<Gap> gaps;
    for (const Gap& gate : gates) {
        if (length(lerp(a, b, closest_on({a, b}, gate.at)) - gate.at) < 1) gaps.push_back(gate);
    }
    in.streets.near((a + b) * 0.5f, length(b - a) * 0.5f, [&](const LinePiece& s) {
        if (std::optional<float> share = crossing_on(a, b, s.a, s.b))
            gaps.push_back({lerp(a, b, *share), std::max(s.half, 1.4f)});
    });
    return gaps;
}

// Whether a wall would stand on a carriageway or in the middle of a way.
bool is_on_street(const OsmImport& in, Vec2 p) {
    bool found = false;
    in.streets.near(p, 12, [&](const LinePiece& s) {
        float half = std::max(s.half - 1.5f, 0.5f);
        found = found || length_squared(lerp(s.a, s.b, closest_on(s, p)) - p) < half * half;
    });
    return found;
}

// Off the ground that is laid.
bool is_beyond(const GroundPlan& plan, Vec2 p) {
    return p.x < plan.low.x || p.z < plan.low.z || p.x > plan.high.x || p.z > plan.high.z;
}

// One straight stretch of wall.
void add_stretch(OsmImport& in, Vec2 a, Vec2 b, const BarrierKind& kind, float height) {
    float low = std::min(terrain_at(in.plan, a), terrain_at(in.plan, b)) - 0.3f;
    auto top = [&](Vec2 p) { return terrain_at(in.plan, p) + k_kerb + height; };
    Vec2 along = normalize_or(b - a, {1, 0}), left = Vec2{along.z, -along.x} * (kind.thickness * 0.5f);
    add_garden_wall(in.city, in.plan, a + left, b + left, kind.thickness, low, top(a), top(b),
                    wall_building(in));
}

}  // namespace

void add_osm_barriers(OsmImport& in) {
    constexpr float k_step = 0.5f, k_shortest = 0.8f, k_longest = 8;  // metres
    std::vector<Gap> gates;
    for (const OsmNode& node : in.map.nodes) {
        std::string_view barrier = node.tags["barrier"];
        bool opens = barrier == "gate" || barrier == "entrance" || barrier == "lift_gate" ||
                     barrier == "swing_gate" || barrier == "kissing_gate" || node.tags.has("entrance");
        if (opens) gates.push_back({in.project(node), 0.9f});
    }
    for (const OsmWay& way : in.map.ways) {
        const BarrierKind* kind = barrier_of(way.tags);
        if (!kind) continue;
        count_built(in.counts, OsmSort::barrier);
        float height = clamp(parse_metres(way.tags["height"]).value_or(kind->height), 0.4f, 12);
        for (const std::vector<Vec2>& line : lines_of(in, way)) {
            for (size_t i = 0; i + 1 < line.size(); ++i) {
                Vec2 a = line[i], b = line[i + 1];
                float whole = length(b - a);
                int steps = std::max(1, static_cast<int>(whole / k_step));
                auto at = [&](int k) {
                    return lerp(a, b, static_cast<float>(k) / static_cast<float>(steps));
                };
                std::vector<Gap> gaps = gaps_of(in, gates, a, b);
                auto is_open = [&](int k) {
                    Vec2 p = at(k);
                    return is_beyond(in.plan, p) ||
                           std::any_of(gaps.begin(), gaps.end(),
                                       [&](const Gap& g) { return length(g.at - p) < g.radius; }) ||
                           is_on_street(in, p);
                };
                // Runs of places that nothing needs to pass.
                for (int from = 0; from < steps;) {
                    if (is_open(from) || is_open(from + 1)) {
                        ++from;
                        continue;
                    }
                    int to = from + 1;
                    while (to < steps && !is_open(to + 1) && length(at(to + 1) - at(from)) < k_longest) ++to;
                    bool end = from > 0 || to < steps;
                    if (!end || length(at(to) - at(from)) > k_shortest || steps == 1)
                        add_stretch(in, at(from), at(to), *kind, height);
                    from = to;
                }
            }
        }
    }
}

}  // namespace flaneur
