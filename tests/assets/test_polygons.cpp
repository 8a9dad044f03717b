#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "assets/plan/ground_plan.h"
#include "assets/plan/polygons.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {
namespace {

struct Dice {
    uint64_t seed;
    uint32_t next = 0;
    float between(float low, float high) {
        return random_between({seed, 0, 0, Purpose::city}, low, high, next++);
    }
};

// A star-shaped ring with `corners` corners, inner and outer radius in metres.
Ring star(Dice& dice, Vec2 centre, int corners, float low, float high) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        float angle =
            2 * k_pi * (static_cast<float>(i) + dice.between(0, 0.9f)) / static_cast<float>(corners);
        ring.push_back(to_point(centre + heading_direction(angle) * dice.between(low, high)));
    }
    return positive(ring);
}

int64_t triangle_area(const Region& region, const std::vector<uint32_t>& triangles) {
    Ring points;
    for (const Ring& ring : rings_of(region)) points.insert(points.end(), ring.begin(), ring.end());
    int64_t sum = 0;
    for (size_t i = 0; i < triangles.size(); i += 3) {
        int64_t t = twice_area({points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]]});
        EXPECT_GT(t, 0);
        sum += t;
    }
    return sum;
}

int64_t region_area(const Region& region) {
    int64_t sum = 0;
    for (const Ring& ring : rings_of(region)) sum += twice_area(ring);
    return sum;
}

TEST(Polygons, MetresToMillimetresAndBack) {
    EXPECT_EQ(to_point({1.2345f, -0.0006f}), Point(1235, -1));
    EXPECT_EQ(to_metres({-2500, 1}).x, -2.5f);
}

TEST(Polygons, TriangulatesSquareWithHole) {
    Ring hole = rectangle({2000, 2000}, {3000, 4000});
    std::reverse(hole.begin(), hole.end());
    Region region{rectangle({0, 0}, {10000, 5000}), {hole}};
    std::vector<uint32_t> triangles = triangulate(region);
    EXPECT_EQ(triangles.size(), 8u * 3);
    EXPECT_EQ(triangle_area(region, triangles), 2 * (50'000'000 - 2'000'000));
}

TEST(Polygons, CornersOnAnEdgeStayCorners) {
    Region region{{{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}, {3000, 1000}, {0, 1000}}, {}};
    std::vector<uint32_t> triangles = triangulate(region);
    EXPECT_EQ(triangles.size(), 4u * 3);
    EXPECT_EQ(triangle_area(region, triangles), region_area(region));
}

TEST(Polygons, TriangulationKeepsAreaExactly) {
    for (uint64_t seed = 0; seed < 150; ++seed) {
        Dice dice{seed};
        Rings shapes{star(dice, {0, 0}, 5 + static_cast<int>(seed % 40), 8, 20)};
        Rings holes;
        for (uint64_t h = 0; h < seed % 7; ++h) {
            holes.push_back(
                star(dice, {dice.between(-10, 10), dice.between(-10, 10)}, 4 + static_cast<int>(h), 0.5f, 4));
        }
        for (const Region& region : regions_of(subtract(shapes, holes))) {
            EXPECT_EQ(triangle_area(region, triangulate(region)), region_area(region)) << "seed " << seed;
        }
    }
}

TEST(Polygons, InsetMovesEdgesAndRefusesWhatVanishes) {
    std::optional<Ring> smaller = inset(rectangle({0, 0}, {10000, 6000}), 1000);
    ASSERT_TRUE(smaller);
    EXPECT_EQ(twice_area(*smaller), 2 * 8000 * 4000);
    std::optional<Ring> larger = inset(rectangle({0, 0}, {10000, 6000}), -500);
    ASSERT_TRUE(larger);
    EXPECT_EQ(twice_area(*larger), 2 * 11000 * 7000);
    EXPECT_FALSE(inset(rectangle({0, 0}, {10000, 6000}), 3000));
}

TEST(Polygons, StripCoversItsLine) {
    Rings strip;
    add_strip(strip, {{0, 0}, {10, 0}, {10, 10}, {9, 0.5f}}, 1, 2, true);
    for (const Ring& ring : strip) {
        EXPECT_GT(twice_area(ring), 0);
        EXPECT_TRUE(is_convex(ring));
    }
    Rings whole = unite(strip);
    // Walking +x, left is -z.
    EXPECT_TRUE(contains(whole, to_point({5, -0.99f})));
    EXPECT_FALSE(contains(whole, to_point({5, -1.01f})));
    EXPECT_TRUE(contains(whole, to_point({5, 1.99f})));
    EXPECT_TRUE(contains(whole, to_point({-0.9f, 0})));
    EXPECT_TRUE(contains(whole, to_point({10, 10.9f})));
}

GroundPlan random_plan(uint64_t seed) {
    Dice dice{seed};
    GroundPlan plan;
    plan.low = {-40, -40};
    plan.high = {45, 40};
    plan.cell = 16;
    for (int a = 0; a < 30; ++a) {
        Area area;
        area.rank = a % 5;
        area.solid = a % 5 == 0;
        area.kind = static_cast<Surface>(a % 6);
        area.lift = flat(0.06f * static_cast<float>(a % 4));
        if (a % 2) {
            add_strip(area.rings,
                      {{dice.between(-50, 50), dice.between(-50, 50)},
                       {dice.between(-50, 50), dice.between(-50, 50)}},
                      2, 3, true);
        } else {
            area.rings = {star(dice, {dice.between(-40, 40), dice.between(-40, 40)}, 7, 3, 12)};
        }
        plan.areas.push_back(area);
    }
    Area rest;
    rest.rank = 9;
    rest.kind = Surface::grass;
    rest.rings = {rectangle(to_point(plan.low), to_point(plan.high))};
    plan.areas.push_back(rest);
    return plan;
}

TEST(GroundPlan, PiecesCoverAllButSolidsOnce) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
        GroundPlan plan = random_plan(seed);
        Rings solid;
        for (const Area& area : plan.areas) {
            if (area.solid) solid.insert(solid.end(), area.rings.begin(), area.rings.end());
        }
        Rings box{rectangle(to_point(plan.low), to_point(plan.high))};
        double expected = area(subtract(box, solid)), pieces = 0;
        for (const Piece& piece : cut_pieces(plan)) pieces += area(rings_of(piece.region));
        EXPECT_NEAR(pieces, expected, 0.05) << "seed " << seed;
    }
}

// A crossing exactly as wide as its road, rounded to a millimetre more or less, leaves slivers that welding
// closes.
TEST(GroundPlan, TrianglesCoverEachPieceOnce) {
    for (uint64_t seed = 0; seed < 40; ++seed) {
        GroundPlan plan = random_plan(seed);
        Dice dice{seed};
        Vec2 p{dice.between(-30, 30), dice.between(-30, 30)}, q{dice.between(-30, 30), dice.between(-30, 30)};
        Vec2 along = normalize_or(q - p, {1, 0}), side{along.z, -along.x};
        Area road;
        road.rank = 1;
        add_strip(road.rings, {p, q}, 4, 4, true);
        for (int i = 1; i < 4; ++i) {
            Vec2 c = lerp(p, q, 0.25f * static_cast<float>(i));
            Area crossing;
            crossing.rings = {
                positive({to_point(c - along * 1.5f - side * 4), to_point(c + along * 1.5f - side * 4),
                          to_point(c + along * 1.5f + side * 4), to_point(c - along * 1.5f + side * 4)})};
            plan.areas.push_back(crossing);
        }
        plan.areas.push_back(road);
        double triangles = 0, pieces = 0;
        for (const Piece& piece : cut_pieces(plan)) {
            double covered =
                static_cast<double>(triangle_area(piece.region, triangulate(piece.region))) * 0.5e-6;
            EXPECT_NEAR(covered, area(rings_of(piece.region)), 0.002) << "seed " << seed;
            triangles += covered;
            pieces += area(rings_of(piece.region));
        }
        EXPECT_NEAR(triangles, pieces, 0.01);
    }
}

TEST(GroundPlan, EachKindHasTheAreaThatItsRankLeaves) {
    GroundPlan plan = random_plan(3);
    Rings taken;
    double expected[k_surface_count] = {}, found[k_surface_count] = {};
    for (int rank = 0; rank < 10; ++rank) {
        for (const Area& a : plan.areas) {
            if (a.rank != rank) continue;
            Rings box{rectangle(to_point(plan.low), to_point(plan.high))};
            if (!a.solid)
                expected[static_cast<int>(a.kind)] += area(subtract(intersect(box, a.rings), taken));
            taken = unite([&] {
                Rings all = taken;
                all.insert(all.end(), a.rings.begin(), a.rings.end());
                return all;
            }());
        }
    }
    for (const Piece& piece : cut_pieces(plan)) {
        found[static_cast<int>(plan.areas[piece.area].kind)] += area(rings_of(piece.region));
    }
    for (int k = 0; k < k_surface_count; ++k) EXPECT_NEAR(found[k], expected[k], 0.05) << "kind " << k;
}

// Every edge of a piece is its neighbour's edge the other way round, or lies on a solid or the outer border.
TEST(GroundPlan, NeighboursShareEdges) {
    GroundPlan plan = random_plan(5);
    struct Directed {
        Point a, b;
        auto key() const { return std::tuple(a.X, a.Y, b.X, b.Y); }
    };
    std::vector<Directed> edges;
    for (const Piece& piece : cut_pieces(plan)) {
        for (const Ring& ring : rings_of(piece.region)) {
            for (size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
        }
    }
    auto less = [](const Directed& p, const Directed& q) { return p.key() < q.key(); };
    std::sort(edges.begin(), edges.end(), less);
    Rings solid, box{rectangle(to_point(plan.low), to_point(plan.high))};
    for (const Area& area : plan.areas) {
        if (area.solid) solid.insert(solid.end(), area.rings.begin(), area.rings.end());
    }
    size_t alone = 0;
    for (const Directed& e : edges) {
        if (std::binary_search(edges.begin(), edges.end(), Directed{e.b, e.a}, less)) continue;
        // Two decimetres to its right lies a solid or the outside.
        Vec2 p = to_metres(e.a), q = to_metres(e.b), along = normalize_or(q - p, {1, 0});
        Vec2 beside = lerp(p, q, 0.5f) + Vec2{along.z, -along.x} * 0.004f;
        if (length(q - p) < 0.01f) continue;
        bool open = contains(box, to_point(beside)) && !contains(unite(solid), to_point(beside));
        alone += open;
        if (open)
            ADD_FAILURE() << "edge (" << p.x << ", " << p.z << ") to (" << q.x << ", " << q.z
                          << ") has no neighbour";
    }
    EXPECT_EQ(alone, 0u);
    EXPECT_GT(edges.size(), 500u);
}

TEST(GroundPlan, KerbStandsBetweenRoadAndSidewalk) {
    GroundPlan plan;
    plan.low = {0, 0};
    plan.high = {20, 10};
    Area road, sidewalk;
    road.kind = Surface::road;
    road.rings = {rectangle({0, 0}, {20000, 6000})};
    sidewalk.rank = 1;
    sidewalk.kind = Surface::sidewalk;
    sidewalk.lift = flat(k_kerb);
    sidewalk.rings = {rectangle({0, 0}, {20000, 10000})};
    plan.areas = {road, sidewalk};
    City city;
    lay_ground(plan, city);
    ASSERT_EQ(city.ground.faces.size(), 1u);
    const Face& kerb = city.ground.faces[0];
    EXPECT_EQ(kerb.kind, FaceKind::kerb);
    EXPECT_FLOAT_EQ(kerb.a.y, 0);
    EXPECT_FLOAT_EQ(kerb.a_top, k_kerb);
    // It faces the road, at smaller z: the outward normal is cross(b - a, up).
    Vec3 normal = cross(kerb.b - kerb.a, Vec3{0, 1, 0});
    EXPECT_LT(normal.z, 0);
}

}  // namespace
}  // namespace flaneur
