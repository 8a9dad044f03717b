// What feet, hands and eyes ask of the ground.
#include <algorithm>
#include <cmath>

#include "sim/ground/grid.h"
#include "sim/ground/ground.h"

namespace flaneur {

// A point this far outside an edge still stands on the triangle, metres. Plans are rounded to a millimetre,
// so a corner may lie 0.71 mm beside the long edge that it divides, on either side of it: no gap is left
// there.
static constexpr float k_edge_slack = 7.5e-4f;

static constexpr size_t k_outside = ~size_t{0};

static size_t cell_under(const Grid& grid, Vec2 p) {
    Vec2 cell = (p - grid.origin) / grid.cell;
    if (!(cell.x >= 0 && cell.z >= 0 && cell.x < static_cast<float>(grid.width) &&
          cell.z < static_cast<float>(grid.height))) {
        return k_outside;
    }
    return static_cast<size_t>(cell.z) * grid.width + static_cast<size_t>(cell.x);
}

// Whether `p`, no farther than the slack beyond the lines along a triangle's edges, is that near to it:
// beyond the tip of a sliver it may be metres off.
static bool is_by(const GridTriangle& t, Vec2 p) {
    auto is_between = [](float v, float a, float b, float c) {
        return v >= std::min({a, b, c}) - k_edge_slack && v <= std::max({a, b, c}) + k_edge_slack;
    };
    return is_between(p.x, t.a.x, t.b.x, t.c.x) && is_between(p.z, t.a.z, t.b.z, t.c.z);
}

static std::optional<GroundHit> ground_in(const Ground& ground, size_t c, Vec3 point, float up, float down) {
    if (c == k_outside) return std::nullopt;
    const Grid& grid = ground.triangle_grid;
    Vec2 p = on_ground(point);
    float highest = point.y + up, best = point.y - down;
    if (const uint32_t k = ground.slab_of_cell[c]; k != k_no_slab) {
        const Slab& plane = ground.slabs[k];
        const float y = plane.height + dot(plane.rise, p - plane.at);
        if (y > highest || y < best) return std::nullopt;
        return GroundHit{y, plane.normal, plane.kind};
    }
    const GridTriangle* found = nullptr;
    for (uint32_t k = grid.first[c]; k < grid.first[c + 1]; ++k) {
        const GridTriangle& t = ground.grid_triangles[grid.items[k]];
        Vec3 a = t.a, b = t.b, d = t.c;
        Vec2 ap{p.x - a.x, p.z - a.z}, bp{p.x - b.x, p.z - b.z}, dp{p.x - d.x, p.z - d.z};
        Vec2 ab{b.x - a.x, b.z - a.z}, bd{d.x - b.x, d.z - b.z}, da{a.x - d.x, a.z - d.z};
        float wd = cross(ap, ab), wa = cross(bp, bd), wb = cross(dp, da);
        if (wd < -k_edge_slack * (std::fabs(ab.x) + std::fabs(ab.z)) ||
            wa < -k_edge_slack * (std::fabs(bd.x) + std::fabs(bd.z)) ||
            wb < -k_edge_slack * (std::fabs(da.x) + std::fabs(da.z))) {
            continue;
        }
        if (std::min({wa, wb, wd}) < 0 && !is_by(t, p)) continue;
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
    return GroundHit{best, normal, found->kind};
}

std::optional<GroundHit> ground_at(const Ground& ground, Vec3 point, float up, float down) {
    return ground_in(ground, cell_under(ground.triangle_grid, on_ground(point)), point, up, down);
}

void ground_at(const Ground& ground, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits) {
    // A query waits for memory three times, one after the other: a batch waits for all its members at once.
    constexpr size_t k_batch = 16;
    const Grid& grid = ground.triangle_grid;
    for (size_t begin = 0; begin < points.size(); begin += k_batch) {
        size_t cells[k_batch], count = std::min(k_batch, points.size() - begin);
        for (size_t i = 0; i < count; ++i) {
            cells[i] = cell_under(grid, on_ground(points[begin + i]));
            if (cells[i] == k_outside) continue;
            __builtin_prefetch(&ground.slab_of_cell[cells[i]]);
            __builtin_prefetch(&grid.first[cells[i]]);
        }
        auto for_items = [&](auto visit) {
            for (size_t i = 0; i < count; ++i) {
                if (cells[i] == k_outside || ground.slab_of_cell[cells[i]] != k_no_slab) continue;
                uint32_t first = grid.first[cells[i]], end = grid.first[cells[i] + 1];
                if (first < end) visit(first, end);
            }
        };
        for_items([&](uint32_t first, uint32_t) { __builtin_prefetch(&grid.items[first]); });
        for_items([&](uint32_t first, uint32_t end) {
            for (uint32_t k = first; k < std::min(first + 4, end); ++k)
                __builtin_prefetch(&ground.grid_triangles[grid.items[k]]);
        });
        for (size_t i = 0; i < count; ++i)
            hits[begin + i] = ground_in(ground, cells[i], points[begin + i], up, down);
    }
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

static Vec3 wall_normal(Vec2 along) { return normalize_or(Vec3{-along.z, 0, along.x}, {0, 0, 1}); }

static Vec3 solid_normal(const Solid& s) { return normalize_or(cross(s.b - s.a, s.c - s.a), {0, 1, 0}); }

std::optional<RayHit> raycast(const Ground& ground, Vec3 origin, Vec3 direction, float reach) {
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
    const Grid& triangles = ground.triangle_grid;
    for_cells_of_ray(triangles, on_ground(origin), on_ground(direction), reach, [&](size_t cell, float exit) {
        for (uint32_t k = triangles.first[cell]; k < triangles.first[cell + 1]; ++k) {
            const GridTriangle& triangle = ground.grid_triangles[triangles.items[k]];
            take(hit_triangle(origin, direction, triangle.a, triangle.b, triangle.c), RayHit::What::ground,
                 triangles.items[k]);
        }
        return best.distance > exit;
    });
    const Grid& walls = ground.wall_grid;
    for_cells_of_ray(walls, on_ground(origin), on_ground(direction), best.distance,
                     [&](size_t cell, float exit) {
                         for (uint32_t k = walls.first[cell]; k < walls.first[cell + 1]; ++k) {
                             take(hit_face(origin, direction, ground.faces[walls.items[k]]),
                                  RayHit::What::face, walls.items[k]);
                         }
                         return best.distance > exit;
                     });
    const Grid& solids = ground.solid_grid;
    for_cells_of_ray(solids, on_ground(origin), on_ground(direction), best.distance,
                     [&](size_t cell, float exit) {
                         for (uint32_t k = solids.first[cell]; k < solids.first[cell + 1]; ++k) {
                             uint32_t i = solids.items[k];
                             const Solid& s = ground.solids[i];
                             take(hit_triangle(origin, direction, s.a, s.b, s.c), RayHit::What::solid, i);
                         }
                         return best.distance > exit;
                     });
    if (!any) return std::nullopt;
    switch (best.what) {
        case RayHit::What::face: {
            const Face& f = ground.faces[best.index];
            best.normal = wall_normal(on_ground(f.b) - on_ground(f.a));
            break;
        }
        case RayHit::What::ground: {
            const GridTriangle& t = ground.grid_triangles[best.index];
            best.normal = normalize_or(cross(t.b - t.a, t.c - t.a), {0, 1, 0});
            break;
        }
        case RayHit::What::solid:
            best.normal = solid_normal(ground.solids[best.index]);
            break;
    }
    return best;
}

// The point of a triangle closest to `p`: by which corner, edge or inside it lies over (Ericson 2005, 5.1.5).
static Vec3 closest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    float ab_a = dot(ab, ap), ac_a = dot(ac, ap), ab_b = dot(ab, bp), ac_b = dot(ac, bp), ab_c = dot(ab, cp),
          ac_c = dot(ac, cp);
    if (ab_a <= 0 && ac_a <= 0) return a;
    if (ab_b >= 0 && ac_b <= ab_b) return b;
    if (ac_c >= 0 && ab_c <= ac_c) return c;
    float over_c = ab_a * ac_b - ab_b * ac_a;
    if (over_c <= 0 && ab_a >= 0 && ab_b <= 0) return a + ab * (ab_a / (ab_a - ab_b));
    float over_b = ab_c * ac_a - ab_a * ac_c;
    if (over_b <= 0 && ac_a >= 0 && ac_c <= 0) return a + ac * (ac_a / (ac_a - ac_c));
    float over_a = ab_b * ac_c - ab_c * ac_b, to_c = ac_b - ab_b, to_b = ab_c - ac_c;
    if (over_a <= 0 && to_c >= 0 && to_b >= 0) return b + (c - b) * (to_c / (to_c + to_b));
    float whole = over_a + over_b + over_c;
    return whole > 0 ? a + ab * (over_b / whole) + ac * (over_c / whole) : a;
}

std::optional<WallPoint> closest_wall(const Ground& ground, Vec3 point, float radius) {
    if (!(radius >= 0)) return std::nullopt;
    Vec2 p = on_ground(point), reach{radius, radius};
    float best = radius * radius;
    Vec3 at;
    const GridWall* wall = nullptr;
    if (const Grid& grid = ground.wall_grid; !grid.items.empty()) {
        CellRange r = cells_of_box(grid, p - reach, p + reach);
        for (int z = r.z0; z <= r.z1; ++z) {
            size_t row = static_cast<size_t>(z) * grid.width;  // whose cells lie side by side
            for (uint32_t k = grid.first[row + r.x0]; k < grid.first[row + r.x1 + 1]; ++k) {
                const GridWall& w = ground.grid_walls[k];
                float s = clamp(dot(p - w.a, w.along) * w.per_length_squared, 0, 1);
                float foot = w.foot + w.foot_rise * s, top = w.top + w.top_rise * s;
                Vec3 q = at_height(w.a + w.along * s, clamp(point.y, foot, std::max(foot, top)));
                float d = length_squared(q - point);
                if (d > best || (wall && d == best)) continue;
                best = d;
                at = q;
                wall = &w;
            }
        }
    }
    uint32_t solid = ~0u;
    if (const Grid& grid = ground.solid_grid; !grid.items.empty()) {
        CellRange r = cells_of_box(grid, p - reach, p + reach);
        for (int z = r.z0; z <= r.z1; ++z) {
            size_t row = static_cast<size_t>(z) * grid.width;
            for (uint32_t k = grid.first[row + r.x0]; k < grid.first[row + r.x1 + 1]; ++k) {
                uint32_t i = grid.items[k];
                const Solid& s = ground.solids[i];
                Vec3 q = closest_on_triangle(point, s.a, s.b, s.c);
                float d = length_squared(q - point);
                if (d > best || ((wall || solid != ~0u) && d == best)) continue;
                best = d;
                at = q;
                solid = i;
            }
        }
    }
    if (solid != ~0u) {
        Vec3 out = solid_normal(ground.solids[solid]);
        out.y = 0;
        return WallPoint{at, normalize_or(out, normalize_or(at_height(p - on_ground(at), 0), {0, 0, 1})),
                         std::sqrt(best)};
    }
    if (!wall) return std::nullopt;
    uint32_t face = ground.wall_grid.items[static_cast<size_t>(wall - ground.grid_walls.data())];
    return WallPoint{at, wall_normal(wall->along), std::sqrt(best), face};
}

}  // namespace flaneur
