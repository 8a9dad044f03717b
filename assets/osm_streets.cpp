#include <algorithm>
#include <cmath>

#include "assets/masses.h"
#include "assets/osm_map.h"
#include "assets/streets.h"

namespace flaneur {

namespace {

constexpr float k_apron = 5;  // paved beyond a sidewalk, metres

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

// How far from the road's centre a footway runs along on one side, if it does along at least two fifths of
// it.
std::optional<float> alongside(const SegmentIndex& footways, const std::vector<Vec2>& line, float half_width,
                               bool left) {
    constexpr float k_step = 6, k_beyond = 8;
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
            footways.near(p, best, [&](const Segment& f) {
                Vec2 d = f.b - f.a;
                if (std::fabs(dot(normalize_or(d, {1, 0}), along)) < 0.9f) return;
                float forward = dot(d, along);
                float t = dot(p - f.a, along) / (std::fabs(forward) < 0.01f ? 0.01f : forward);
                if (t < 0 || t > 1) return;
                float away = dot(f.a + d * t - p, out);
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

// The width of a sidewalk that belongs to the road itself, so that what both schemas map is laid once: where
// the sidewalk is a way of its own, the pavement reaches from the kerb to that way.
float sidewalk_width(const OsmStreet& road, const SegmentIndex& footways, const std::vector<Vec2>& line,
                     bool left) {
    if (side_tag(road.way->tags, left) == SideTag::none) return 0;
    float half = road.highway.width * 0.5f;
    if (std::optional<float> separate = alongside(footways, line, half, left)) {
        return clamp(*separate - half + 1.1f, 1.5f, 7);
    }
    return tagged_sidewalk(road, left);
}

void add_way(OsmImport& in, const OsmStreet& way) {
    const OsmHighway& highway = way.highway;
    for (const std::vector<Vec2>& line : way.lines) {
        Area area;
        area.rank = highway.kind == Surface::sidewalk ? k_rank_sidewalk
                    : highway.kind == Surface::plaza  ? k_rank_plaza
                                                      : k_rank_path;
        area.kind = highway.kind;
        area.lift = flat(k_kerb);
        add_strip(area.rings, line, highway.width * 0.5f, highway.width * 0.5f, true);
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
    float stated = clamp(parse_number(steps.way->tags["step_count"]).value_or(0), 0, 1000);
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
        in.streets.near(
            p, 12, [&](const Segment& s) { found |= length(lerp(s.a, s.b, closest_on(s, p)) - p) < s.half; });
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

void add_junctions_and_crossings(OsmImport& in, const std::vector<OsmStreet>& roads) {
    std::vector<Meeting> meetings;
    for (uint32_t r = 0; r < roads.size(); ++r) {
        for (uint32_t i = 0; i < roads[r].way->nodes.size(); ++i)
            meetings.push_back({roads[r].way->nodes[i], r, i});
    }
    std::sort(meetings.begin(), meetings.end(),
              [](const Meeting& a, const Meeting& b) { return a.key() < b.key(); });
    // Nodes of footways that are crossings, with the way's direction there.
    std::vector<std::pair<int64_t, std::pair<const OsmWay*, size_t>>> crossed;
    for (const OsmWay& way : in.map.ways) {
        bool crossing = way.tags.is("footway", "crossing") || way.tags.is("cycleway", "crossing") ||
                        way.tags.is("path", "crossing");
        if (!crossing || is_hidden(way.tags)) continue;
        for (size_t i = 0; i < way.nodes.size(); ++i) crossed.push_back({way.nodes[i], {&way, i}});
    }
    std::stable_sort(crossed.begin(), crossed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });

    for (size_t i = 0; i < meetings.size();) {
        size_t end = i;
        while (end < meetings.size() && meetings[end].node == meetings[i].node) ++end;
        const OsmNode* node = in.map.node(meetings[i].node);
        std::vector<Arm> arms;
        for (size_t m = i; node && m < end; ++m) {
            const OsmStreet& road = roads[meetings[m].road];
            for (int step : {-1, 1}) {
                std::optional<Vec2> d = direction_from(in, *road.way, meetings[m].place, step);
                if (d) arms.push_back({*d, road.highway.width * 0.5f});
            }
        }
        if (node && arms.size() >= 3) add_corners(in.plan, in.project(*node), arms, 4);
        if (node && arms.size() == 2) {
            auto by_id = [](const auto& a, int64_t id) { return a.first < id; };
            auto footway = std::lower_bound(crossed.begin(), crossed.end(), node->id, by_id);
            bool has_way = footway != crossed.end() && footway->first == node->id;
            std::string_view type = node->tags["crossing"];
            const OsmTags& way_tags = has_way ? footway->second.first->tags : node->tags;
            bool none = type == "no" || way_tags.is("crossing", "no");
            if ((node->tags.is("highway", "crossing") || has_way) && !none) {
                bool marked = type != "unmarked" && !way_tags.is("crossing", "unmarked") &&
                              !node->tags.is("crossing:markings", "no") &&
                              !way_tags.is("crossing:markings", "no");
                // The carriageway runs from one arm to the other; a bend counts half to each.
                Vec2 along = normalize_or(arms[0].direction - arms[1].direction, arms[0].direction),
                     across{-along.z, along.x};
                if (has_way) {
                    auto [way, place] = footway->second;
                    std::optional<Vec2> d = direction_from(in, *way, place, 1);
                    if (!d) d = direction_from(in, *way, place, -1);
                    if (d) across = *d;
                }
                float half = std::max(arms[0].half_width, arms[1].half_width);
                if (node->tags.is("highway", "crossing")) count_built(in.counts, OsmSort::crossing_node);
                add_crossing(in.plan, in.project(*node), along, across, half, 4, marked);
            }
        }
        i = end;
    }
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
    in.building_areas = in.plan.areas.size();
    std::vector<OsmStreet> roads, ways, steps;
    std::vector<int64_t> raised_nodes;
    SegmentIndex footways;
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
        (highway->drives                   ? roads
         : highway->kind == Surface::steps ? steps
                                           : ways)
            .push_back(std::move(street));
    }
    footways.sort();
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
            street.left = sidewalk_width(road, footways, line, true);
            street.right = sidewalk_width(road, footways, line, false);
            street.round_start = !ends_square(ends, road, road.way->nodes.front());
            street.round_end = !ends_square(ends, road, road.way->nodes.back());
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
    add_junctions_and_crossings(in, roads);
}

}  // namespace flaneur
