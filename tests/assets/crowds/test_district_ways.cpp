// Our ways against those that Detour finds on the same mesh.
#include <gtest/gtest.h>

#include <algorithm>

#include "assets/cities.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/crowd/demand.h"
#include "sim/navigation/navmesh_data.h"

namespace flaneur {
namespace {

constexpr int k_most = 256;

// What a line through places of the mesh costs, as the ground under it says.
double cost_of_line(const Navmesh& m, Vec3 from, std::span<const Vec3> corners) {
    constexpr float k_piece = 0.5f;  // metres
    double cost = 0;
    for (Vec3 to : corners) {
        const float distance = length(on_ground(to - from));
        const int pieces = static_cast<int>(distance / k_piece) + 1;
        for (int i = 0; i < pieces; ++i) {
            const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(pieces);
            const auto place = nearest(m, 0, lerp(from, to, share), {0.3f, 1.5f, 0.3f});
            const float a_metre = place ? m.gates.costs[polygon_number(m, place->polygon)] : 1;
            cost += static_cast<double>(a_metre * distance) / pieces;
        }
        from = to;
    }
    return cost;
}

// Of a way through these polygons by the middles of their gates.
double cost_of_polygons(const Navmesh& m, std::span<const dtPolyRef> polygons, Vec3 from, Vec3 to) {
    const Gates& g = m.gates;
    double cost = 0;
    for (size_t k = 0; k + 1 < polygons.size(); ++k) {
        const uint32_t here = polygon_number(m, polygons[k]), there = polygon_number(m, polygons[k + 1]);
        uint32_t gate = g.first[here];
        while (behind(g.gates[g.of[gate]], here) != there) ++gate;
        cost += static_cast<double>(cost_to_gate(g, from, here, g.of[gate]));
        from = g.middles[g.of[gate]];
    }
    return cost + static_cast<double>(g.costs[polygon_number(m, polygons.back())] * length(to - from));
}

TEST(DistrictWays, AreAsGoodAsDetours) {
    const City city = generate_district({3, 3});
    auto mesh = build_navmesh(city.ground, {}, 2);
    ASSERT_TRUE(mesh);
    const Navmesh& m = **mesh;
    const Demand demand = make_demand(city.destinations, city.ground.low, city.ground.high, m, 17.5f);
    const std::unique_ptr<dtNavMeshQuery, DetourDelete> query(dtAllocNavMeshQuery());
    query->init(m.mesh.get(), 65535);
    double our_costs = 0, their_costs = 0;
    int trips = 0;
    for (uint32_t i = 0; i < 300; ++i) {
        const RandomKey key{5, i, 0, Purpose::spawn};
        const NavPoint from =
            random_place(m, 0, random_unit(key, 0), random_unit(key, 1), random_unit(key, 2));
        const auto trip = choose_trip(demand, m, 0, from, By::feet, 0, {5, i, 0, Purpose::errand});
        if (!trip) continue;
        const NavPoint to = trip->place;
        dtPolyRef polygons[k_most];
        int count = 0, corner_count = 0;
        query->findPath(from.polygon, to.polygon, floats(from.position), floats(to.position), &m.filter,
                        polygons, &count, k_most);
        if (count == k_most) continue;
        Vec3 theirs[k_most], ours[k_most];
        query->findStraightPath(floats(from.position), floats(to.position), polygons, count,
                                floats(theirs[0]), nullptr, nullptr, &corner_count, k_most);
        const int our_count = find_path(m, 0, from, to, ours, k_most);
        ASSERT_GT(our_count, 0);
        EXPECT_LT(length(ours[our_count - 1] - to.position), 0.01f);

        const WayEnds ends{from.position, to.position, polygon_number(m, from.polygon),
                           polygon_number(m, to.polygon)};
        if (ends.from_polygon == ends.to_polygon) continue;
        std::vector<dtPolyRef> passed{from.polygon};
        for (uint32_t gate : cheapest_way(m.gates, m.shortcuts, m.costs, *m.searches[0], ends)) {
            const uint32_t next = behind(m.gates.gates[gate], polygon_number(m, passed.back()));
            passed.push_back(m.references[next]);
        }
        ASSERT_EQ(passed.back(), to.polygon);
        EXPECT_LE(
            cost_of_polygons(m, passed, from.position, to.position),
            cost_of_polygons(m, {polygons, static_cast<size_t>(count)}, from.position, to.position) * 1.0001)
            << "trip " << i;
        our_costs += cost_of_line(m, from.position, {ours, static_cast<size_t>(our_count)});
        their_costs += cost_of_line(m, from.position, {theirs, static_cast<size_t>(corner_count)});
        ++trips;
    }
    EXPECT_GT(trips, 200);
    EXPECT_LT(our_costs, their_costs * 1.01);
}

// The mesh has seams, where Recast's outlines of neighbours differ by little; Detour stops at them, or puts
// one metres away.
TEST(DistrictWays, NobodyJumpsAlongTheMeshNorStopsWhereNoBorderIs) {
    constexpr float k_slack = 0.01f, k_by_border = 0.05f;  // metres
    const City city = generate_district({3, 3});
    auto mesh = build_navmesh(city.ground, {}, 2);
    ASSERT_TRUE(mesh);
    prepare_queries(**mesh, 1);
    const Navmesh& m = **mesh;
    uint32_t jumped = 0, stopped = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
        NavPoint p = random_place(m, 0, random_unit({7, i, 0, Purpose::spawn}, 0),
                                  random_unit({7, i, 0, Purpose::spawn}, 1),
                                  random_unit({7, i, 0, Purpose::spawn}, 2));
        Vec2 way{};
        for (uint32_t k = 0; k < 1000; ++k) {
            const RandomKey key{7, i, k, Purpose::destination};
            if (k % 100 == 0) way = heading_direction(random_between(key, -k_pi, k_pi));
            const Vec3 to = p.position + at_height(way * random_between(key, 0.01f, 0.3f, 1), 0);
            const NavPoint moved = move_along(m, 0, p, to);
            const Vec3 off = moved.position - p.position;
            jumped += length(on_ground(off)) > 1.25f * length(on_ground(to - p.position)) + 0.051f;
            BorderLine line;
            stopped += length(on_ground(moved.position - to)) > k_slack &&
                       borders_near(m, moved.position, k_by_border, &line, 1) == 0;
            p = moved;
        }
    }
    EXPECT_EQ(jumped, 0u);
    EXPECT_EQ(stopped, 0u);
}

}  // namespace
}  // namespace flaneur
