#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/ground/surroundings.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

float number(uint32_t i, float low, float high) {
    return random_between({7, 0, 0, Purpose::city}, low, high, i);
}

// A 40 x 40 m terrain of uneven triangles between integer-ish grid points, with walls at random.
Ground terrain() {
    Ground ground;
    constexpr int k_n = 20;
    auto vertex = [&](int x, int z) {
        uint32_t key = static_cast<uint32_t>(z * (k_n + 1) + x) * 3;
        return Vec3{static_cast<float>(x) * 2 + number(key, -0.6f, 0.6f), number(key + 1, 0, 1.5f),
                    static_cast<float>(z) * 2 + number(key + 2, -0.6f, 0.6f)};
    };
    for (int z = 0; z <= k_n; ++z) {
        for (int x = 0; x <= k_n; ++x) ground.vertices.push_back(vertex(x, z));
    }
    auto at = [](int x, int z) { return static_cast<uint32_t>(z * (k_n + 1) + x); };
    for (int z = 0; z < k_n; ++z) {
        for (int x = 0; x < k_n; ++x) {
            for (uint32_t i :
                 {at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x, z), at(x + 1, z + 1), at(x + 1, z)}) {
                ground.indices.push_back(i);
            }
            ground.kinds.push_back(Surface::road);
            ground.kinds.push_back(Surface::grass);
        }
    }
    for (uint32_t i = 0; i < 60; ++i) {
        Vec3 a{number(5000 + i * 4, 0, 40), 0, number(5001 + i * 4, 0, 40)};
        Vec3 b = a + Vec3{number(5002 + i * 4, -8, 8), 0, number(5003 + i * 4, -8, 8)};
        add_wall(ground, a, b, 3, i % 3 ? FaceKind::facade : FaceKind::garden_wall);
    }
    index_ground(ground);
    return ground;
}

TEST(Ground, GroundHasNoGapsAtVerticesAndEdges) {
    Ground ground = terrain();
    for (size_t i = 0; i < ground.indices.size(); i += 3) {
        for (int e = 0; e < 3; ++e) {
            Vec3 a = ground.vertices[ground.indices[i + e]];
            Vec3 b = ground.vertices[ground.indices[i + (e + 1) % 3]];
            for (float t : {0.0f, 0.1f, 0.37f, 0.5f, 0.93f}) {
                Vec3 p = lerp(a, b, t);
                auto hit = ground_at(ground, p);
                ASSERT_TRUE(hit) << "triangle " << i / 3 << " edge " << e << " at " << t;
                EXPECT_NEAR(hit->height, p.y, 2e-3f);
                EXPECT_GT(hit->normal.y, 0.2f);
            }
        }
    }
}

// Where a kerb divides a long edge at a point that was rounded to a millimetre.
TEST(Ground, GroundHasNoGapsWhereALongEdgeIsDividedBesideItself) {
    constexpr float k_lower = 0.12f, k_upper = 0.2f;
    for (uint32_t i = 0; i < 200; ++i) {
        const Vec2 a{number(i * 4, -3, 3), number(i * 4 + 1, -3, 3)};
        const Vec2 b = a + heading_direction(number(i * 4 + 2, -k_pi, k_pi)) * 5;
        const Vec2 along = (b - a) / 5, left{along.z, -along.x};
        const float beside = number(i * 4 + 3, -7e-4f, 7e-4f);
        const Vec2 between = lerp(a, b, 0.6f) + left * beside;
        Ground ground;
        auto add = [&](Vec2 p, Vec2 q, Vec2 r, float y) {
            if (cross(q - p, r - p) > 0) std::swap(q, r);
            for (Vec2 v : {p, q, r}) {
                ground.indices.push_back(static_cast<uint32_t>(ground.vertices.size()));
                ground.vertices.push_back(at_height(v, y));
            }
            ground.kinds.push_back(Surface::sidewalk);
        };
        add(a, b, lerp(a, b, 0.5f) + left * 4, k_upper);
        add(a, between, a - left * 4, k_lower);
        add(between, b, b - left * 4, k_lower);
        index_ground(ground);
        for (float t : {0.1f, 0.3f, 0.55f, 0.599f, 0.601f, 0.7f, 0.9f})
            for (float share : {0.0f, 0.2f, 0.5f, 0.8f, 1.0f}) {
                const float gap = beside * std::min(t / 0.6f, (1 - t) / 0.4f);
                EXPECT_TRUE(ground_at(ground, at_height(lerp(a, b, t) + left * (gap * share), k_lower)))
                    << i << " at " << t << " beside by " << gap * share;
            }
    }
}

// A step that leans against a floor, thinner than the slack beside its edges: it ends where it does, and none
// of it is in the floor farther on along it.
TEST(Ground, GroundEndsAtTheTipOfASliver) {
    Ground ground;
    add_floor(ground, {-4, -4}, {4, 4}, 0, Surface::plaza);
    for (const Vec3 corner : {Vec3{0.1f, 0.2f, 0.1f}, {0.5f, 0.2f, 0.5005f}, {0.9f, 0.2f, 0.9f}}) {
        ground.indices.push_back(static_cast<uint32_t>(ground.vertices.size()));
        ground.vertices.push_back(corner);
    }
    ground.kinds.push_back(Surface::grass);
    index_ground(ground);
    auto height_at = [&](float along) { return ground_at(ground, {along, 0, along})->height; };
    for (float along : {0.1f, 0.3f, 0.7f, 0.9f}) EXPECT_FLOAT_EQ(height_at(along), 0.2f) << along;
    for (float along : {0.05f, 0.098f, 0.902f, 1.0f, 1.5f, 1.9f}) EXPECT_EQ(height_at(along), 0) << along;
}

TEST(Ground, GroundAgreesWithARayFromAbove) {
    Ground ground = terrain();
    for (uint32_t i = 0; i < 2000; ++i) {
        Vec3 p{number(i * 2, -1, 41), 1, number(i * 2 + 1, -1, 41)};
        auto hit = ground_at(ground, p, 2, 2);
        // Walls of 3 m would stop the ray: start below their tops only where ground is the first thing.
        auto ray = raycast(ground, {p.x, 2.9f, p.z}, {0, -1, 0}, 10);
        // At the rim one stands a millimetre beside what a ray would hit.
        for (int k = 0; k < 8 && hit && !ray; ++k) {
            const Vec2 aside = heading_direction(static_cast<float>(k) * (k_pi / 4) - k_pi) * 1.1e-3f;
            ray = raycast(ground, {p.x + aside.x, 2.9f, p.z + aside.z}, {0, -1, 0}, 10);
        }
        ASSERT_EQ(hit.has_value(), ray.has_value()) << p.x << " " << p.z;
        if (hit) {
            EXPECT_NEAR(hit->height, 2.9f - ray->distance, 1e-3f);
        }
    }
}

TEST(Ground, GroundOfManyIsThatOfEach) {
    Ground ground = terrain();
    std::vector<Vec3> points;
    for (uint32_t i = 0; i < 1003; ++i)
        points.push_back({number(i * 3, -5, 45), number(i * 3 + 1, -1, 3), number(i * 3 + 2, -5, 45)});
    std::vector<std::optional<GroundHit>> hits(points.size(), GroundHit{});
    ground_at(ground, points, 0.5f, 1, hits.data());
    size_t found = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        auto hit = ground_at(ground, points[i], 0.5f, 1);
        ASSERT_EQ(hits[i].has_value(), hit.has_value());
        if (!hit) continue;
        ++found;
        EXPECT_EQ(hits[i]->height, hit->height);
        EXPECT_EQ(hits[i]->kind, hit->kind);
        EXPECT_EQ(hits[i]->normal, hit->normal);
    }
    EXPECT_GT(found, 200u);
    EXPECT_LT(found, 900u);
}

// Where a cell is one plane, its triangles are not asked; with holes, kerbs and ground above ground in it,
// they are.
TEST(Ground, SlabsAnswerAsTheirTrianglesDo) {
    Ground holes;
    add_floor(holes, {0, 0}, {40, 9.2f}, 0, Surface::plaza);
    add_floor(holes, {0, 9.8f}, {40, 20}, 0, Surface::plaza);  // a gap of 0.6 m
    add_floor(holes, {10, 2}, {12, 4}, 0, Surface::path);      // and two kinds in one place
    add_quad(holes, {40, 0, 40}, {40, 0, 20}, {0, 6, 20}, {0, 6, 40}, Surface::grass);
    index_ground(holes);
    Ground level = street(), over = bridge();
    index_ground(level);
    index_ground(over);
    for (const Ground* ground : {&holes, &level, &over}) {
        const auto whole =
            static_cast<size_t>(std::count_if(ground->slab_of_cell.begin(), ground->slab_of_cell.end(),
                                              [](uint32_t slab) { return slab != k_no_slab; }));
        EXPECT_GT(whole, ground->slab_of_cell.size() / 4);
        EXPECT_LT(whole, ground->slab_of_cell.size());
        EXPECT_LT(ground->slabs.size(), 20u) << "what is one plane in many cells is kept once";
        Ground bare = *ground;
        std::fill(bare.slab_of_cell.begin(), bare.slab_of_cell.end(), k_no_slab);
        int found = 0;
        for (uint32_t i = 0; i < 20000; ++i) {
            const RandomKey key{7, i, 0, Purpose::body};
            const Vec3 p{lerp(ground->low.x - 1, ground->high.x + 1, random_unit(key, 0)),
                         6 * random_unit(key, 1),
                         lerp(ground->low.z - 1, ground->high.z + 1, random_unit(key, 2))};
            const auto is = ground_at(*ground, p, 0.5f, 3), expected = ground_at(bare, p, 0.5f, 3);
            ASSERT_EQ(is.has_value(), expected.has_value()) << p.x << " " << p.y << " " << p.z;
            if (!is) continue;
            ++found;
            EXPECT_NEAR(is->height, expected->height, 1e-4f);
            EXPECT_NEAR(dot(is->normal, expected->normal), 1, 1e-5f);
            EXPECT_EQ(is->kind, expected->kind);
        }
        EXPECT_GT(found, 5000);
    }
}

TEST(Ground, GroundChoosesTheLevelWithinReach) {
    Ground ground = street();
    add_floor(ground, {-5, -8}, {5, 8}, 4, Surface::path);  // a bridge
    index_ground(ground);
    EXPECT_FLOAT_EQ(ground_at(ground, {0, 0, 0})->height, 0);
    EXPECT_EQ(ground_at(ground, {0, 0, 0})->kind, Surface::crossing);
    EXPECT_EQ(ground_at(ground, {0, 4.2f, 0})->kind, Surface::path);
    EXPECT_EQ(ground_at(ground, {0, 8, 0}, 0.5f, 9)->kind, Surface::path);
    EXPECT_FALSE(ground_at(ground, {0, 8, 0}, 0.5f, 3));
    EXPECT_FALSE(ground_at(ground, {0, -1, 0}, 0.5f, 3));
    // On the kerb's edge the upper level is the ground.
    EXPECT_FLOAT_EQ(ground_at(ground, {20, 0, 4})->height, 0.12f);
    EXPECT_EQ(ground_at(ground, {20, 0, 3.99f})->kind, Surface::road);
    EXPECT_FALSE(ground_at(ground, {1000, 0, 0}));
    EXPECT_FALSE(ground_at(ground, {std::nanf(""), 0, 0}));
}

TEST(Ground, RaycastFindsWhatAFullSearchFinds) {
    Ground ground = terrain();
    for (uint32_t i = 0; i < 3000; ++i) {
        Vec3 o{number(i * 7, -5, 45), number(i * 7 + 1, 0.5f, 4), number(i * 7 + 2, -5, 45)};
        Vec3 d = normalize_or(
            {number(i * 7 + 3, -1, 1), number(i * 7 + 4, -0.4f, 0.2f), number(i * 7 + 5, -1, 1)}, {0, 0, 1});
        // March: the first point below ground or behind a wall, to a centimetre.
        auto hit = raycast(ground, o, d, 30);
        float nearest = 30;
        for (const Face& f : ground.faces) {
            Vec2 ab = on_ground(f.b) - on_ground(f.a), ao = on_ground(f.a) - on_ground(o);
            float det = cross(on_ground(d), ab);
            if (std::fabs(det) < 1e-9f) continue;
            float t = cross(ao, ab) / det, s = cross(ao, on_ground(d)) / det, y = o.y + d.y * t;
            if (t >= 0 && s >= 0 && s <= 1 && y >= 0 && y <= 3) nearest = std::min(nearest, t);
        }
        float reach = hit ? hit->distance : 30;
        EXPECT_LE(reach, nearest + 1e-3f) << i;
        if (hit && hit->what == RayHit::What::face) {
            EXPECT_NEAR(reach, nearest, 1e-3f);
        }
        if (hit && hit->what == RayHit::What::ground) {
            Vec3 p = o + d * reach;
            auto under = ground_at(ground, p, 0.1f, 0.1f);
            ASSERT_TRUE(under);
            EXPECT_NEAR(under->height, p.y, 5e-3f);
        }
    }
}

TEST(Ground, ClosestWallFindsWhatAFullSearchFinds) {
    Ground ground = terrain();
    int found = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
        Vec3 p{number(i * 3, 0, 40), number(i * 3 + 1, -1, 5), number(i * 3 + 2, 0, 40)};
        float radius = i % 2 ? 1.0f : 7.0f, nearest = radius;
        bool any = false;
        for (const Face& f : ground.faces) {
            Vec2 a = on_ground(f.a), ab = on_ground(f.b) - a;
            float s = clamp(dot(on_ground(p) - a, ab) / length_squared(ab), 0, 1);
            float d = length(at_height(a + ab * s, clamp(p.y, 0, 3)) - p);
            if (d <= nearest) nearest = d, any = true;
        }
        auto wall = closest_wall(ground, p, radius);
        ASSERT_EQ(wall.has_value(), any);
        if (!wall) continue;
        ++found;
        EXPECT_NEAR(wall->distance, nearest, 1e-4f);
        EXPECT_NEAR(length(wall->point - p), wall->distance, 1e-4f);
        EXPECT_GE(wall->point.y, 0);
        EXPECT_LE(wall->point.y, 3);
        EXPECT_NEAR(length(wall->normal), 1, 1e-5f);
    }
    EXPECT_GT(found, 500);
}

TEST(Ground, WallNormalsPointToTheFreeSide) {
    Ground ground = corridor(10, 2);
    auto wall = closest_wall(ground, {5, 1, -0.8f}, 1);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->normal.z, 1, 1e-6f);
    EXPECT_NEAR(wall->distance, 0.2f, 1e-5f);
    auto hit = raycast(ground, {5, 1, 0}, {0, 0, 1}, 5);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->normal.z, -1, 1e-6f);
    EXPECT_NEAR(hit->distance, 1, 1e-6f);
}

TEST(Ground, SolidsStopRaysAndHands) {
    Ground ground = square(40);
    add_solid_box(ground, {5, 0, -1}, {7, 2, 1});
    index_ground(ground);
    auto hit = raycast(ground, {0, 1, 0}, {1, 0, 0}, 30);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->what, RayHit::What::solid);
    EXPECT_NEAR(hit->distance, 5, 1e-5f);
    EXPECT_NEAR(hit->normal.x, -1, 1e-5f);
    hit = raycast(ground, {0, 1, 0}, {-1, 0, 0}, 30);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->what, RayHit::What::face);
    for (uint32_t i = 0; i < 500; ++i) {
        Vec3 p{number(i * 3, 2, 10), number(i * 3 + 1, -1, 4), number(i * 3 + 2, -4, 4)};
        Vec3 nearest{clamp(p.x, 5, 7), clamp(p.y, 0, 2), clamp(p.z, -1, 1)};
        if (length(p - nearest) == 0) continue;  // inside
        auto wall = closest_wall(ground, p, 2.5f);
        ASSERT_EQ(wall.has_value(), length(p - nearest) <= 2.5f);
        if (!wall) continue;
        EXPECT_NEAR(wall->distance, length(p - nearest), 1e-5f);
        EXPECT_NEAR(length(wall->point - nearest), 0, 1e-4f);
        EXPECT_NEAR(length(wall->normal), 1, 1e-5f);
        EXPECT_EQ(wall->normal.y, 0);
    }
    EXPECT_FALSE(closest_wall(ground, {-6, 1, 1.2f}, 1));
}

TEST(Ground, KerbsStopNeitherRaysNorHands) {
    Ground ground = street();
    EXPECT_FALSE(closest_wall(ground, {20, 0.05f, 3.9f}, 1));
    auto hit = raycast(ground, {20, 0.05f, 0}, {0, 0, 1}, 20);
    EXPECT_FALSE(hit);
}

TEST(Ground, EmptyCityAnswersNothing) {
    Ground ground;
    index_ground(ground);
    EXPECT_FALSE(ground_at(ground, {0, 0, 0}));
    EXPECT_FALSE(raycast(ground, {0, 1, 0}, {0, -1, 0}, 100));
    EXPECT_FALSE(closest_wall(ground, {0, 0, 0}, 100));
}

TEST(Ground, HashSeesEveryArray) {
    Ground ground = street();
    ground.obstacles.push_back({});
    ground.solids.push_back({});
    uint64_t h = hash_ground(ground);
    auto changed = [&](auto change) {
        Ground other = ground;
        change(other);
        return hash_ground(other) != h;
    };
    EXPECT_EQ(hash_ground(Ground(ground)), h);
    EXPECT_TRUE(changed([](Ground& c) { c.vertices[3].y += 0.01f; }));
    EXPECT_TRUE(changed([](Ground& c) { c.kinds[0] = Surface::grass; }));
    EXPECT_TRUE(changed([](Ground& c) { c.faces[1].b_top += 1; }));
    EXPECT_TRUE(changed([](Ground& c) { c.faces[1].kind = FaceKind::garden_wall; }));
    EXPECT_TRUE(changed([](Ground& c) { c.solids[0].b.x = 1; }));
    EXPECT_TRUE(changed([](Ground& c) { c.obstacles[0].yaw = 1; }));
}

// In one square of the grid both are as large.
TEST(Ground, WhatLiesTwiceOnItDoesNotHideAGap) {
    for (const float at : {-1.5f, -0.5f, 0.5f, 1.5f}) {
        Ground ground;
        add_floor(ground, {-10, -10}, {at + 0.1f, 10}, 0, Surface::plaza);
        add_floor(ground, {at, -10}, {at + 0.2f, 10}, 0, Surface::plaza);
        add_floor(ground, {at + 0.3f, -10}, {10, 10}, 0, Surface::plaza);
        index_ground(ground);
        EXPECT_TRUE(ground_at(ground, {at + 0.15f, 0, 0.5f}, 1, 1)) << at;
        EXPECT_FALSE(ground_at(ground, {at + 0.25f, 0, 0.5f}, 1, 1)) << at;
    }
}

}  // namespace
}  // namespace flaneur
