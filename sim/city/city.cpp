#include "sim/city/city.h"

#include <cassert>

#include "sim/base/hash.h"
#include "sim/city/grid.h"

namespace flaneur {

static constexpr float k_triangle_cell = 2, k_wall_cell = 4;
// A point this far outside an edge still stands on the triangle, so that rounding leaves no gap between two.
// Metres.
static constexpr float k_edge_slack = 2e-4f;
static constexpr float k_least_area = 1e-6f;  // smaller triangles are never hit, square metres

static bool is_wall(const Face& f) { return f.kind == FaceKind::facade || f.kind == FaceKind::garden_wall; }

// Positive on the inner side of a counter-clockwise edge a-b, seen from above.
static float inside(Vec2 a, Vec2 b, Vec2 p) { return cross(p - a, b - a); }

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
    for (uint32_t i : city.triangle_grid.items) {
        const uint32_t* index = &city.ground_indices[i * 3];
        city.grid_triangles.push_back({city.ground_vertices[index[0]], city.ground_vertices[index[1]],
                                       city.ground_vertices[index[2]], i});
    }
    city.wall_grid = make_grid(low - margin, high + margin, k_wall_cell);
    fill_grid(city.wall_grid, static_cast<uint32_t>(city.faces.size()), [&](uint32_t i, auto visit) {
        const Face& f = city.faces[i];
        if (is_wall(f)) for_cells_of_segment(city.wall_grid, on_ground(f.a), on_ground(f.b), visit);
    });
}

std::optional<GroundHit> ground(const City& city, Vec3 point, float up, float down) {
    const Grid& grid = city.triangle_grid;
    Vec2 p = on_ground(point), cell = (p - grid.origin) / grid.cell;
    if (!(cell.x >= 0 && cell.z >= 0 && cell.x < static_cast<float>(grid.width) &&
          cell.z < static_cast<float>(grid.height))) {
        return std::nullopt;
    }
    size_t c = static_cast<size_t>(cell.z) * grid.width + static_cast<size_t>(cell.x);
    float highest = point.y + up, best = point.y - down;
    const GridTriangle* found = nullptr;
    for (uint32_t k = grid.first[c]; k < grid.first[c + 1]; ++k) {
        const GridTriangle& t = city.grid_triangles[k];
        Vec3 a = t.a, b = t.b, d = t.c;
        Vec2 ap{p.x - a.x, p.z - a.z}, bp{p.x - b.x, p.z - b.z}, dp{p.x - d.x, p.z - d.z};
        Vec2 ab{b.x - a.x, b.z - a.z}, bd{d.x - b.x, d.z - b.z}, da{a.x - d.x, a.z - d.z};
        float wd = cross(ap, ab), wa = cross(bp, bd), wb = cross(dp, da);
        if (wd < -k_edge_slack * (std::fabs(ab.x) + std::fabs(ab.z)) ||
            wa < -k_edge_slack * (std::fabs(bd.x) + std::fabs(bd.z)) ||
            wb < -k_edge_slack * (std::fabs(da.x) + std::fabs(da.z))) {
            continue;
        }
        wa = std::max(wa, 0.0f), wb = std::max(wb, 0.0f), wd = std::max(wd, 0.0f);
        float sum = wa + wb + wd;
        if (sum <= 0) continue;
        float y = (wa * a.y + wb * b.y + wd * d.y) / sum;
        if (y <= highest && y >= best && (y > best || !found)) {
            best = y;
            found = &t;
        }
    }
    if (!found) return std::nullopt;
    Vec3 normal = normalize_or(cross(found->b - found->a, found->c - found->a), {0, 1, 0});
    return GroundHit{best, normal, city.ground_kinds[found->index]};
}

// The ray's parameter where it meets a triangle's plane inside the triangle (Moller and Trumbore 1997), or
// -1.
static float hit_triangle(Vec3 origin, Vec3 direction, Vec3 a, Vec3 b, Vec3 c) {
    constexpr float k_slack = 1e-5f;  // of the triangle's size, so that a ray through a shared edge hits
    Vec3 ab = b - a, ac = c - a, h = cross(direction, ac);
    float det = dot(ab, h);
    if (std::fabs(det) < 1e-12f) return -1;
    Vec3 s = origin - a, q = cross(s, ab);
    float u = dot(s, h) / det, v = dot(direction, q) / det;
    if (!(u >= -k_slack && v >= -k_slack && u + v <= 1 + k_slack)) return -1;
    return dot(ac, q) / det;
}

// The same for a vertical quad whose ends are vertical and whose bottom and top are straight.
static float hit_face(Vec3 origin, Vec3 direction, const Face& f) {
    Vec2 ab = on_ground(f.b) - on_ground(f.a), o = on_ground(f.a) - on_ground(origin),
         d = on_ground(direction);
    float det = cross(d, ab);
    if (std::fabs(det) < 1e-12f) return -1;
    float t = cross(o, ab) / det, s = cross(o, d) / det;
    if (!(s >= -1e-5f && s <= 1 + 1e-5f)) return -1;
    float y = origin.y + direction.y * t;
    return y >= lerp(f.a.y, f.b.y, s) && y <= lerp(f.a_top, f.b_top, s) ? t : -1;
}

static Vec3 face_normal(const Face& f) {
    Vec3 ab = f.b - f.a;
    return normalize_or(Vec3{-ab.z, 0, ab.x}, {0, 0, 1});
}

std::optional<RayHit> raycast(const City& city, Vec3 origin, Vec3 direction, float reach) {
    RayHit best;
    best.distance = reach;
    bool any = false;
    auto take = [&](float t, RayHit::What what, uint32_t index) {
        if (!(t >= 0 && t <= best.distance) || (any && t == best.distance)) return;
        best.distance = t;
        best.what = what;
        best.index = index;
        any = true;
    };
    const Grid& triangles = city.triangle_grid;
    for_cells_of_ray(triangles, on_ground(origin), on_ground(direction), reach, [&](size_t cell, float exit) {
        for (uint32_t k = triangles.first[cell]; k < triangles.first[cell + 1]; ++k) {
            const GridTriangle& triangle = city.grid_triangles[k];
            take(hit_triangle(origin, direction, triangle.a, triangle.b, triangle.c), RayHit::What::ground,
                 triangle.index);
        }
        return best.distance > exit;
    });
    const Grid& walls = city.wall_grid;
    for_cells_of_ray(walls, on_ground(origin), on_ground(direction), best.distance,
                     [&](size_t cell, float exit) {
                         for (uint32_t k = walls.first[cell]; k < walls.first[cell + 1]; ++k) {
                             take(hit_face(origin, direction, city.faces[walls.items[k]]), RayHit::What::face,
                                  walls.items[k]);
                         }
                         return best.distance > exit;
                     });
    if (!any) return std::nullopt;
    if (best.what == RayHit::What::face) {
        best.normal = face_normal(city.faces[best.index]);
    } else {
        const uint32_t* index = &city.ground_indices[best.index * 3];
        Vec3 a = city.ground_vertices[index[0]];
        best.normal = normalize_or(
            cross(city.ground_vertices[index[1]] - a, city.ground_vertices[index[2]] - a), {0, 1, 0});
    }
    return best;
}

std::optional<WallPoint> closest_wall(const City& city, Vec3 point, float radius) {
    const Grid& grid = city.wall_grid;
    Vec2 p = on_ground(point), reach{radius, radius};
    if (grid.items.empty() || !(radius >= 0)) return std::nullopt;
    CellRange r = cells_of_box(grid, p - reach, p + reach);
    float best = radius * radius;
    WallPoint found;
    bool any = false;
    for (int z = r.z0; z <= r.z1; ++z) {
        for (int x = r.x0; x <= r.x1; ++x) {
            size_t c = static_cast<size_t>(z) * grid.width + x;
            for (uint32_t k = grid.first[c]; k < grid.first[c + 1]; ++k) {
                const Face& f = city.faces[grid.items[k]];
                Vec2 a = on_ground(f.a), ab = on_ground(f.b) - a;
                float s = clamp(dot(p - a, ab) / std::max(length_squared(ab), 1e-12f), 0, 1);
                float bottom = lerp(f.a.y, f.b.y, s), top = lerp(f.a_top, f.b_top, s);
                Vec3 q = at_height(a + ab * s, clamp(point.y, bottom, std::max(bottom, top)));
                float d = length_squared(q - point);
                // A wall lies in several cells: the lowest index wins a tie whatever the order of visits.
                if (d > best || (any && d == best && grid.items[k] >= found.face)) continue;
                best = d;
                found.point = q;
                found.face = grid.items[k];
                any = true;
            }
        }
    }
    if (!any) return std::nullopt;
    found.distance = std::sqrt(best);
    found.normal = face_normal(city.faces[found.face]);
    return found;
}

Vec2 half_footprint(const Prop& prop) {
    switch (prop.kind) {
        case PropKind::tree:
        case PropKind::statue:
            return {0.2f, 0.2f};
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
    add_array(city.scenery.solid);
    return h;
}

}  // namespace flaneur
