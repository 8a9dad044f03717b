#include "sim/navigation/traffic.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/navigation/navmesh_data.h"
#include "sim/navigation/shortcuts.h"

namespace flaneur {

static bool is_any_slow(std::span<const float> slow) {
    return std::ranges::any_of(slow, [](float times) { return times > 1; });
}

uint32_t number_of(const Navmesh& m, uint32_t polygon) { return polygon_number(m, polygon); }

static std::vector<float> polygon_areas(const Navmesh& m) {
    std::vector<float> areas(polygons_of(m.gates));
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t reference) {
        const dtPoly& polygon = tile.polys[p];
        const Vec2 first = on_ground(tile_vertex(tile, polygon.verts[0]));
        float twice = 0;
        for (int k = 1; k + 1 < polygon.vertCount; ++k)
            twice += cross(on_ground(tile_vertex(tile, polygon.verts[k])) - first,
                           on_ground(tile_vertex(tile, polygon.verts[k + 1])) - first);
        areas[polygon_number(m, reference)] = 0.5f * std::fabs(twice);
    });
    return areas;
}

Traffic make_traffic(const Navmesh& mesh) {
    Traffic t;
    t.slow.assign(polygons_of(mesh.gates), 1);
    t.coming = t.slow;
    t.areas = polygon_areas(mesh);
    for (auto* costs : {&t.costs, &t.coming_costs}) {
        *costs = std::make_shared<ShortcutCosts>();
        (*costs)->costs.reserve(mesh.shortcuts.to.size());
        (*costs)->through.reserve(mesh.shortcuts.to.size());
    }
    return t;
}

float slowness(float density) {
    constexpr float k_free = 0.5f, k_most = 5, k_jam = 5.4f;  // people a square metre
    if (density <= k_free) return 1;
    auto speed = [](float d) { return 1 - exponential(-1.913f * (1 / d - 1 / k_jam)); };
    return std::min(k_most, speed(k_free) / std::max(speed(std::min(density, k_jam)), 0.01f));
}

void begin(Traffic& t, const Navmesh& m) {
    if (!t.is_slow && !is_any_slow(t.coming)) return;
    forget_costs(m.shortcuts, *t.coming_costs);
    t.done = 1;
}

// Steps [begin, end) of the work: first polygon by polygon, then rank by rank.
static void put_in(Traffic& t, const Navmesh& m, uint32_t begin, uint32_t end) {
    const uint32_t polygons = polygons_of(m.gates);
    put_in_polygons(m.gates, m.shortcuts, *t.coming_costs, std::min(begin, polygons), std::min(end, polygons),
                    false, t.coming);
    put_in_ranks(m.shortcuts, *t.coming_costs, std::max(begin, polygons) - polygons,
                 std::max(end, polygons) - polygons);
}

static uint32_t all_steps(const Navmesh& m) {
    return polygons_of(m.gates) + static_cast<uint32_t>(m.shortcuts.gate_of.size());
}

void go_on(Traffic& t, const Navmesh& m, float share) {
    if (t.done == 0) return;
    const uint32_t all = all_steps(m), from = t.done - 1,
                   to = std::min(all, from + 1 + static_cast<uint32_t>(share * static_cast<float>(all)));
    put_in(t, m, from, to);
    t.done = to + 1;
    if (to < all) return;
    t.done = 0;
    t.slow = t.coming;
    std::swap(t.costs, t.coming_costs);
    t.is_slow = is_any_slow(t.slow);
}

void restore(Traffic& t, const Navmesh& m) {
    t.is_slow = is_any_slow(t.slow);
    if (t.is_slow) *t.costs = find_costs(m.gates, m.shortcuts, false, t.slow);
    if (t.done == 0) return;
    forget_costs(m.shortcuts, *t.coming_costs);
    put_in(t, m, 0, t.done - 1);
}

}  // namespace flaneur
