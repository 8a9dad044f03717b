#include "sim/ground/ground.h"

#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "sim/base/hash.h"
#include "sim/base/planar.h"
#include "sim/ground/grid.h"

namespace flaneur {

static constexpr float k_triangle_cell = 2, k_wall_cell = 4, k_solid_cell = 2;
static constexpr float k_least_area = 1e-6f;  // smaller triangles are never hit, square metres

static bool is_wall(const Face& f) { return f.kind == FaceKind::facade || f.kind == FaceKind::garden_wall; }

// Positive on the inner side of a counter-clockwise edge a-b, seen from above.
static float inside(Vec2 a, Vec2 b, Vec2 p) { return cross(p - a, b - a); }

static void index_solids(Ground& ground) {
    Vec2 margin{2 * k_grid_margin, 2 * k_grid_margin};
    ground.solid_grid = make_grid(ground.low - margin, ground.high + margin, k_solid_cell);
    fill_grid(ground.solid_grid, static_cast<uint32_t>(ground.solids.size()), [&](uint32_t i, auto visit) {
        Vec2 a = on_ground(ground.solids[i].a), b = on_ground(ground.solids[i].b),
             c = on_ground(ground.solids[i].c);
        if (inside(a, b, c) < 0) std::swap(b, c);
        for_cells_of_triangle(ground.solid_grid, a, b, c, visit);
    });
}

// A triangle, and what is left of it when it is cut.
struct SquarePart {
    static constexpr size_t k_most = 3 + 4 + 3;
    Vec2 corners[k_most];
    size_t count = 0;
};

template <class Side>
static SquarePart part_of(const SquarePart& piece, const Side& side) {
    SquarePart part;
    cut({piece.corners, piece.count}, side, [&](Vec2 p) { part.corners[part.count++] = p; });
    return part;
}

// What of a triangle lies in a square from `low` on, against that.
static SquarePart part_in_square(const GridTriangle& t, Vec2 low, float size) {
    SquarePart part{{on_ground(t.a) - low, on_ground(t.b) - low, on_ground(t.c) - low}, 3};
    part = part_of(part, [](Vec2 p) { return p.x; });
    part = part_of(part, [&](Vec2 p) { return size - p.x; });
    part = part_of(part, [](Vec2 p) { return p.z; });
    return part_of(part, [&](Vec2 p) { return size - p.z; });
}

static float square_metres(const SquarePart& piece) {
    const Vec2* p = piece.corners;
    float twice = 0;
    for (size_t i = 1; i + 1 < piece.count; ++i) twice += cross(p[i] - p[0], p[i + 1] - p[0]);
    return std::fabs(twice) / 2;
}

// Square metres that a piece has in common with a triangle.
static float overlap(SquarePart piece, const GridTriangle& t, Vec2 low) {
    const Vec2 corners[] = {on_ground(t.a) - low, on_ground(t.b) - low, on_ground(t.c) - low};
    for (size_t k = 0; k < 3 && piece.count > 0; ++k)
        piece = part_of(piece, [&](Vec2 p) { return inside(corners[k], corners[(k + 1) % 3], p); });
    return square_metres(piece);
}

static Slab slab_of(const GridTriangle& t) {
    const Vec3 normal = normalize_or(cross(t.b - t.a, t.c - t.a), {0, 1, 0});
    Slab slab{{}, {-normal.x / normal.y, -normal.z / normal.y}, t.a.y, normal, t.kind};
    // All that is level and equally high is one.
    if (slab.rise != Vec2{}) slab.at = on_ground(t.a);
    return slab;
}

// Whether the ground in cell (x, z) is one plane of one kind, without gaps or ground above ground.
static std::optional<Slab> slab_in(const Ground& ground, int x, int z) {
    constexpr float k_flat = 1e-4f, k_steepest = 0.2f, k_area = 1e-3f;  // metres, y of normals, square metres
    const Grid& grid = ground.triangle_grid;
    const size_t c = static_cast<size_t>(z) * grid.width + x;
    if (grid.first[c] == grid.first[c + 1]) return {};
    const Slab slab = slab_of(ground.grid_triangles[grid.items[grid.first[c]]]);
    if (slab.normal.y < k_steepest) return {};
    auto is_on_it = [&](Vec3 p) {
        return std::fabs(slab.height + dot(slab.rise, on_ground(p) - slab.at) - p.y) < k_flat;
    };
    const Vec2 low = grid.origin + Vec2{static_cast<float>(x), static_cast<float>(z)} * grid.cell;
    float area = 0, twice_covered = 0;
    for (uint32_t k = grid.first[c]; k < grid.first[c + 1]; ++k) {
        const GridTriangle& t = ground.grid_triangles[grid.items[k]];
        if (t.kind != slab.kind || !is_on_it(t.a) || !is_on_it(t.b) || !is_on_it(t.c)) return {};
        const SquarePart piece = part_in_square(t, low, grid.cell);
        area += square_metres(piece);
        for (uint32_t j = grid.first[c]; j < k; ++j)
            twice_covered += overlap(piece, ground.grid_triangles[grid.items[j]], low);
    }
    // A gap may be as large as what lies on something else.
    if (std::fabs(area - grid.cell * grid.cell) > k_area || twice_covered > k_area) return {};
    return slab;
}

// Each slab once, for all its cells.
static void find_slabs(Ground& ground) {
    const Grid& grid = ground.triangle_grid;
    ground.slabs.clear();
    std::map<std::tuple<float, float, float, float, float, Surface>, uint32_t> numbers;
    ground.slab_of_cell.assign(grid.first.size() - 1, k_no_slab);
    for (int z = 0; z < grid.height; ++z)
        for (int x = 0; x < grid.width; ++x) {
            const auto slab = slab_in(ground, x, z);
            if (!slab) continue;
            const auto [at, rise, height, normal, kind] = *slab;
            const auto [known, is_new] = numbers.try_emplace({at.x, at.z, rise.x, rise.z, height, kind},
                                                             static_cast<uint32_t>(ground.slabs.size()));
            ground.slab_of_cell[static_cast<size_t>(z) * grid.width + x] = known->second;
            if (is_new) ground.slabs.push_back(*slab);
        }
}

void index_ground(Ground& ground) {
    assert(ground.indices.size() == ground.kinds.size() * 3);
    constexpr float k_far = 1e30f;
    Vec2 low{k_far, k_far}, high{-k_far, -k_far};
    auto include = [&](Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    };
    for (Vec3 v : ground.vertices) include(v);
    for (const Face& f : ground.faces) include(f.a), include(f.b);
    for (const Solid& s : ground.solids) include(s.a), include(s.b), include(s.c);
    if (low.x > high.x) low = high = {0, 0};
    ground.low = low;
    ground.high = high;

    Vec2 margin{2 * k_grid_margin, 2 * k_grid_margin};
    ground.triangle_grid = make_grid(low - margin, high + margin, k_triangle_cell);
    fill_grid(ground.triangle_grid, static_cast<uint32_t>(ground.kinds.size()), [&](uint32_t i, auto visit) {
        Vec2 a = on_ground(ground.vertices[ground.indices[i * 3]]);
        Vec2 b = on_ground(ground.vertices[ground.indices[i * 3 + 1]]);
        Vec2 c = on_ground(ground.vertices[ground.indices[i * 3 + 2]]);
        if (inside(a, b, c) < k_least_area) return;
        for_cells_of_triangle(ground.triangle_grid, a, b, c, visit);
    });
    ground.grid_triangles.clear();
    for (size_t i = 0; i < ground.kinds.size(); ++i) {
        const uint32_t* index = &ground.indices[i * 3];
        ground.grid_triangles.push_back({ground.vertices[index[0]], ground.vertices[index[1]],
                                         ground.vertices[index[2]], ground.kinds[i]});
    }
    find_slabs(ground);
    ground.wall_grid = make_grid(low - margin, high + margin, k_wall_cell);
    fill_grid(ground.wall_grid, static_cast<uint32_t>(ground.faces.size()), [&](uint32_t i, auto visit) {
        const Face& f = ground.faces[i];
        if (is_wall(f)) for_cells_of_segment(ground.wall_grid, on_ground(f.a), on_ground(f.b), visit);
    });
    ground.grid_walls.clear();
    for (uint32_t i : ground.wall_grid.items) {
        const Face& f = ground.faces[i];
        Vec2 along = on_ground(f.b) - on_ground(f.a);
        ground.grid_walls.push_back({on_ground(f.a), along, 1 / std::max(length_squared(along), 1e-12f),
                                     f.a.y, f.b.y - f.a.y, f.a_top, f.b_top - f.a_top});
    }
    index_solids(ground);
}

uint64_t hash_ground(const Ground& ground) {
    uint64_t h = hash_bytes(0, ground.name.data(), ground.name.size());
    auto add = [&h](const void* data, size_t size) { h = hash_bytes(h, data, size); };
    auto add_array = [&](const auto& values) { add(values.data(), values.size() * sizeof(values[0])); };
    add_array(ground.vertices);
    add_array(ground.indices);
    add_array(ground.kinds);
    // Field by field where a struct has padding.
    for (const Face& f : ground.faces) {
        add(&f.a, sizeof f.a);
        add(&f.b, sizeof f.b);
        float tops[] = {f.a_top, f.b_top};
        add(tops, sizeof tops);
        h = mix(h ^ (uint64_t{f.building} << 8 | static_cast<uint64_t>(f.kind)));
    }
    add_array(ground.solids);
    add_array(ground.obstacles);
    return h;
}

}  // namespace flaneur
