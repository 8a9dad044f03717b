// Trees and street furniture of the map.
#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

bool on_map(const OsmImport& in, Vec2 p) {
    return p.x > in.plan.low.x && p.z > in.plan.low.z && p.x < in.plan.high.x && p.z < in.plan.high.z;
}

std::optional<GroundHit> ground_at(const OsmImport& in, Vec2 p) {
    return ground_at(in.city.ground, at_height(p, terrain_at(in.plan, p)), 1, 3);
}

bool takes_props(const std::optional<GroundHit>& hit) {
    return hit && !is_carriageway(hit->kind) && is_walked(hit->kind) && hit->kind != Surface::steps;
}

// From a node on a carriageway to the pavement nearest to it.
std::optional<Vec2> beside(const OsmImport& in, Vec2 p) {
    for (float radius = 1; radius <= 9; radius += 0.5f) {
        for (int turn = 0; turn < 16; ++turn) {
            Vec2 q = p + heading_direction(k_pi * (static_cast<float>(turn) + 0.5f) / 8) * radius;
            std::optional<GroundHit> hit = ground_at(in, q);
            if (takes_props(hit) && hit->kind != Surface::grass) {
                return q + normalize_or(q - p, {1, 0}) * 0.35f;  // behind the kerb
            }
        }
    }
    return std::nullopt;
}

float yaw_to_street(const OsmImport& in, Vec2 p, float otherwise) {
    const LinePiece* street = in.streets.nearest(p, 25);
    if (!street) return otherwise;
    Vec2 towards = lerp(street->a, street->b, closest_on(*street, p)) - p;
    return length(towards) > 0.1f ? heading_of(towards) : otherwise;
}

// The compass bearing of `direction`: 0 is north, which is -z; east is +x.
std::optional<float> bearing_of(const OsmTags& tags) {
    constexpr std::string_view k_winds[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
    std::string_view text = tags["direction"];
    std::optional<float> degrees = parse_number(text);
    for (size_t i = 0; i < std::size(k_winds); ++i) {
        if (text == k_winds[i]) degrees = static_cast<float>(i) * 45;
    }
    if (!degrees || !(std::fabs(*degrees) <= 720)) return std::nullopt;
    return wrap_angle((180 - *degrees) * k_radians);
}

void place(OsmImport& in, PropKind kind, Vec2 p, uint64_t id, float height, float radius,
           std::optional<float> yaw) {
    if (!on_map(in, p)) return;
    std::optional<GroundHit> hit = ground_at(in, p);
    Prop prop;
    prop.kind = kind;
    prop.radius = radius;
    Vec2 half = half_footprint(prop);
    bool fits = takes_props(hit);
    if (fits && std::max(half.x, half.z) > 0.5f) {
        std::optional<WallPoint> wall =
            closest_wall(in.city.ground, at_height(p, hit->height + 0.5f), std::min(half.x, half.z) + 0.1f);
        fits = !wall;
    }
    if (!fits) {
        ++in.counts.props_off_ground;
        return;
    }
    RandomKey key{id, 0, 0, Purpose::tree};
    prop.position = at_height(p, hit->height);
    prop.yaw = yaw.value_or(random_between(key, -k_pi, k_pi));
    prop.height = height;
    prop.seed = static_cast<uint32_t>(random_bits(key, 9));
    in.city.props.push_back(prop);
}

void place_tree(OsmImport& in, Vec2 p, uint64_t id, const OsmTags& tags) {
    RandomKey key{id, 0, 0, Purpose::tree};
    float height = parse_metres(tags["height"]).value_or(random_between(key, 6, 10, 1));
    height = clamp(height, 2.5f, 28);
    float crown = parse_metres(tags["diameter_crown"]).value_or(height * random_between(key, 0.5f, 0.65f, 2));
    place(in, PropKind::tree, p, id, height, clamp(crown * 0.5f, 0.8f, 7), std::nullopt);
}

void place_node(OsmImport& in, const OsmNode& node) {
    const OsmTags& tags = node.tags;
    Vec2 p = in.project(node);
    auto id = static_cast<uint64_t>(node.id);
    std::string_view highway = tags["highway"], amenity = tags["amenity"], barrier = tags["barrier"];
    float to_street = yaw_to_street(in, p, 0), faced = bearing_of(tags).value_or(to_street);
    auto put = [&](PropKind kind, float height, float radius, std::optional<float> yaw) {
        place(in, kind, p, id, parse_metres(tags["height"]).value_or(height), radius, yaw);
    };
    if (tags.is("natural", "tree")) place_tree(in, p, id, tags);
    if (highway == "street_lamp") put(PropKind::lamp, 5.5f, 0, to_street);
    if (amenity == "bench") put(PropKind::bench, 0.8f, 0, faced);
    if (amenity == "waste_basket") put(PropKind::bin, 1, 0, faced);
    if (amenity == "fountain") put(PropKind::fountain, 1.6f, 1.4f, 0);
    if (barrier == "bollard") put(PropKind::bollard, 0.9f, 0, to_street);
    if (barrier == "planter" || tags.is("man_made", "planter")) put(PropKind::planter, 0.7f, 0, to_street);
    std::string_view art = tags["artwork_type"], historic = tags["historic"], memorial = tags["memorial"];
    bool stands = art == "statue" || art == "sculpture" || art == "bust" || historic == "monument" ||
                  (historic == "memorial" &&
                   (memorial.empty() || memorial == "statue" || memorial == "bust" || memorial == "stele"));
    if (stands) put(PropKind::statue, 3, 0, faced);
    bool sheltered = (highway == "bus_stop" && tags.is("shelter", "yes")) ||
                     (amenity == "shelter" && tags.is("shelter_type", "public_transport"));
    if (sheltered) {
        std::optional<Vec2> q = takes_props(ground_at(in, p)) ? p : beside(in, p);
        if (q) place(in, PropKind::shelter, *q, id, 2.6f, 0, yaw_to_street(in, *q, 0));
    }
    if (highway == "traffic_signals" || tags.is("crossing", "traffic_signals")) {
        if (std::optional<Vec2> q = beside(in, p))
            place(in, PropKind::signal, *q, id, 3.2f, 0, yaw_to_street(in, *q, 0));
    }
}

}  // namespace

void add_osm_props(OsmImport& in) {
    for (const OsmNode& node : in.map.nodes) {
        if (!node.tags.items.empty() && !is_hidden(node.tags)) place_node(in, node);
    }
    for (const OsmWay& way : in.map.ways) {
        if (!way.tags.is("natural", "tree_row")) continue;
        uint64_t id = static_cast<uint64_t>(way.id) << 16;
        for (const std::vector<Vec2>& line : lines_of(in, way)) {
            for (size_t i = 0; i + 1 < line.size(); ++i) {
                int trees = std::min(500, std::max(1, static_cast<int>(length(line[i + 1] - line[i]) / 8)));
                for (int t = 0; t < trees; ++t) {
                    place_tree(in,
                               lerp(line[i], line[i + 1], static_cast<float>(t) / static_cast<float>(trees)),
                               id++, way.tags);
                }
            }
        }
    }
}

}  // namespace flaneur
