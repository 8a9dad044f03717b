#include "assets/plan/streets.h"

#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "assets/plan/masses.h"

namespace flaneur {

namespace {

constexpr float k_apron = 5;  // paved beyond a sidewalk, metres
// How far the walls may be that streets without sidewalks are paved to, metres: from the middle of streets
// that belong to people, and from the edges of lanes and alleys.
constexpr float k_wide = 14, k_beside_lane = 4.5f, k_beside_alley = 2.5f;

// What tags say about one side's sidewalk.
enum class SideTag { unknown, none, own, separate };

SideTag side_tag(const OsmTags& tags, bool left) {
    std::string_view side = left ? "left" : "right", value = tags[left ? "sidewalk:left" : "sidewalk:right"];
    if (value.empty()) value = tags["sidewalk:both"];
    if (value == "yes") return SideTag::own;
    if (value == "no" || value == "none") return SideTag::none;
    if (value == "separate") return SideTag::separate;
    value = tags["sidewalk"];
    if (value == "both" || value == "yes" || value == side) return SideTag::own;
    if (value == "left" || value == "right" || value == "no" || value == "none") return SideTag::none;
    return value == "separate" ? SideTag::separate : SideTag::unknown;
}

// How far from the road's centre others begin that run along on one side, no more than 8 m beyond its edge,
// if they do along at least two fifths of it.
std::optional<float> alongside(const SegmentIndex& others, const std::vector<Vec2>& line, float half_width,
                               bool left) {
    constexpr float k_step = 6, k_beyond = 8, k_widest = 15;
    int samples = 0;
    std::vector<float> found;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        Vec2 along = normalize_or(line[i + 1] - line[i], {1, 0}),
             out = Vec2{along.z, -along.x} * (left ? 1.0f : -1.0f);
        float distance = length(line[i + 1] - line[i]);
        int steps = std::max(1, static_cast<int>(distance / k_step));
        for (int s = 0; s < steps; ++s) {
            Vec2 p =
                line[i] + along * (distance * (static_cast<float>(s) + 0.5f) / static_cast<float>(steps));
            float best = half_width + k_beyond;
            bool any = false;
            others.near(p, best + k_widest, [&](const LinePiece& f) {
                Vec2 d = f.b - f.a;
                if (std::fabs(dot(normalize_or(d, {1, 0}), along)) < 0.9f) return;
                float forward = dot(d, along);
                float t = dot(p - f.a, along) / (std::fabs(forward) < 0.01f ? 0.01f : forward);
                if (t < 0 || t > 1) return;
                float away = dot(f.a + d * t - p, out) - f.half;
                if (away < half_width - 1.5f || away >= best) return;
                best = away;
                any = true;
            });
            ++samples;
            if (any) found.push_back(best);
        }
    }
    if (samples == 0 || static_cast<int>(found.size()) * 5 < samples * 2) return std::nullopt;
    std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2),
                     found.end());
    return found[found.size() / 2];
}

bool is_one_way(const OsmStreet& road) {
    return road.way->tags.is("oneway", "yes") || road.way->tags.is("oneway", "-1");
}

// The width of a sidewalk that belongs to the road itself, so that what both schemas map is laid once: where
// the sidewalk is a way of its own, the pavement reaches from the kerb to that way. Between the carriageways
// of one street there is none that the map does not tell of.
float sidewalk_width(const OsmStreet& road, const SegmentIndex& footways, const SegmentIndex& carriageways,
                     const std::vector<Vec2>& line, bool left) {
    if (side_tag(road.way->tags, left) == SideTag::none) return 0;
    float half = road.highway.width * 0.5f;
    if (std::optional<float> separate = alongside(footways, line, half, left)) {
        return clamp(*separate - half + 1.1f, 1.5f, 7);
    }
    bool is_median = is_one_way(road) && side_tag(road.way->tags, left) == SideTag::unknown &&
                     alongside(carriageways, line, half, left);
    return is_median ? 0 : tagged_sidewalk(road, left);
}

// Streets that people have to themselves, or first of all.
bool is_for_people(const OsmTags& tags) {
    return tags.is("highway", "pedestrian") || tags.is("highway", "living_street");
}

void add_way(OsmImport& in, const OsmStreet& way) {
    const OsmHighway& highway = way.highway;
    for (const std::vector<Vec2>& line : way.lines) {
        Area area;
        bool service = way.way->tags.is("highway", "service");
        area.rank = highway.kind == Surface::sidewalk            ? k_rank_sidewalk
                    : highway.kind == Surface::plaza && !service ? k_rank_plaza
                                                                 : k_rank_path;
        area.kind = highway.kind;
        if (service) area.axis = {};
        area.lift = flat(k_kerb);
        add_strip(area.rings, line, highway.width * 0.5f, highway.width * 0.5f, true);
        OsmPaving paving{line, 0, 0, false, false, area};
        paving.area.rings.clear();
        bool is_wide = is_for_people(way.way->tags);
        paving.to_streets = is_wide;
        paving.needs_both = !is_wide && !service;
        paving.left = paving.right = is_wide ? k_wide : highway.width * 0.5f + k_beside_alley;
        in.pavings.push_back(std::move(paving));
        in.plan.areas.push_back(std::move(area));
    }
}

// Steps follow the hill in flights of some 10 m with landings between, always up or always down.
void line_flights(GroundPlan& plan, const std::vector<Vec2>& line, const OsmStreet& steps) {
    constexpr float k_flight = 10;
    float whole = length_of(line);
    int flights = std::max(1, static_cast<int>(whole / k_flight));
    auto height = [&](Vec2 p) { return terrain_at(plan, p) + k_kerb; };
    float from = height(line.front()), last = height(line.back()), rise = last - from;
    auto stated = static_cast<float>(stated_risers(steps.way->tags));
    for (int i = 0; i < flights; ++i) {
        auto place = [&](int k) { return whole * static_cast<float>(k) / static_cast<float>(flights); };
        Flight flight;
        flight.line = part_of(line, place(i), place(i + 1));
        flight.width = steps.highway.width;
        float to = i + 1 == flights ? last : height(flight.line.back());
        to = rise > 0 ? clamp(to, from, last) : clamp(to, last, from);
        flight.from = from;
        flight.to = to;
        if (rise != 0) flight.risers = static_cast<int>(std::floor(stated * (to - from) / rise + 0.5f));
        if (riser_count(to - from, flight.risers) == 0 && i + 1 < flights) flight.to = from;
        if (riser_count(rise, 0) > 0) add_flight(plan, flight);
        from = flight.to;
    }
}

// Steps begin and end beside the streets that they come from, where there is no kerb to be drawn.
void add_steps(OsmImport& in, const OsmStreet& steps) {
    auto on_street = [&](Vec2 p) {
        bool found = false;
        in.streets.near(p, 12, [&](const LinePiece& s) {
            found |= length(lerp(s.a, s.b, closest_on(s, p)) - p) < s.half;
        });
        return found;
    };
    for (const std::vector<Vec2>& line : steps.lines) {
        constexpr float k_stride = 0.25f;
        float whole = length_of(line), from = 0, to = whole;
        if (whole < 0.5f) continue;
        while (from < 0.4f * whole && on_street(part_of(line, from, whole).front())) from += k_stride;
        while (to > 0.6f * whole && on_street(part_of(line, 0, to).back())) to -= k_stride;
        line_flights(in.plan, part_of(line, from, to), steps);
        // Before and after it, or where it does not rise.
        Area rest;
        rest.rank = k_rank_path;
        rest.kind = Surface::steps;
        rest.lift = flat(k_kerb);
        rest.axis = normalize_or(line.back() - line.front(), {1, 0});
        add_strip(rest.rings, line, steps.highway.width * 0.5f, steps.highway.width * 0.5f, false);
        in.plan.areas.push_back(std::move(rest));
    }
}

// Whether people walk on the carriageway as cars drive on it: small streets without sidewalks.
bool is_shared(const OsmStreet& road, const Street& street) {
    std::string_view name = road.way->tags["highway"];
    bool small = name == "residential" || name == "unclassified" || name == "road";
    return small && street.left + street.right == 0;
}

// Beside a carriageway without a sidewalk, up to houses that are near: the lane goes on, or a sidewalk.
void pave_beside(OsmImport& in, const Street& street, bool is_lane) {
    OsmPaving paving;
    paving.line = street.line;
    float reach = street.width * 0.5f + k_beside_lane;
    if (street.left <= 0) paving.left = reach;
    if (street.right <= 0) paving.right = reach;
    paving.area.kind = is_lane ? Surface::plaza : Surface::sidewalk;
    if (is_lane) paving.area.axis = {};
    paving.area.lift = flat(is_lane ? 0 : k_kerb);
    in.pavings.push_back(std::move(paving));
}

// Where carriageways run together, wedges and ribbons of kerb would be left between them that nobody can
// stand on; they are road, and islands end as wide as a kerb's nose.
void fill_wedges(GroundPlan& plan) {
    constexpr float k_nose = 0.7f;  // half of the least width, metres
    Rings roads;
    for (const Area& area : plan.areas) {
        if (area.rank == k_rank_road && area.kind == Surface::road)
            roads.insert(roads.end(), area.rings.begin(), area.rings.end());
    }
    roads = unite(roads);
    Area fill;
    fill.rank = k_rank_road;
    fill.kind = Surface::road;
    fill.rings = subtract(inset_rings(inset_rings(roads, -k_nose), k_nose), roads);
    // Less what rounding to millimetres leaves along every kerb, and a little into the roads.
    fill.rings = inset_rings(inset_rings(fill.rings, 0.01f), -0.02f);
    if (!fill.rings.empty()) plan.areas.push_back(std::move(fill));
}

// Where a street goes on as a narrower one, its end is square: a round one would bulge into the other.
bool ends_square(const std::vector<std::pair<int64_t, float>>& ends, const OsmStreet& road, int64_t node) {
    auto first = std::lower_bound(ends.begin(), ends.end(), std::pair(node, 0.0f));
    auto last = std::upper_bound(first, ends.end(), std::pair(node, 1e9f));
    return last - first == 2 && first->second < road.highway.width;
}

}  // namespace

float tagged_sidewalk(const OsmStreet& street, bool left) {
    const OsmTags& tags = street.way->tags;
    SideTag tag = side_tag(tags, left);
    if (tag == SideTag::none) return 0;
    std::optional<float> width = parse_metres(tags[left ? "sidewalk:left:width" : "sidewalk:right:width"]);
    if (!width) width = parse_metres(tags["sidewalk:both:width"]);
    if (!width) width = parse_metres(tags["sidewalk:width"]);
    if (tag != SideTag::unknown)
        return width && *width < 20 ? *width : std::max(street.highway.sidewalk, 2.2f);
    return street.highway.sidewalk;
}

void add_osm_streets(OsmImport& in) {
    std::vector<OsmStreet> roads, ways, steps;
    std::vector<int64_t> raised_nodes;
    SegmentIndex footways, carriageways;  // carriageways: of streets that are one way
    for (const OsmWay& way : in.map.ways) {
        if (!way.tags.has("highway")) continue;
        if (is_hidden(way.tags)) ++in.counts.hidden;
        std::optional<OsmHighway> highway = highway_of(way.tags);
        bool is_area = way.tags.is("area", "yes") || (way.closed() && way.tags.has("area:highway"));
        if (!highway || is_area || way.nodes.size() < 2) continue;
        OsmStreet street{&way, *highway, lines_of(in, way)};
        if (!street.lines.empty()) count_built(in.counts, way.tags, OsmSort::road, OsmSort::layer);
        if (highway->level > 0) {
            raised_nodes.insert(raised_nodes.end(), way.nodes.begin(), way.nodes.end());
            in.raised.push_back(std::move(street));
            continue;
        }
        if (way.tags.is("footway", "sidewalk")) {
            for (const std::vector<Vec2>& line : street.lines) footways.add(line, 0, 0);
        }
        if (highway->drives && is_one_way(street)) {
            for (const std::vector<Vec2>& line : street.lines)
                carriageways.add(line, 0, highway->width * 0.5f);
        }
        (highway->drives                   ? roads
         : highway->kind == Surface::steps ? steps
                                           : ways)
            .push_back(std::move(street));
    }
    footways.sort();
    carriageways.sort();
    std::sort(raised_nodes.begin(), raised_nodes.end());
    auto is_raised = [&](int64_t node) {
        return std::binary_search(raised_nodes.begin(), raised_nodes.end(), node);
    };

    std::vector<std::pair<int64_t, float>> ends;
    for (const OsmStreet& road : roads) {
        for (int64_t id : {road.way->nodes.front(), road.way->nodes.back()}) {
            ends.push_back({id, road.highway.width});
        }
    }
    std::sort(ends.begin(), ends.end());
    Area apron;
    apron.rank = k_rank_apron;
    apron.kind = Surface::sidewalk;
    apron.lift = flat(k_kerb);
    auto index_of = [&](const OsmStreet& street) {
        return static_cast<uint32_t>(street.way - in.map.ways.data());
    };
    for (const OsmStreet& road : roads) {
        for (const std::vector<Vec2>& line : road.lines) {
            Street street;
            street.line = line;
            street.width = road.highway.width;
            street.left = sidewalk_width(road, footways, carriageways, line, true);
            street.right = sidewalk_width(road, footways, carriageways, line, false);
            street.round_start = !ends_square(ends, road, road.way->nodes.front());
            street.round_end = !ends_square(ends, road, road.way->nodes.back());
            if (is_shared(road, street)) {
                Area lane;
                lane.rank = k_rank_road;
                lane.kind = Surface::plaza;
                lane.axis = {};
                add_strip(lane.rings, line, street.width * 0.5f, street.width * 0.5f, street.round_start,
                          street.round_end);
                in.plan.areas.push_back(std::move(lane));
            }
            pave_beside(in, street, is_shared(road, street));
            add_street(in.plan, street);
            in.streets.add(line, index_of(road), street.width * 0.5f + std::max(street.left, street.right));
            // What lies between the sidewalk and the houses is paved too, unless the map says otherwise.
            auto reach = [&](float sidewalk) {
                return sidewalk > 0 ? road.highway.width * 0.5f + sidewalk + k_apron : 0;
            };
            if (street.left + street.right > 0)
                add_strip(apron.rings, line, reach(street.left), reach(street.right), true);
        }
    }
    in.plan.areas.push_back(std::move(apron));
    for (const OsmStreet& way : ways) {
        add_way(in, way);
        for (const std::vector<Vec2>& line : way.lines) in.streets.add(line, index_of(way), 0);
    }
    in.streets.sort();
    for (OsmStreet& flight : steps) {
        if (is_raised(flight.way->nodes.front()) || is_raised(flight.way->nodes.back())) {
            in.raised.push_back(std::move(flight));
        } else {
            add_steps(in, flight);
        }
    }
    add_osm_crossings(in, roads);
    fill_wedges(in.plan);
}

}  // namespace flaneur
