#include "assets/plan/streets.h"

#include <algorithm>
#include <cmath>

#include "assets/plan/masses.h"
#include "sim/base/math.h"

namespace flaneur {

void add_street(GroundPlan& plan, const Street& street) {
    Area road;
    road.rank = k_rank_road;
    road.kind = Surface::road;
    add_strip(road.rings, street.line, street.width * 0.5f, street.width * 0.5f, street.round_start,
              street.round_end);
    plan.areas.push_back(std::move(road));
    if (street.left <= 0 && street.right <= 0) return;
    Area sidewalk;
    sidewalk.rank = k_rank_sidewalk;
    sidewalk.kind = Surface::sidewalk;
    sidewalk.lift = flat(k_kerb);
    auto reach = [&](float width) { return width > 0 ? street.width * 0.5f + width : 0; };
    add_strip(sidewalk.rings, street.line, reach(street.left), reach(street.right), street.round_start,
              street.round_end);
    plan.areas.push_back(std::move(sidewalk));
}

std::vector<float> add_corners(GroundPlan& plan, Vec2 junction, const std::vector<JunctionArm>& arms,
                               float radius) {
    std::vector<float> straight(arms.size(), 0);
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < arms.size(); ++i) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        float ha = arctan2(arms[a].direction.z, arms[a].direction.x);
        float hb = arctan2(arms[b].direction.z, arms[b].direction.x);
        return ha != hb ? ha < hb : a < b;
    });
    Area road;
    road.rank = k_rank_road;
    road.kind = Surface::road;
    for (size_t k = 0; k < order.size() && order.size() > 1; ++k) {
        uint32_t i = order[k], j = order[(k + 1) % order.size()];
        Vec2 u = arms[i].direction, v = arms[j].direction;
        float sine = cross(u, v), cosine = dot(u, v);
        // From u to v by growing heading: between 20 and 160 degrees there is a corner to round.
        if (sine < 0.34f) continue;
        // The corner c of the kerbs: half_width to the left of u (towards v) and to the right of v.
        float a = (arms[j].half_width + arms[i].half_width * cosine) / sine;
        float b = (arms[i].half_width + arms[j].half_width * cosine) / sine;
        Vec2 corner = junction + u * a + Vec2{-u.z, u.x} * arms[i].half_width;
        float tangent = sine / (1 + cosine), reach = std::min(radius / tangent, 9.0f), r = reach * tangent;
        straight[i] = std::max(straight[i], a + reach);
        straight[j] = std::max(straight[j], b + reach);
        Vec2 centre = corner + u * reach + Vec2{-u.z, u.x} * r;
        Ring ring{to_point(corner), to_point(corner + u * reach)};
        Vec2 from = -Vec2{-u.z, u.x}, to = Vec2{v.z, -v.x} * -1.0f;
        constexpr int k_pieces = 6;
        for (int s = 1; s < k_pieces; ++s) {
            Vec2 n = normalize_or(lerp(from, to, static_cast<float>(s) / k_pieces), from);
            ring.push_back(to_point(centre + n * r));
        }
        ring.push_back(to_point(corner + v * reach));
        ring = positive(std::move(ring));
        if (twice_area(ring) > 0) road.rings.push_back(std::move(ring));
    }
    if (!road.rings.empty()) plan.areas.push_back(std::move(road));
    return straight;
}

static constexpr float k_ramp = 1.2f;  // from a dropped kerb up to the sidewalk, metres

void add_dropped_kerb(GroundPlan& plan, Vec2 kerb, Vec2 out, float breadth) {
    Area ramp;
    ramp.rank = k_rank_dropped_kerb;
    ramp.kind = Surface::sidewalk;
    ramp.axis = out;
    ramp.lift = {k_dropped_kerb, k_dropped_kerb, k_kerb, kerb, out * ((k_kerb - k_dropped_kerb) / k_ramp)};
    add_strip(ramp.rings, {kerb - out * 0.5f, kerb + out * k_ramp}, breadth * 0.5f, breadth * 0.5f, false);
    plan.areas.push_back(std::move(ramp));
}

Crossing add_crossing(GroundPlan& plan, Vec2 centre, Vec2 along, Vec2 across, float half_width, float breadth,
                      bool marked) {
    Vec2 side = along * (breadth * 0.5f);
    // Half the way over, measured along `across`, which may be askew.
    Vec2 square{-along.z, along.x};
    float straight = dot(across, square);
    if (straight < 0) across = -across, straight = -straight;
    if (straight < 0.4f) across = square, straight = 1;
    Vec2 over = across * (half_width / straight);
    auto quad = [&](Vec2 from, Vec2 to) {
        return positive(
            {to_point(from - side), to_point(from + side), to_point(to + side), to_point(to - side)});
    };
    Area stripes;
    stripes.rank = k_rank_crossing;
    stripes.kind = Surface::crossing;
    stripes.axis = marked ? across : Vec2{};
    stripes.rings = {quad(centre - over, centre + over)};
    plan.areas.push_back(std::move(stripes));
    for (float way : {-1.0f, 1.0f}) {
        Area ramp;
        ramp.rank = k_rank_dropped_kerb;
        ramp.kind = Surface::sidewalk;
        ramp.axis = across;
        ramp.lift = {k_dropped_kerb, k_dropped_kerb, k_kerb, centre + over * way,
                     square * (way * (k_kerb - k_dropped_kerb) / k_ramp)};
        Vec2 kerb = centre + over * way;
        ramp.rings = {quad(kerb, kerb + across * (k_ramp / straight * way))};
        // A level part inside the carriageway, which wins there, so that no gap is left where the kerb is not
        // straight.
        Area landing = ramp;
        landing.lift = flat(k_dropped_kerb);
        landing.rings = {quad(centre + over * (way * 0.8f), kerb)};
        plan.areas.push_back(std::move(landing));
        plan.areas.push_back(std::move(ramp));
    }
    return {.centre = at_height(centre, 0),
            .across = across,
            .along = along,
            .half_length = half_width / straight,
            .half_width = breadth * 0.5f};
}

int riser_count(float rise, int stated) {
    float high = std::fabs(rise);
    float least = std::ceil(high / 0.25f), most = std::floor(high / 0.1f);
    if (most < 1) return 0;
    float wanted = stated > 0 ? static_cast<float>(stated) : std::floor(high / 0.16f + 0.5f);
    return static_cast<int>(clamp(wanted, std::max(least, 1.0f), most));
}

void add_flight(GroundPlan& plan, const Flight& flight) {
    int risers = riser_count(flight.to - flight.from, flight.risers);
    float whole = length_of(flight.line), run = whole / static_cast<float>(std::max(risers, 1));
    for (int i = 0; i <= risers; ++i) {
        float share = risers > 0 ? static_cast<float>(i) / static_cast<float>(risers) : 0;
        float from = i == 0 ? 0 : (static_cast<float>(i) - 0.5f) * run;
        float to = i == risers ? whole : (static_cast<float>(i) + 0.5f) * run;
        std::vector<Vec2> part = part_of(flight.line, from, to);
        Area tread;
        tread.rank = k_rank_steps;
        tread.kind = Surface::steps;
        tread.lift = level(lerp(flight.from, flight.to, share));
        tread.axis = normalize_or(part.back() - part.front(), {1, 0});
        if (flight.to < flight.from) tread.axis = -tread.axis;
        add_strip(tread.rings, part, flight.width * 0.5f, flight.width * 0.5f, false);
        plan.areas.push_back(std::move(tread));
    }
}

float length_of(const std::vector<Vec2>& line) {
    float sum = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) sum += length(line[i + 1] - line[i]);
    return sum;
}

std::vector<Vec2> part_of(const std::vector<Vec2>& line, float from, float to) {
    std::vector<Vec2> part;
    float at = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        float piece = length(line[i + 1] - line[i]), end = at + piece;
        bool last = i + 2 == line.size();
        if (piece > 0 && end >= from && at <= to) {
            if (part.empty()) part.push_back(lerp(line[i], line[i + 1], clamp((from - at) / piece, 0, 1)));
            part.push_back(lerp(line[i], line[i + 1], clamp((to - at) / piece, 0, 1)));
        }
        if (end >= to && !last) break;
        at = end;
    }
    if (part.empty()) part = {line.front(), line.back()};
    return part;
}

}  // namespace flaneur
