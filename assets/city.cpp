#include "assets/city.h"

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"

namespace flaneur {

Vec2 half_footprint(const Prop& prop) {
    switch (prop.kind) {
        case PropKind::tree:
            return {0.2f, 0.2f};
        case PropKind::statue:
            return {0.75f, 0.75f};
        case PropKind::bench:
            return {0.8f, 0.3f};
        case PropKind::bin:
            return {0.25f, 0.25f};
        case PropKind::car:
            return {0.9f, 2.15f};
        case PropKind::fountain:
            return {prop.radius, prop.radius};
        case PropKind::planter:
            return {0.6f, 0.6f};
        case PropKind::shelter:
            return {1.8f, 0.7f};
        case PropKind::barrier:
            return {prop.radius, 0.25f};
        default:
            return {0.12f, 0.12f};
    }
}

Vec2 door_on(Vec2 a, Vec2 b, Vec2 place) {
    const float width = std::max(length(b - a), 1e-3f), along = dot(place - a, b - a) / (width * width);
    const float bays = std::max(1.0f, std::round(width / k_bay_width));
    const float bay = std::min(std::max(0.0f, std::floor(along * bays)), bays - 1);
    return lerp(a, b, (bay + 0.5f) / bays);
}

void index_city(City& city) {
    Ground& ground = city.ground;
    ground.solids.clear();
    for (uint32_t i = 0; i < city.scenery.uses.size(); ++i) {
        if (city.scenery.uses[i] != SceneryUse::solid) continue;
        ground.solids.push_back({scenery_corner(city.scenery, i, 0), scenery_corner(city.scenery, i, 1),
                                 scenery_corner(city.scenery, i, 2)});
    }
    index_ground(ground);
}

void settle_crossings(City& city) {
    for (Crossing& c : city.crossings.all)
        if (const auto hit = ground_at(city.ground, c.centre, 60, 60)) c.centre.y = hit->height;
}

void list_obstacles(City& city) {
    city.ground.obstacles.clear();
    for (const Prop& p : city.props) city.ground.obstacles.push_back({p.position, p.yaw, half_footprint(p)});
}

uint64_t hash_city(const City& city) {
    uint64_t h = hash_ground(city.ground);
    auto add = [&h](const void* data, size_t size) { h = hash_bytes(h, data, size); };
    auto add_array = [&](const auto& values) { add(values.data(), values.size() * sizeof(values[0])); };
    add_array(city.ground_axes);
    // Field by field where a struct has padding.
    for (const Building& b : city.buildings) {
        float sizes[] = {b.base, b.top, b.storey};
        add(sizes, sizeof sizes);
        h = mix(h ^ (uint64_t{b.seed} << 16 | uint64_t{b.style} << 8 |
                     uint64_t{static_cast<uint8_t>(b.finish)} << 1 | b.has_shop));
        h = mix(h ^ (uint64_t{b.wall_colour} << 32 | b.roof_colour));
    }
    add_array(city.roof_vertices);
    add_array(city.roof_indices);
    add_array(city.roof_buildings);
    if (!city.grooves.empty()) add_array(city.grooves);
    for (const Prop& p : city.props) {
        add(&p.position, sizeof p.position);
        float sizes[] = {p.yaw, p.height, p.radius};
        add(sizes, sizeof sizes);
        h = mix(h ^ (uint64_t{p.seed} << 8 | static_cast<uint64_t>(p.kind)));
    }
    for (const Destination& p : city.destinations) {
        add(&p.position, sizeof p.position);
        float rest[] = {p.facing.x, p.facing.z, p.weight};
        add(rest, sizeof rest);
        h = mix(h ^ static_cast<uint64_t>(p.kind));
    }
    for (const Scenery::Vertex& v : city.scenery.vertices) add(&v.position, sizeof v.position);
    add_array(city.scenery.indices);
    add_array(city.scenery.uses);
    return h;
}

}  // namespace flaneur
