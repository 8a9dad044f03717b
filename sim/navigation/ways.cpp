// find_path: gates, then a string pulled tight through them.
#include <algorithm>

#include "sim/navigation/navmesh_data.h"
#include "sim/navigation/traffic.h"

namespace flaneur {

static constexpr uint32_t k_most_seen = 16384;  // polygons, where a goal is out of reach

// Of where one comes to from a polygon, the polygon with the gate nearest to the goal as the crow flies.
static uint32_t nearest_within_reach(const Gates& g, WaySearch& w, uint32_t from, Vec3 goal, By by) {
    const uint32_t time = ++w.times;
    w.reached.assign(1, from);
    w.seen[from] = time;
    uint32_t nearest = from;
    float least = 1e30f;
    for (size_t k = 0; k < w.reached.size() && k < k_most_seen; ++k) {
        const uint32_t polygon = w.reached[k];
        for (uint32_t i = g.first[polygon]; i < g.first[polygon + 1]; ++i) {
            const uint32_t other = behind(g.gates[g.of[i]], polygon);
            const float off = length_squared(goal - g.middles[g.of[i]]);
            if (off < least) least = off, nearest = polygon;
            if (w.seen[other] == time || (by == By::wheels && g.steps[other])) continue;
            w.seen[other] = time;
            w.reached.push_back(other);
        }
    }
    return nearest;
}

// The gates as they are passed. One whose next lies at the same polygon is not: where gates lie in one line,
// the way from one to a third may as well lead through the second.
static void find_doorways(const Gates& g, std::span<const uint32_t> way, uint32_t from,
                          std::vector<Doorway>& doorways) {
    doorways.clear();
    for (size_t k = 0; k < way.size(); ++k) {
        auto is_of = [&](const Gate& gate) { return gate.polygons[0] == from || gate.polygons[1] == from; };
        if (k + 1 < way.size() && is_of(g.gates[way[k + 1]])) continue;
        const Gate& gate = g.gates[way[k]];
        doorways.push_back(gate.polygons[0] == from ? Doorway{gate.left, gate.right}
                                                    : Doorway{gate.right, gate.left});
        from = behind(gate, from);
    }
}

static int find_path(const Navmesh& m, const ShortcutCosts* slow, int thread, NavPoint from, NavPoint to,
                     Vec3* corners, int capacity, By by) {
    if (!m.mesh->isValidPolyRef(from.polygon) || !m.mesh->isValidPolyRef(to.polygon) || capacity <= 0)
        return 0;
    WaySearch& search = *m.searches[thread];
    const bool wheels = by == By::wheels && !m.wheel_costs.costs.empty();
    const ShortcutCosts& costs = wheels ? m.wheel_costs : slow ? *slow : m.costs;
    WayEnds ends{from.position, to.position, polygon_number(m, from.polygon), polygon_number(m, to.polygon)};
    std::span<const uint32_t> way;
    auto look = [&] {
        if (ends.from_polygon == ends.to_polygon) return true;
        if (wheels && m.gates.steps[ends.to_polygon]) return false;
        way = cheapest_way(m.gates, m.shortcuts, costs, search, ends);
        return !way.empty();
    };
    if (!look()) {
        ends.to_polygon = nearest_within_reach(m.gates, search, ends.from_polygon, to.position, by);
        m.queries[thread]->closestPointOnPoly(m.references[ends.to_polygon], floats(to.position),
                                              floats(ends.to), nullptr);
        way = {};
        look();
    }
    find_doorways(m.gates, way, ends.from_polygon, search.doorways);
    return pull_string(search.doorways, ends.from, ends.to, corners, capacity);
}

int find_path(const Navmesh& m, int thread, NavPoint from, NavPoint to, Vec3* corners, int capacity, By by) {
    return find_path(m, nullptr, thread, from, to, corners, capacity, by);
}

int find_path(const Navmesh& m, const Traffic& traffic, int thread, NavPoint from, NavPoint to, Vec3* corners,
              int capacity, By by) {
    return find_path(m, traffic.is_slow ? traffic.costs.get() : nullptr, thread, from, to, corners, capacity,
                     by);
}

}  // namespace flaneur
