// Where one drives on a map: its carriageways as roads between the nodes that they share.
#include "sim/lanes/lanes.h"

#include <algorithm>
#include <cmath>

#include "assets/osm/street/laying.h"
#include "assets/place.h"

namespace flaneur {

namespace {

constexpr float k_least_lane = 2.2f, k_two_each = 12, k_two_one_way = 6.4f;  // metres of a carriageway
constexpr float k_inside = 2;    // metres from the map's edge to a gate
constexpr float k_cut_off = 30;  // metres from it within which a road that ends was cut off there

struct Class {
    std::string_view name;
    int rank;
    float speed;  // km/h where tags say none
};
constexpr Class k_classes[] = {{"motorway", 5, 60},     {"trunk", 4, 60},    {"primary", 3, 50},
                               {"secondary", 2, 50},    {"tertiary", 1, 50}, {"residential", 0, 30},
                               {"unclassified", 0, 40}, {"road", 0, 30}};

const Class* class_of(const OsmTags& tags) {
    std::string_view name = tags["highway"];
    if (name.ends_with("_link")) name.remove_suffix(5);
    const auto* found = std::ranges::find(k_classes, name, &Class::name);
    return found == std::end(k_classes) ? nullptr : found;
}

bool is_barred(const OsmTags& tags) {
    for (const std::string_view key : {"access", "vehicle", "motor_vehicle"})
        if (is_one_of(tags[key], {"no", "private"}))
            return !is_one_of(tags["motor_vehicle"], {"yes", "destination"});
    return tags.is("area", "yes");
}

float speed_of(const OsmTags& tags, const Class& usual) {
    const std::string_view text = tags["maxspeed"];
    const float times = text.find("mph") != std::string_view::npos ? 1.609f : 1;
    const std::optional<float> stated = parse_number(text.substr(0, text.find(' ')));
    const float limit = stated && *stated >= 5 ? *stated * times : usual.speed;
    return std::min(limit, 70.0f) / 3.6f;
}

// Lanes forward and backward, as tags or the breadth say.
void count_lanes(const OsmTags& tags, Road& road) {
    const bool is_round = tags.is("junction", "roundabout") || tags.is("junction", "circular");
    const bool is_back = tags.is("oneway", "-1"),
               is_one_way = is_back || is_round || is_one_of(tags["oneway"], {"yes", "true", "1"}) ||
                            tags.is("highway", "motorway");
    const int most = std::max(1, static_cast<int>(road.width / k_least_lane));
    auto number = [&](std::string_view key) { return static_cast<int>(parse_number(tags[key]).value_or(0)); };
    const int stated = std::clamp(number("lanes"), 0, most);
    if (is_one_way) {
        const int lanes = stated > 0 ? stated : road.width > k_two_one_way ? 2 : 1;
        road.forward = is_back ? 0 : lanes, road.backward = is_back ? lanes : 0;
        return;
    }
    const int each = stated > 1 ? stated / 2 : road.width > k_two_each ? 2 : 1;
    road.forward = number("lanes:forward") > 0 ? number("lanes:forward") : each;
    road.backward = number("lanes:backward") > 0 ? number("lanes:backward") : each;
    while (road.forward + road.backward > std::max(most, 2))
        --(road.forward > road.backward ? road.forward : road.backward);
    if (most < 2) road.forward = road.backward = 0;  // nobody gets past another there
}

bool is_inside(const Laying& l, Vec2 p) {
    return p.x > l.low.x && p.z > l.low.z && p.x < l.high.x && p.z < l.high.z;
}

uint32_t node_at(Laying& l, int64_t id, Vec2 at) {
    const auto [found, is_new] = l.nodes.try_emplace(id, static_cast<uint32_t>(l.plan.nodes.size()));
    if (is_new) l.plan.nodes.push_back({at, false});
    return found->second;
}

uint32_t gate_at(Laying& l, Vec2 at) {
    l.plan.nodes.push_back({at, true});
    return static_cast<uint32_t>(l.plan.nodes.size() - 1);
}

// Where the way from one inside to one outside leaves the map.
Vec2 leaves_map(const Laying& l, Vec2 inside, Vec2 outside) {
    for (int k = 0; k < 20; ++k) {
        const Vec2 middle = lerp(inside, outside, 0.5f);
        (is_inside(l, middle) ? inside : outside) = middle;
    }
    return inside;
}

Road like_road(const OsmWay& way, const OsmHighway& highway, const Class& sort) {
    Road like;
    like.width = highway.width;
    like.speed = speed_of(way.tags, sort);
    like.rank = sort.rank;
    count_lanes(way.tags, like);
    return like;
}

}  // namespace

void lay_along(Laying& l, const OsmWay& way, const Road& like) {
    std::optional<uint32_t> from;
    Road road = like;
    Vec2 last;
    bool was_known = false;
    auto end = [&](uint32_t node, Vec2 at) {
        road.line.push_back(at);
        road.from = *from, road.to = node;
        if (road.line.size() > 1 && road.from != road.to) l.plan.roads.push_back(road);
        road = like;
    };
    for (size_t i = 0; i < way.nodes.size(); ++i) {
        const OsmNode* node = l.in.map.node(way.nodes[i]);
        if (!node) {
            from.reset(), was_known = false;
            continue;
        }
        const Vec2 at = l.in.project(*node);
        const bool inside = is_inside(l, at);
        if (was_known && inside != is_inside(l, last)) {
            const Vec2 edge = inside ? leaves_map(l, at, last) : leaves_map(l, last, at);
            if (from) end(gate_at(l, edge), edge), from.reset();
            if (inside) from = gate_at(l, edge), road = like, road.line = {edge};
        }
        if (inside) {
            const bool is_node = l.uses[way.nodes[i]] > 1 || i == 0 || i + 1 == way.nodes.size() || !from;
            if (!is_node) {
                road.line.push_back(at);
            } else {
                const uint32_t number = node_at(l, way.nodes[i], at);
                if (from) end(number, at);
                from = number;
                road = like, road.line = {at};
            }
        }
        last = at, was_known = true;
    }
}

// Roads that the extract cuts off lead out of it.
void open_ends(Laying& l) {
    std::vector<uint32_t> ends(l.plan.nodes.size(), 0);
    for (const Road& road : l.plan.roads) ++ends[road.from], ++ends[road.to];
    for (size_t n = 0; n < ends.size(); ++n) {
        RoadNode& node = l.plan.nodes[n];
        const Vec2 off{std::min(node.at.x - l.low.x, l.high.x - node.at.x),
                       std::min(node.at.z - l.low.z, l.high.z - node.at.z)};
        if (ends[n] == 1 && std::min(off.x, off.z) < k_cut_off) node.is_gate = true;
    }
}

void add_osm_lanes(OsmImport& in) {
    const Vec2 inside{k_inside + 6, k_inside + 6};
    Laying l{in, in.plan.low + inside, in.plan.high - inside, {}, {}, {}};
    if (in.city.on_earth) l.plan.drives_left = is_driven_on_left(in.city.on_earth->middle);
    auto each = [&](auto visit) {
        for (const OsmWay& way : in.map.ways) {
            const Class* sort = class_of(way.tags);
            if (!sort || is_barred(way.tags)) continue;
            const std::optional<OsmHighway> highway = highway_of(way.tags);
            if (highway && highway->drives && highway->level == 0) visit(way, *highway, *sort);
        }
    };
    each([&](const OsmWay& way, const OsmHighway&, const Class&) {
        if (way.nodes.empty()) return;
        for (const int64_t id : way.nodes) ++l.uses[id];
        ++l.uses[way.nodes.front()], ++l.uses[way.nodes.back()];
    });
    each([&](const OsmWay& way, const OsmHighway& highway, const Class& sort) {
        const Road like = like_road(way, highway, sort);
        if (like.forward + like.backward > 0) lay_along(l, way, like);
    });
    open_ends(l);
    add_tram_tracks(l);
    std::vector<Vec2> stops;
    for (const Destination& place : in.city.destinations)
        if (place.kind == DestinationKind::stop) stops.push_back(on_ground(place.position));
    in.city.lanes = make_lanes(l.plan, in.city.crossings, stops, in.city.ground.obstacles);
    settle_lanes(in.city.lanes, in.city.ground);
}

}  // namespace flaneur
