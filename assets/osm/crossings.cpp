// Junctions, crossings and kerbs of the map.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "assets/osm/map.h"
#include "assets/plan/masses.h"
#include "assets/plan/streets.h"

namespace flaneur {

namespace {

// Those laid so far, and whether signals are drawn at each.
struct Laid {
    std::vector<Crossing> all;
    std::vector<uint8_t> ruled;
};

// Whether a crossing is drawn with signals.
bool has_signals(const OsmTags& tags) {
    return tags.is("crossing", "traffic_signals") || tags.is("crossing:signals", "yes") ||
           tags.is("highway", "traffic_signals");
}

// The ways that leave a node, as far as they are known.
struct Meeting {
    int64_t node;
    uint32_t road;
    uint32_t place;  // of the node in the way
    auto key() const { return std::tuple(node, road, place); }
};

Vec2 at(const OsmImport& in, int64_t id, Vec2 otherwise) {
    const OsmNode* node = in.map.node(id);
    return node ? in.project(*node) : otherwise;
}

// The unit direction from place `from` of the way towards its end (step 1) or start (-1), over at least 4 m.
std::optional<Vec2> direction_from(const OsmImport& in, const OsmWay& way, size_t from, int step) {
    Vec2 start = at(in, way.nodes[from], {}), last = start;
    for (auto i = static_cast<std::ptrdiff_t>(from) + step;
         i >= 0 && i < static_cast<std::ptrdiff_t>(way.nodes.size()); i += step) {
        last = at(in, way.nodes[static_cast<size_t>(i)], last);
        if (length(last - start) > 4) break;
    }
    if (length(last - start) < 1) return std::nullopt;
    return normalize_or(last - start, {1, 0});
}

// A footway over a carriageway: one of its nodes.
struct Footway {
    int64_t node;
    const OsmWay* way;
    uint32_t place;  // of the node in the way
    bool tagged;     // as a crossing; else it merely passes
};

std::vector<Footway> find_footways(const OsmImport& in) {
    std::vector<Footway> footways;
    for (const OsmWay& way : in.map.ways) {
        bool crossing = way.tags.is("footway", "crossing") || way.tags.is("cycleway", "crossing") ||
                        way.tags.is("path", "crossing");
        // Service ways too: the kerbs are dropped there, so that people cross there.
        bool passes = way.tags.is("highway", "footway") || way.tags.is("highway", "path") ||
                      way.tags.is("highway", "pedestrian") || way.tags.is("highway", "service") ||
                      way.tags.is("highway", "living_street");
        if ((!crossing && !passes) || is_hidden(way.tags)) continue;
        for (uint32_t i = 0; i < way.nodes.size(); ++i) footways.push_back({way.nodes[i], &way, i, crossing});
    }
    std::stable_sort(footways.begin(), footways.end(), [](const Footway& a, const Footway& b) {
        return std::pair(a.node, !a.tagged) < std::pair(b.node, !b.tagged);
    });
    return footways;
}

// Whether the ends of a crossing are said to have raised kerbs.
bool has_raised_kerbs(const OsmImport& in, const OsmTags& node, const OsmWay* way) {
    int raised = node.is("kerb", "raised"), lower = 0;
    for (size_t i = 0; way && i < way->nodes.size(); ++i) {
        const OsmNode* end = in.map.node(way->nodes[i]);
        if (!end || !end->tags.has("kerb")) continue;
        (end->tags.is("kerb", "raised") ? raised : lower) += 1;
    }
    return raised > lower;
}

// Puts a crossing where a node of a carriageway is one, or a footway that is one passes it.
void cross(OsmImport& in, const OsmNode& node, const JunctionArm& first, const JunctionArm& second,
           const Footway* footway, Laid& crossings) {
    std::string_view type = node.tags["crossing"];
    const OsmTags& way_tags = footway ? footway->way->tags : node.tags;
    if (!(node.tags.is("highway", "crossing") || footway) || type == "no" || way_tags.is("crossing", "no"))
        return;
    bool marked = node.tags.is("highway", "crossing") || footway->tagged;
    for (const OsmTags* tags : {&node.tags, &way_tags}) {
        marked &= !tags->is("crossing", "unmarked") && !tags->is("crossing:markings", "no");
    }
    // The carriageway runs from one arm to the other; a bend counts half to each.
    Vec2 along = normalize_or(first.direction - second.direction, first.direction), across{-along.z, along.x};
    if (footway) {
        std::optional<Vec2> d = direction_from(in, *footway->way, footway->place, 1);
        if (!d) d = direction_from(in, *footway->way, footway->place, -1);
        if (d) across = *d;
    }
    Vec2 centre = in.project(node);
    GroundPlan made;
    crossings.all.push_back(
        add_crossing(made, centre, along, across, std::max(first.half_width, second.half_width), 4, marked));
    crossings.ruled.push_back(has_signals(node.tags) || has_signals(way_tags));
    bool raised = has_raised_kerbs(in, node.tags, footway ? footway->way : nullptr);
    Rings carriageway;
    for (const JunctionArm& arm : {first, second})
        add_strip(carriageway, {centre - arm.direction * 0.5f, centre + arm.direction * 12}, arm.half_width,
                  arm.half_width, false);
    for (Area& area : made.areas) {
        // Stripes end at the kerb, where the carriageway narrows too.
        if (area.kind == Surface::crossing) area.rings = intersect(area.rings, carriageway);
        if (area.kind == Surface::crossing || !raised) in.plan.areas.push_back(std::move(area));
    }
    if (node.tags.is("highway", "crossing")) count_built(in.counts, OsmSort::crossing_node);
}

// People cross the arms of a junction, lines or none: lays unmarked crossings over those that have pavements
// and no crossing near. `places` are about where they would be, a little before the rounded corners.
void cross_arms(OsmImport& in, const std::vector<Vec2>& places, Laid& crossings) {
    constexpr float k_near = 12, k_widest = 20;  // metres
    for (Vec2 p : places) {
        const LinePiece* s = in.streets.nearest(p, 2);
        if (!s || s->half <= 0) continue;
        float half = highway_of(in.map.ways[s->owner].tags)->width * 0.5f;
        Vec2 centre = lerp(s->a, s->b, closest_on(*s, p)), along = normalize_or(s->b - s->a, {1, 0});
        if (s->half < half + 1.5f || half * 2 > k_widest) continue;
        bool crossed = std::any_of(crossings.all.begin(), crossings.all.end(), [&](const Crossing& c) {
            const Vec2 from = on_ground(c.centre) - centre;
            return std::fabs(dot(from, along)) < k_near && std::fabs(cross(from, along)) < half + 2;
        });
        if (crossed) continue;
        Vec2 across{-along.z, along.x};
        crossings.all.push_back(add_crossing(in.plan, centre, along, across, half, 4, false));
        crossings.ruled.push_back(0);
    }
}

// Kerbs that are lowered elsewhere: at driveways, and where crossings are drawn by their kerbs alone.
void lower_kerbs(OsmImport& in, const Laid& crossings) {
    for (const OsmNode& node : in.map.nodes) {
        std::string_view kerb = node.tags["kerb"];
        if (kerb != "lowered" && kerb != "flush" && kerb != "rolled") continue;
        Vec2 p = in.project(node);
        const LinePiece* street = nullptr;
        float least = 3;  // metres from the kerb of its street
        in.streets.near(p, 14, [&](const LinePiece& s) {
            if (s.half <= 0) return;
            float half = highway_of(in.map.ways[s.owner].tags)->width * 0.5f;
            float off = std::fabs(length(lerp(s.a, s.b, closest_on(s, p)) - p) - half);
            if (off < least) least = off, street = &s;
        });
        if (!street) continue;
        Vec2 centre = lerp(street->a, street->b, closest_on(*street, p)), out = p - centre;
        float half = highway_of(in.map.ways[street->owner].tags)->width * 0.5f;
        bool crossed = std::any_of(crossings.all.begin(), crossings.all.end(), [&](const Crossing& c) {
            return length(on_ground(c.centre) - centre) < 3;
        });
        if (crossed || length(out) < 0.5f) continue;
        out = normalize_or(out, {1, 0});
        add_dropped_kerb(in.plan, centre + out * half, out, 2.5f);
    }
}

// Signals of a junction, and those before a crossing, rule the crossings that are near them, drawn with
// signals of their own or not.
void rule_by_signals(const std::vector<Vec2>& signals, Laid& crossings) {
    constexpr float k_near = 18;  // metres
    for (size_t i = 0; i < crossings.all.size(); ++i)
        for (const Vec2 at : signals)
            if (length(on_ground(crossings.all[i].centre) - at) < k_near) crossings.ruled[i] = 1;
}

}  // namespace

void add_osm_crossings(OsmImport& in, const std::vector<OsmStreet>& roads) {
    std::vector<Meeting> meetings;
    for (uint32_t r = 0; r < roads.size(); ++r) {
        for (uint32_t i = 0; i < roads[r].way->nodes.size(); ++i)
            meetings.push_back({roads[r].way->nodes[i], r, i});
    }
    std::sort(meetings.begin(), meetings.end(),
              [](const Meeting& a, const Meeting& b) { return a.key() < b.key(); });
    std::vector<Footway> footways = find_footways(in);
    Laid crossings;
    std::vector<Vec2> arm_places, signals;
    for (size_t i = 0; i < meetings.size();) {
        size_t end = i;
        while (end < meetings.size() && meetings[end].node == meetings[i].node) ++end;
        const OsmNode* node = in.map.node(meetings[i].node);
        std::vector<JunctionArm> arms;
        for (size_t m = i; node && m < end; ++m) {
            const OsmStreet& road = roads[meetings[m].road];
            for (int step : {-1, 1}) {
                std::optional<Vec2> d = direction_from(in, *road.way, meetings[m].place, step);
                if (d) arms.push_back({*d, road.highway.width * 0.5f});
            }
        }
        i = end;
        if (!node) continue;
        if (node->tags.is("highway", "traffic_signals")) signals.push_back(in.project(*node));
        if (arms.size() >= 3) {
            Vec2 junction = in.project(*node);
            std::vector<float> straight = add_corners(in.plan, junction, arms, 4);
            for (size_t a = 0; a < arms.size(); ++a)
                arm_places.push_back(junction + arms[a].direction * (straight[a] + 2));
        }
        if (arms.size() != 2) continue;
        auto footway = std::lower_bound(footways.begin(), footways.end(), node->id,
                                        [](const Footway& f, int64_t id) { return f.node < id; });
        bool has_way = footway != footways.end() && footway->node == node->id;
        cross(in, *node, arms[0], arms[1], has_way ? &*footway : nullptr, crossings);
    }
    cross_arms(in, arm_places, crossings);
    lower_kerbs(in, crossings);
    rule_by_signals(signals, crossings);
    in.city.crossings.all = std::move(crossings.all);
    set_lamps(in.city.crossings, crossings.ruled, 1);
}

}  // namespace flaneur
