// Streets, junctions and what stands along them.
#include "assets/plan/streets.h"

#include <algorithm>
#include <cmath>

#include "assets/district/district.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

// How far from its start and its end a way is clear of junctions and crossings.
struct Clear {
    float start = 4, end = 4;
};

// The way as it leaves one of its nodes.
std::vector<Vec2> line_from(const Way& way, uint32_t node) {
    std::vector<Vec2> line = way.line;
    if (way.from != node) std::reverse(line.begin(), line.end());
    return line;
}

// Signals stand where an avenue is crossed.
bool has_signals(const StreetPlan& plan, uint32_t node) {
    size_t avenues = 0, arms = 0;
    for (uint32_t w : plan.ways_at[node]) {
        avenues += plan.ways[w].kind == WayKind::avenue;
        arms += plan.ways[w].carries_cars();
    }
    return avenues > 0 && arms >= 3;
}

// `ruled`: of each crossing, whether signals stand there.
void lay_junction(District& d, uint32_t node, std::vector<Clear>& clear, std::vector<uint8_t>& ruled) {
    const StreetPlan& plan = d.streets;
    std::vector<JunctionArm> arms;
    std::vector<uint32_t> ways;
    bool meets_lane = false;
    float broadest = 0;
    for (uint32_t w : plan.ways_at[node]) {
        const Way& way = plan.ways[w];
        if (!way.carries_cars()) {
            meets_lane = true;
            continue;
        }
        std::vector<Vec2> line = line_from(way, node);
        arms.push_back({normalize_or(line[1] - line[0], {1, 0}), way.width * 0.5f});
        ways.push_back(w);
        broadest = std::max(broadest, way.half());
    }
    if (arms.size() < 2) return;
    std::vector<float> straight = add_corners(d.plan, plan.nodes[node], arms, 4);
    bool crosses = arms.size() > 2 || meets_lane;
    for (size_t a = 0; a < arms.size(); ++a) {
        const Way& way = plan.ways[ways[a]];
        std::vector<Vec2> line = line_from(way, node);
        float room = length_of(line) * 0.42f, breadth = way.kind == WayKind::avenue ? 4.5f : 3.6f;
        float at = std::min(straight[a] + breadth * 0.5f + 0.2f, room);
        Clear& c = clear[ways[a]];
        (way.from == node ? c.start : c.end) = at + breadth * 0.5f + 1.5f;
        if (!crosses) continue;
        Station s = station(line, at);
        d.city.crossings.all.push_back(
            add_crossing(d.plan, s.at, s.along, {-s.along.z, s.along.x}, way.width * 0.5f, breadth, true));
        ruled.push_back(has_signals(plan, node));
    }
}

void lay_carriageway(District& d, const Way& way) {
    Street street{way.line, way.width, way.sidewalk, way.sidewalk};
    street.round_end = !way.leads_out;
    add_street(d.plan, street);
    if (!way.leads_out) return;
    float s = length_of(way.line);
    Station end = station(way.line, s);
    auto is_off = [&](Vec2 p) {
        Vec2 low = d.plan.low + Vec2{2, 2}, high = d.plan.high - Vec2{2, 2};
        return p.x < low.x || p.z < low.z || p.x > high.x || p.z > high.z;
    };
    while (s > 0 && is_off(end.at)) end = station(way.line, s -= 1);
    Vec2 left{end.along.z, -end.along.x};
    for (float side : {-1.0f, 1.0f}) {
        add_destination(d, DestinationKind::edge, end.at + left * (side * (way.width + way.sidewalk) * 0.5f),
                        end.along, way.kind == WayKind::avenue ? 3.0f : 1.0f);
    }
}

// A flight down the hill where it is one plane, broken by landings: level treads on sloping ground.
void lay_stairs(District& d, Dice& dice, const Way& way) {
    const Relief& t = d.streets.relief;
    constexpr float k_rise = 0.155f, k_tread = 0.36f, k_landing = 4.2f;
    constexpr int k_flight = 8;
    Vec2 down = normalize_or(way.line.back() - way.line.front(), {0, 1}), right{-down.z, down.x};
    float x = way.line.front().x, top = t.plane_top, bottom = t.plane_foot;
    Vec2 origin{x, top};
    float y_top = t.height(origin), drop = y_top - t.height({x, bottom});
    int risers = static_cast<int>(drop / k_rise);
    // The bottom end is moved up to where the last tread meets the ground.
    bottom = top + static_cast<float>(risers) * k_rise / t.slope;
    float half = way.width * 0.5f;
    // From 0 at the top: a strip between two distances down, at a level under the top's.
    auto lay = [&](Surface kind, float from, float to, int below) {
        float y = k_kerb - static_cast<float>(below) * k_rise;
        Lift lift{y, -50, 50, origin, {0, t.slope}};
        Vec2 a = origin + down * from, b = origin + down * to;
        add_area(d, k_rank_steps, kind, lift,
                 {positive({to_point(a - right * half), to_point(a + right * half),
                            to_point(b + right * half), to_point(b - right * half)})},
                 -down);
    };
    int flights = (risers + k_flight - 1) / k_flight;
    float flights_run = static_cast<float>(risers - flights) * k_tread;
    float landing = std::max(k_landing, (bottom - top - flights_run) / static_cast<float>(flights + 1));
    int below = 0;
    float s = 0;
    for (int f = 0; f < flights; ++f) {
        float end = s + landing;
        lay(Surface::plaza, s, end, below);
        if (f > 0) {
            for (float side : {-1.0f, 1.0f}) {
                Vec2 at = origin + down * (s + landing * 0.5f) + right * (side * (half - 0.9f));
                if ((f + (side > 0)) % 2 == 0) {
                    add_bench(d, dice, at, right * -side);
                    add_prop(d, dice, PropKind::planter, at + down * 1.8f, heading_of(down), 1.15f);
                } else {
                    add_tree(d, dice, at, 0.68f);
                }
                Vec2 lamp = origin + down * (end - 0.4f) + right * (side * (half - 0.35f));
                if (side < 0) add_prop(d, dice, PropKind::lamp, lamp, heading_of(right), 4.2f);
            }
        }
        s = end;
        int steps = std::min(k_flight, risers - below);
        for (int k = 1; k < steps; ++k) {
            lay(Surface::steps, s, s + k_tread, below + k);
            s += k_tread;
        }
        below += steps;
    }
    lay(Surface::plaza, s, bottom - top, below);
}

void lay_lane(District& d, Dice& dice, const Way& way) {
    add_path(d, way.line, way.width, Surface::plaza);
    if (way.kind == WayKind::stairs) {
        lay_stairs(d, dice, way);
        return;
    }
    float all = length_of(way.line), from = 13, to = all - 13;
    for (float s : {from - 2, to + 2}) {
        Station end = station(way.line, s);
        Vec2 right{-end.along.z, end.along.x};
        for (float across : {-0.5f, 0.5f})
            add_prop(d, dice, PropKind::bollard, end.at + right * (across * 3), 0, 0.9f);
    }
    for (float s = from + 3; s < to; s += 11) {
        Station here = station(way.line, s);
        Vec2 right{-here.along.z, here.along.x};
        float side = dice.chance(0.5f) ? 1.0f : -1.0f, edge = way.width * 0.5f - 1.1f;
        float what = dice.unit();
        if (way.width > 5.4f && what < 0.7f) {
            if (what < 0.35f) {
                add_prop(d, dice, PropKind::planter, here.at + right * (side * edge), heading_of(here.along),
                         1.1f);
            } else {
                add_bench(d, dice, here.at + right * (side * edge), right * -side);
            }
        }
        if (dice.chance(0.5f))
            add_prop(d, dice, PropKind::lamp, here.at - right * (side * (way.width * 0.5f - 0.5f)),
                     heading_of(right * side), 4.2f);
    }
}

// Trees, lamps, cars and what one needs along a street.
void furnish(District& d, Dice& dice, const Way& way, Clear clear) {
    float all = length_of(way.line), from = clear.start, to = all - (way.leads_out ? 44 : clear.end);
    if (to - from < 10) return;
    bool is_avenue = way.kind == WayKind::avenue;
    float kerb = way.width * 0.5f + 0.75f, pitch = is_avenue ? 9.5f : 12.0f;
    bool both_park = way.width > 8;
    float shelter_at = is_avenue ? lerp(from, to, dice.between(0.3f, 0.6f)) : -100;
    for (float side : {-1.0f, 1.0f}) {
        auto place = [&](float s, float away) {
            Station here = station(way.line, s);
            Vec2 left{here.along.z, -here.along.x};
            return std::pair{here.at + left * (side * away), left * -side};
        };
        bool shelters = shelter_at > 0 && (side > 0 || way.has_tram_stop);
        auto is_free = [&](float s, float room) {
            return !shelters || std::fabs(s - shelter_at) > 2.2f + room;
        };
        if (shelters) {
            auto [at, in] = place(shelter_at, kerb + 1.0f);
            add_prop(d, dice, PropKind::shelter, at, heading_of(in), 2.5f);
            add_destination(d, DestinationKind::stop, at + in * 1.2f, in, way.has_tram_stop ? 5.0f : 2.0f);
            if (way.has_tram_stop) d.tram_stops.push_back(at + in * 1.2f);
            auto [bin, bin_in] = place(shelter_at + 2.6f, kerb);
            add_prop(d, dice, PropKind::bin, bin, heading_of(bin_in), 0.95f);
        }
        int trees = static_cast<int>((to - from) / pitch);
        for (int t = 0; t < trees && way.has_trees; ++t) {
            if (!is_avenue && dice.chance(0.12f)) continue;
            float s = lerp(from, to, (static_cast<float>(t) + 0.5f) / static_cast<float>(trees));
            if (!is_free(s, 2)) continue;
            auto [at, in] = place(s, kerb + 0.15f);
            add_tree(d, dice, at, is_avenue ? 1.05f : 0.8f);
            if (is_avenue && t % 2 == 0 && is_free(s + pitch * 0.5f, 2) && s + pitch * 0.5f < to) {
                auto [seat, seat_in] = place(s + pitch * 0.5f, kerb + 0.35f);
                add_bench(d, dice, seat, -seat_in);
            }
        }
        int lamps = std::max(1, static_cast<int>((to - from) / 27));
        for (int t = 0; t < lamps && (is_avenue || side > 0); ++t) {
            float s = lerp(from, to, static_cast<float>(t) / static_cast<float>(lamps));
            auto [at, in] = place(s, kerb - 0.25f);
            add_prop(d, dice, PropKind::lamp, at, heading_of(in), is_avenue ? 7.5f : 5.5f);
        }
        if (!both_park && side < 0) continue;
        // Cars keep to the kerb, facing the way that traffic goes there.
        for (float s = from + 3; s < to - 3; s += 5.6f) {
            bool drawn = dice.chance(0.5f);
            float off = dice.between(-0.25f, 0.25f), in_lane = dice.between(-0.08f, 0.08f);
            if (!drawn || !is_free(s, 8)) continue;
            Station here = station(way.line, s + off);
            Vec2 left{here.along.z, -here.along.x};
            Vec2 at = here.at + left * (side * (way.width * 0.5f - 1.08f + in_lane));
            add_prop(d, dice, PropKind::car, at, heading_of(here.along * -side), 1.47f);
        }
    }
}

void add_signals(District& d, Dice& dice, uint32_t node, const std::vector<Clear>& clear) {
    const StreetPlan& plan = d.streets;
    if (!has_signals(plan, node)) return;
    for (uint32_t w : plan.ways_at[node]) {
        const Way& way = plan.ways[w];
        if (!way.carries_cars()) continue;
        std::vector<Vec2> line = line_from(way, node);
        float s = way.from == node ? clear[w].start : clear[w].end;
        Station here = station(line, s - 1.2f);
        Vec2 right{-here.along.z, here.along.x};
        Vec2 at = here.at + right * (way.width * 0.5f + 0.45f);
        // For those who drive in, and come from further along the arm.
        add_prop(d, dice, PropKind::signal, at, heading_of(here.along), 3.4f);
        add_prop(d, dice, PropKind::signal, here.at - right * (way.width * 0.5f + 0.45f),
                 heading_of(here.along), 3.4f);
    }
}

}  // namespace

void lay_streets(District& d, uint64_t seed) {
    const StreetPlan& plan = d.streets;
    std::vector<Clear> clear(plan.ways.size());
    for (uint32_t w = 0; w < plan.ways.size(); ++w) {
        const Way& way = plan.ways[w];
        Dice dice{{seed, w, 2, Purpose::city}};
        if (way.carries_cars()) {
            lay_carriageway(d, way);
        } else if (way.kind != WayKind::none) {
            lay_lane(d, dice, way);
        }
    }
    std::vector<uint8_t> ruled;
    for (uint32_t node = 0; node < plan.nodes.size(); ++node) lay_junction(d, node, clear, ruled);
    set_lamps(d.city.crossings, ruled, seed);
    for (uint32_t w = 0; w < plan.ways.size(); ++w) {
        Dice dice{{seed, w, 3, Purpose::city}};
        if (plan.ways[w].carries_cars()) furnish(d, dice, plan.ways[w], clear[w]);
    }
    for (uint32_t node = 0; node < plan.nodes.size(); ++node) {
        Dice dice{{seed, node, 4, Purpose::city}};
        add_signals(d, dice, node, clear);
    }
}

}  // namespace flaneur
