#include "sim/navigation/gates.h"

#include <algorithm>

#include "sim/navigation/navmesh_data.h"

namespace flaneur {

// Detour winds clockwise seen from above: who leaves a polygon over an edge has its first end on the right.
static Gate gate_of(const dtMeshTile& tile, const dtPoly& polygon, const dtLink& link) {
    const Vec3 right = tile_vertex(tile, polygon.verts[link.edge]);
    const Vec3 left = tile_vertex(tile, polygon.verts[(link.edge + 1) % polygon.vertCount]);
    constexpr uint8_t k_within_tile = 0xff;
    if (link.side == k_within_tile) return {left, right, {}};
    constexpr float k_whole = 255;  // of an edge that several polygons of the next tile share
    return {lerp(right, left, link.bmax / k_whole), lerp(right, left, link.bmin / k_whole), {}};
}

Gates find_gates(const Navmesh& m) {
    Gates g;
    g.costs.resize(m.islands.size());
    g.steps.resize(m.islands.size());
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t reference) {
        const dtPoly& polygon = tile.polys[p];
        const uint32_t number = polygon_number(m, reference);
        g.costs[number] = m.filter.getAreaCost(polygon.getArea());
        g.steps[number] = polygon.getArea() == area_of(Surface::steps);
        for (uint32_t l = polygon.firstLink; l != DT_NULL_LINK; l = tile.links[l].next) {
            if (!tile.links[l].ref) continue;
            const uint32_t other = polygon_number(m, tile.links[l].ref);
            if (other < number) continue;
            Gate gate = gate_of(tile, polygon, tile.links[l]);
            gate.polygons[0] = number, gate.polygons[1] = other;
            g.gates.push_back(gate);
        }
    });
    // A tile's links come in an order that depends on when it was added.
    std::sort(g.gates.begin(), g.gates.end(), [](const Gate& a, const Gate& b) {
        if (a.polygons[0] != b.polygons[0]) return a.polygons[0] < b.polygons[0];
        if (a.polygons[1] != b.polygons[1]) return a.polygons[1] < b.polygons[1];
        return a.left.x != b.left.x ? a.left.x < b.left.x : a.left.z < b.left.z;
    });

    g.first.resize(m.islands.size() + 1);
    for (const Gate& gate : g.gates) {
        g.middles.push_back((gate.left + gate.right) * 0.5f);
        for (uint32_t p : gate.polygons) ++g.first[p + 1];
    }
    for (size_t p = 1; p < g.first.size(); ++p) g.first[p] += g.first[p - 1];
    std::vector<uint32_t> next(g.first.begin(), g.first.end() - 1);
    g.of.resize(g.gates.size() * 2);
    for (uint32_t i = 0; i < g.gates.size(); ++i)
        for (uint32_t p : g.gates[i].polygons) g.of[next[p]++] = i;
    return g;
}

}  // namespace flaneur
