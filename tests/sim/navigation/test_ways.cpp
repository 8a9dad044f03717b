#include <gtest/gtest.h>

#include <algorithm>
#include <queue>

#include "sim/base/rng.h"
#include "sim/navigation/dissection.h"
#include "sim/navigation/navmesh_data.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

float number(uint32_t i, float low, float high) {
    return random_between({11, 0, 0, Purpose::city}, low, high, i);
}

// Streets and walls: many ways from anywhere to anywhere, of ground that costs more and less.
Ground town() {
    Ground ground = square(120);
    for (int k = 0; k < 6; ++k) {
        const float at = -50 + 20 * static_cast<float>(k);
        add_floor(ground, {at, -60}, {at + 3, 60}, 0, k % 2 ? Surface::road : Surface::grass);
        add_wall(ground, {at - 4, 0, -55}, {at - 4, 0, number(2 * static_cast<uint32_t>(k), -20, 40)}, 2,
                 FaceKind::garden_wall);
        add_wall(ground, {number(2 * static_cast<uint32_t>(k) + 1, -40, 10), 0, at}, {50, 0, at}, 2,
                 FaceKind::garden_wall);
    }
    index_ground(ground);
    return ground;
}

NavmeshPtr build(const Ground& ground, int threads = 1) {
    auto mesh = build_navmesh(ground, {}, threads);
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
    return std::move(mesh).value();
}

// Dijkstra's: the cost of the way to each gate from a place.
std::vector<double> costs_from(const Gates& g, Vec3 place, uint32_t polygon) {
    std::vector<double> costs(g.gates.size(), 1e30);
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
    auto reach = [&](uint32_t p, Vec3 from, double so_far) {
        for (uint32_t k = g.first[p]; k < g.first[p + 1]; ++k) {
            const double cost = so_far + static_cast<double>(cost_to_gate(g, from, p, g.of[k]));
            if (cost < costs[g.of[k]]) next.push({costs[g.of[k]] = cost, g.of[k]});
        }
    };
    reach(polygon, place, 0);
    while (!next.empty()) {
        const auto [cost, gate] = next.top();
        next.pop();
        if (cost > costs[gate]) continue;
        for (uint32_t p : g.gates[gate].polygons) reach(p, g.middles[gate], cost);
    }
    return costs;
}

// What a way through these gates costs.
double cost_of(const Gates& g, std::span<const uint32_t> way, const WayEnds& ends) {
    double sum = 0;
    Vec3 at = ends.from;
    for (size_t k = 0; k < way.size(); ++k) {
        double least = 1e30;  // two gates may share two polygons
        for (uint32_t p : g.gates[way[k]].polygons) {
            const bool from_here =
                k == 0 ? p == ends.from_polygon
                       : g.gates[way[k - 1]].polygons[0] == p || g.gates[way[k - 1]].polygons[1] == p;
            if (from_here) least = std::min(least, static_cast<double>(cost_to_gate(g, at, p, way[k])));
        }
        sum += least;
        at = g.middles[way[k]];
    }
    return sum + static_cast<double>(cost_to_gate(g, ends.to, ends.to_polygon, way.back()));
}

TEST(Ways, AreTheCheapestThereAre) {
    const Ground ground = town();
    const NavmeshPtr mesh = build(ground);
    const Gates& g = mesh->gates;
    ASSERT_GT(g.gates.size(), 200u);
    int compared = 0;
    for (uint32_t from = 0; from < 12; ++from) {
        const NavPoint a = random_place(*mesh, 0, number(from * 3, 0, 1), 0.3f, 0.3f);
        const uint32_t start = polygon_number(*mesh, a.polygon);
        const std::vector<double> costs = costs_from(g, a.position, start);
        for (uint32_t to = 0; to < 40; ++to) {
            const NavPoint b = random_place(*mesh, 0, number(1000 + to, 0, 1), 0.4f, 0.2f);
            const WayEnds ends{a.position, b.position, start, polygon_number(*mesh, b.polygon)};
            if (ends.from_polygon == ends.to_polygon || island(*mesh, a.polygon) != island(*mesh, b.polygon))
                continue;
            const auto way = cheapest_way(g, mesh->shortcuts, mesh->costs, *mesh->searches[0], ends);
            ASSERT_FALSE(way.empty());
            double least = 1e30;
            for (uint32_t k = g.first[ends.to_polygon]; k < g.first[ends.to_polygon + 1]; ++k)
                least = std::min(least, costs[g.of[k]] + static_cast<double>(cost_to_gate(
                                                             g, b.position, ends.to_polygon, g.of[k])));
            EXPECT_NEAR(cost_of(g, way, ends) / least, 1, 1e-4) << from << " " << to;
            ++compared;
        }
    }
    EXPECT_GT(compared, 300);
}

TEST(Ways, DependOnNeitherThreadsNorWhoAskedBefore) {
    const Ground ground = town();
    const NavmeshPtr mesh = build(ground), again = build(ground, 2);
    EXPECT_EQ(dissect(mesh->gates, 1), dissect(mesh->gates, 3));
    EXPECT_EQ(mesh->costs.costs, again->costs.costs);
    for (uint32_t k = 0; k < 100; ++k) {
        const NavPoint a = random_place(*mesh, 0, number(k, 0, 1), 0.5f, 0.1f),
                       b = random_place(*mesh, 0, number(500 + k, 0, 1), 0.1f, 0.5f);
        Vec3 corners[2][32];
        const int count = find_path(*mesh, 0, a, b, corners[0], 32);
        ASSERT_EQ(find_path(*again, 1, a, b, corners[1], 32), count);
        for (int i = 0; i < count; ++i) EXPECT_EQ(corners[0][i], corners[1][i]);
        ASSERT_GT(count, 0);
    }
}

TEST(Ways, OrderHasEachGateOnce) {
    const Ground ground = town();
    const NavmeshPtr mesh = build(ground);
    std::vector<uint32_t> order = dissect(mesh->gates, 2);
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), mesh->gates.gates.size());
    for (uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(Ways, GatesAreSeenFromTheirFirstPolygon) {
    const Ground ground = town();
    const NavmeshPtr mesh = build(ground);
    const Gates& g = mesh->gates;
    for (const Gate& gate : g.gates) {
        Vec2 middle;
        const uint32_t p = gate.polygons[0];
        const auto sides = static_cast<float>(g.first[p + 1] - g.first[p]);
        for (uint32_t k = g.first[p]; k < g.first[p + 1]; ++k)
            middle += on_ground(g.middles[g.of[k]]) / sides;
        EXPECT_GE(cross(on_ground(gate.left) - middle, on_ground(gate.right) - middle), -1e-3f);
    }
}

TEST(Ways, WheelsTakeNoStepsAndGoAsNearAsTheyCan) {
    const Ground ground = steps();
    const NavmeshPtr mesh = build(ground);
    const auto low = nearest(*mesh, 0, {0, 0, -10}), high = nearest(*mesh, 0, {0, 1.5f, 8});
    ASSERT_TRUE(low && high);
    Vec3 corners[32];
    int count = find_path(*mesh, 0, *low, *high, corners, 32, By::feet);
    ASSERT_GT(count, 0);
    EXPECT_NEAR(corners[count - 1].z, 8, 0.1f);
    count = find_path(*mesh, 0, *low, *high, corners, 32, By::wheels);
    ASSERT_GT(count, 0) << "as near as they can";
    EXPECT_LT(corners[count - 1].y, 0.3f) << "not up";
    EXPECT_GT(corners[count - 1].z, low->position.z + 5) << "nearer than before";
}

TEST(Ways, OfAGoalBeyondAWallEndBeforeTheWall) {
    Ground ground = square(40);
    add_wall(ground, {-20, 0, 3}, {20, 0, 3}, 2, FaceKind::garden_wall);
    index_ground(ground);
    const NavmeshPtr mesh = build(ground);
    const auto a = nearest(*mesh, 0, {-10, 0, -15}), b = nearest(*mesh, 0, {10, 0, 10});
    ASSERT_TRUE(a && b);
    Vec3 corners[32];
    const int count = find_path(*mesh, 0, *a, *b, corners, 32);
    ASSERT_GT(count, 0);
    EXPECT_LT(corners[count - 1].z, 3);
    EXPECT_GT(corners[count - 1].z, 1);
    EXPECT_NEAR(corners[count - 1].x, 10, 4);
    EXPECT_EQ(find_path(*mesh, 0, *a, {b->position, 0}, corners, 32), 0);
    EXPECT_EQ(find_path(*mesh, 0, {a->position, 0}, *b, corners, 32), 0);
}

TEST(StringPulling, TurnsAboutTheInnerEndsAlone) {
    // From the origin on along +z: left is +x.
    const Doorway ahead{{1, 0, 2}, {-1, 0, 2}}, beyond{{1, 0, 4}, {-1, 0, 4}};
    Vec3 corners[8];
    ASSERT_EQ(pull_string(std::vector{ahead, beyond}, {}, {0.5f, 0, 9}, corners, 8), 1);
    EXPECT_EQ(corners[0], (Vec3{0.5f, 0, 9}));
    // Off to the left behind the second doorway, which is then passed at its left end.
    const Doorway aside{{1, 0, 4}, {1, 0, 6}};
    ASSERT_EQ(pull_string(std::vector{ahead, beyond, aside}, {}, {9, 0, 5}, corners, 8), 2);
    EXPECT_EQ(corners[0], (Vec3{1, 0, 4}));
    EXPECT_EQ(corners[1], (Vec3{9, 0, 5}));
    EXPECT_EQ(pull_string(std::vector{ahead, beyond, aside}, {}, {9, 0, 5}, corners, 1), 1);
    EXPECT_EQ(corners[0], (Vec3{1, 0, 4}));
    EXPECT_EQ(pull_string({}, {}, {0, 0, 1}, corners, 8), 1);
    EXPECT_EQ(pull_string({}, {}, {}, corners, 8), 1) << "who is there has a path that ends there";
}

}  // namespace
}  // namespace flaneur
