#include "sim/city/city.h"

#include <cassert>

#include "sim/base/hash.h"
#include "sim/city/grid.h"

namespace flaneur {

static constexpr float k_triangle_cell = 2, k_wall_cell = 4, k_scenery_cell = 2;
static constexpr float k_least_area = 1e-6f;  // smaller triangles are never hit, square metres

static bool is_wall(const Face& f) { return f.kind == FaceKind::facade || f.kind == FaceKind::garden_wall; }

// Positive on the inner side of a counter-clockwise edge a-b, seen from above.
static float inside(Vec2 a, Vec2 b, Vec2 p) { return cross(p - a, b - a); }

// The solid triangles of the scenery, upright ones included.
static void index_scenery(City& city) {
    const Scenery& s = city.scenery;
    assert(s.indices.size() == s.uses.size() * 3);
    Vec2 margin{2 * k_grid_margin, 2 * k_grid_margin};
    city.scenery_grid = make_grid(city.low - margin, city.high + margin, k_scenery_cell);
    fill_grid(city.scenery_grid, static_cast<uint32_t>(s.uses.size()), [&](uint32_t i, auto visit) {
        if (s.uses[i] != SceneryUse::solid) return;
        Vec2 a = on_ground(scenery_corner(s, i, 0)), b = on_ground(scenery_corner(s, i, 1)),
             c = on_ground(scenery_corner(s, i, 2));
        if (inside(a, b, c) < 0) std::swap(b, c);
        for_cells_of_triangle(city.scenery_grid, a, b, c, visit);
    });
}

void index_city(City& city) {
    assert(city.ground_indices.size() == city.ground_kinds.size() * 3);
    constexpr float k_far = 1e30f;
    Vec2 low{k_far, k_far}, high{-k_far, -k_far};
    auto include = [&](Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    };
    for (Vec3 v : city.ground_vertices) include(v);
    for (const Face& f : city.faces) include(f.a), include(f.b);
    for (uint32_t i = 0; i < city.scenery.uses.size(); ++i) {
        if (city.scenery.uses[i] != SceneryUse::solid) continue;
        for (uint32_t k = 0; k < 3; ++k) include(scenery_corner(city.scenery, i, k));
    }
    if (low.x > high.x) low = high = {0, 0};
    city.low = low;
    city.high = high;

    Vec2 margin{2 * k_grid_margin, 2 * k_grid_margin};
    city.triangle_grid = make_grid(low - margin, high + margin, k_triangle_cell);
    fill_grid(city.triangle_grid, static_cast<uint32_t>(city.ground_kinds.size()),
              [&](uint32_t i, auto visit) {
                  Vec2 a = on_ground(city.ground_vertices[city.ground_indices[i * 3]]);
                  Vec2 b = on_ground(city.ground_vertices[city.ground_indices[i * 3 + 1]]);
                  Vec2 c = on_ground(city.ground_vertices[city.ground_indices[i * 3 + 2]]);
                  if (inside(a, b, c) < k_least_area) return;
                  for_cells_of_triangle(city.triangle_grid, a, b, c, visit);
              });
    city.grid_triangles.clear();
    for (size_t i = 0; i < city.ground_kinds.size(); ++i) {
        const uint32_t* index = &city.ground_indices[i * 3];
        city.grid_triangles.push_back({city.ground_vertices[index[0]], city.ground_vertices[index[1]],
                                       city.ground_vertices[index[2]], city.ground_kinds[i]});
    }
    city.wall_grid = make_grid(low - margin, high + margin, k_wall_cell);
    fill_grid(city.wall_grid, static_cast<uint32_t>(city.faces.size()), [&](uint32_t i, auto visit) {
        const Face& f = city.faces[i];
        if (is_wall(f)) for_cells_of_segment(city.wall_grid, on_ground(f.a), on_ground(f.b), visit);
    });
    city.grid_walls.clear();
    for (uint32_t i : city.wall_grid.items) {
        const Face& f = city.faces[i];
        Vec2 along = on_ground(f.b) - on_ground(f.a);
        city.grid_walls.push_back({on_ground(f.a), along, 1 / std::max(length_squared(along), 1e-12f), f.a.y,
                                   f.b.y - f.a.y, f.a_top, f.b_top - f.a_top});
    }
    index_scenery(city);
}

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
        default:
            return {0.12f, 0.12f};
    }
}

uint64_t hash_city(const City& city) {
    uint64_t h = hash_bytes(0, city.name.data(), city.name.size());
    auto add = [&h](const void* data, size_t size) { h = hash_bytes(h, data, size); };
    auto add_array = [&](const auto& values) { add(values.data(), values.size() * sizeof(values[0])); };
    add(&city.low, sizeof city.low);
    add(&city.high, sizeof city.high);
    add_array(city.ground_vertices);
    add_array(city.ground_indices);
    add_array(city.ground_kinds);
    add_array(city.ground_axes);
    // Field by field where a struct has padding.
    for (const Face& f : city.faces) {
        add(&f.a, sizeof f.a);
        add(&f.b, sizeof f.b);
        float tops[] = {f.a_top, f.b_top};
        add(tops, sizeof tops);
        h = mix(h ^ (uint64_t{f.building} << 8 | static_cast<uint64_t>(f.kind)));
    }
    for (const Building& b : city.buildings) {
        float sizes[] = {b.base, b.top, b.storey};
        add(sizes, sizeof sizes);
        h = mix(h ^ (uint64_t{b.seed} << 16 | uint64_t{b.style} << 8 | b.has_shop));
        h = mix(h ^ (uint64_t{b.wall_colour} << 32 | b.roof_colour));
    }
    add_array(city.roof_vertices);
    add_array(city.roof_indices);
    add_array(city.roof_buildings);
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
