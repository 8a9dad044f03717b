#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/navigation/navmesh.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

NavmeshPtr build(const Ground& ground, int threads = 1) {
    auto mesh = build_navmesh(ground, {}, threads);
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
    return std::move(mesh).value();
}

float number(uint32_t i, float low, float high) {
    return random_between({9, 0, 0, Purpose::city}, low, high, i);
}

float path_length(const Navmesh& mesh, Vec3 from, Vec3 to, Vec3* end = nullptr) {
    auto a = nearest(mesh, 0, from), b = nearest(mesh, 0, to);
    EXPECT_TRUE(a && b);
    Vec3 corners[64];
    int n = find_path(mesh, 0, *a, *b, corners, 64);
    float sum = 0;
    Vec3 at = a->position;
    for (int i = 0; i < n; ++i) {
        sum += length(on_ground(corners[i]) - on_ground(at));
        at = corners[i];
    }
    if (end) *end = at;
    return sum;
}

TEST(Navmesh, KeepsItsDistanceFromWalls) {
    Ground ground = corner(30, 3);
    NavmeshPtr mesh = build(ground);
    auto triangles = navmesh_triangles(*mesh);
    EXPECT_EQ(navmesh_kinds(*mesh).size() * 3, triangles.size());
    ASSERT_GE(triangles.size(), 6u);
    for (Vec3 p : triangles) {
        auto wall = closest_wall(ground, p, 2);
        if (wall) {
            EXPECT_GE(wall->distance, 0.24f) << p.x << " " << p.z;
        }
    }
}

TEST(Navmesh, TrianglesFaceUp) {
    NavmeshPtr mesh = build(corner(30, 3));
    auto t = navmesh_triangles(*mesh);
    for (size_t i = 0; i < t.size(); i += 3) EXPECT_GT(cross(t[i + 1] - t[i], t[i + 2] - t[i]).y, 0);
}

TEST(Navmesh, PathGoesRoundTheCorner) {
    NavmeshPtr mesh = build(corner(30, 3));
    Vec3 end;
    float way = path_length(*mesh, {1, 0, 1.5f}, {28.5f, 0, 28}, &end);
    EXPECT_NEAR(length(on_ground(end) - Vec2{28.5f, 28}), 0, 0.1f);
    EXPECT_GT(way, 51);
    EXPECT_LT(way, 54.5f);
}

TEST(Navmesh, PathPrefersTheCrossing) {
    NavmeshPtr mesh = build(street());
    Vec3 corners[32];
    auto a = nearest(*mesh, 0, {20, 0.12f, -6}), b = nearest(*mesh, 0, {20, 0.12f, 6});
    int n = find_path(*mesh, 0, *a, *b, corners, 32);
    ASSERT_GE(n, 2);
    float least_x = 100;
    for (int i = 0; i < n; ++i) least_x = std::min(least_x, corners[i].x);
    EXPECT_LT(least_x, 2.5f) << "the way does not use the crossing at x = 0";
}

TEST(Navmesh, IsGivenUpWhereProgressSaysSo) {
    int asked = 0;
    auto mesh = build_navmesh(square(200), {}, 2, [&](float) { return ++asked < 2; });
    EXPECT_FALSE(mesh);
    EXPECT_EQ(asked, 2) << "of 25 tiles";
}

// Detour's references hold so many tiles and polygons: wide ground takes larger tiles, and the same from what
// was kept.
TEST(Navmesh, WideGroundTakesFewerTiles) {
    NavmeshSettings coarse;
    coarse.cell = 1, coarse.tile = 8;
    Ground ground = square(800);  // 10,000 tiles of 8 m
    auto mesh = build_navmesh(ground, coarse, 1);
    ASSERT_TRUE(mesh) << mesh.error().message;
    auto tiles = [](const Navmesh& m) {
        std::string bytes = navmesh_bytes(m);
        size_t count = 0;
        for (uint64_t at = 0, size = 0; at < bytes.size(); at += sizeof size + size, ++count)
            std::memcpy(&size, &bytes[at], sizeof size);
        return count;
    };
    Vec2 size = ground.high - ground.low;
    ASSERT_GT(size.x * size.z / 64, 8192);
    EXPECT_LE(tiles(**mesh), 2048u);
    EXPECT_NEAR(path_length(**mesh, {-300, 0, -300}, {300, 0, 300}), 848.5f, 1);
    auto restored = restore_navmesh(ground, coarse, navmesh_bytes(**mesh), 1);
    ASSERT_TRUE(restored);
    EXPECT_NEAR(path_length(**restored, {-300, 0, -300}, {300, 0, 300}), 848.5f, 1);
}

TEST(Navmesh, StepsJoinTheTerrace) {
    NavmeshPtr mesh = build(steps());
    auto low = nearest(*mesh, 0, {0, 0, -10}), high = nearest(*mesh, 0, {0, 1.5f, 8});
    ASSERT_TRUE(low && high);
    EXPECT_EQ(island(*mesh, low->polygon), island(*mesh, high->polygon));
    Vec3 end;
    path_length(*mesh, {0, 0, -10}, {0, 1.5f, 8}, &end);
    EXPECT_NEAR(end.z, 8, 0.1f);
    EXPECT_NEAR(end.y, 1.5f, 0.2f);
}

TEST(Navmesh, StepsJoinTheTerraceForWhoHasNoWheels) {
    const NavmeshPtr mesh = build(steps());
    const auto low = nearest(*mesh, 0, {0, 0, -10}), far = nearest(*mesh, 0, {5, 0, -5}),
               high = nearest(*mesh, 0, {0, 1.5f, 8}), on = nearest(*mesh, 0, {0, 0.75f, 1.6f}, {1, 0.3f, 1});
    ASSERT_TRUE(low && far && high && on);
    ASSERT_EQ(surface_of(*mesh, on->polygon), Surface::steps);
    auto joined = [&](const NavPoint& a, const NavPoint& b, By by) {
        return are_joined(*mesh, a.polygon, b.polygon, by);
    };
    EXPECT_TRUE(joined(*low, *high, By::feet));
    EXPECT_FALSE(joined(*low, *high, By::wheels));
    EXPECT_FALSE(joined(*high, *low, By::wheels));
    EXPECT_TRUE(joined(*low, *far, By::wheels));
    EXPECT_FALSE(joined(*low, *on, By::wheels));
    EXPECT_TRUE(joined(*on, *high, By::wheels)) << "they may be left";
    EXPECT_FALSE(joined(*low, {{}, 0}, By::feet));
}

TEST(Navmesh, GardenWallOnTheGroundDividesIt) {
    Ground ground = square(20);
    add_wall(ground, {-10, 0, 3}, {10, 0, 3}, 0.8f, FaceKind::garden_wall);
    index_ground(ground);
    NavmeshPtr mesh = build(ground);
    auto a = nearest(*mesh, 0, {0, 0, 0}), b = nearest(*mesh, 0, {0, 0, 6});
    ASSERT_TRUE(a && b);
    EXPECT_NE(island(*mesh, a->polygon), island(*mesh, b->polygon));
    EXPECT_EQ(island(*mesh, a->polygon), 0u) << "the larger side comes first";
    EXPECT_FALSE(nearest(*mesh, 0, {0, 0, 3}, {0.1f, 1, 0.1f}));
    for (Vec3 p : navmesh_triangles(*mesh))
        EXPECT_GE(closest_wall(ground, p + Vec3{0, 0.3f, 0}, 99)->distance, 0.24f);
}

// Whether a walker's middle could stand at `p`.
bool can_stand(const Navmesh& mesh, Vec3 p) { return nearest(mesh, 0, p, {0.05f, 1, 0.05f}).has_value(); }

TEST(Navmesh, ObstaclesTakeTheirOutlines) {
    Ground ground = square(30);
    Obstacle car{{0, 0, 0}, 0.7f, {0.9f, 2.15f}}, lamp{{9, 0, 9}, 0, {0.12f, 0.12f}};
    ground.obstacles = {car, lamp};
    NavmeshPtr mesh = build(ground);
    Vec2 ahead = heading_direction(car.yaw), left{ahead.z, -ahead.x}, half = car.half;
    auto beside = [&](float across, float along) { return at_height(left * across + ahead * along, 0); };
    for (float along : {-1.0f, 0.0f, 1.0f}) {
        EXPECT_FALSE(can_stand(*mesh, beside(half.x * along, half.z * along)));
        EXPECT_FALSE(can_stand(*mesh, beside(half.x * 0.9f, half.z * along)));
        EXPECT_FALSE(can_stand(*mesh, beside(-half.x - 0.1f, half.z * along * 0.9f)));
        EXPECT_TRUE(can_stand(*mesh, beside(half.x + 0.7f, half.z * along)));
        EXPECT_TRUE(can_stand(*mesh, beside(-half.x - 0.7f, half.z * along)));
    }
    EXPECT_TRUE(can_stand(*mesh, beside(0, half.z + 0.7f)));
    EXPECT_FALSE(can_stand(*mesh, {9.1f, 0, 9}));
    EXPECT_TRUE(can_stand(*mesh, {9.9f, 0, 9}));
    EXPECT_TRUE(can_stand(*mesh, {9, 0, 8.1f}));
}

TEST(Navmesh, SolidsAreWalkedRound) {
    Ground ground = square(30);
    add_solid_box(ground, {-2, 0, -2}, {2, 3, 2});
    add_solid_box(ground, {-2, 4, 6}, {2, 5, 9});  // overhead
    index_ground(ground);
    NavmeshPtr mesh = build(ground);
    EXPECT_FALSE(can_stand(*mesh, {0, 0, 2.1f}));
    EXPECT_TRUE(can_stand(*mesh, {0, 0, 3}));
    EXPECT_TRUE(can_stand(*mesh, {0, 0, 7.5f}));
    float way = path_length(*mesh, {-6, 0, 0}, {6, 0, 0});
    EXPECT_GT(way, 12.5f);
    EXPECT_LT(way, 15);
}

TEST(Navmesh, BridgesAreLevelsOfTheirOwn) {
    Ground ground = bridge();
    NavmeshPtr mesh = build(ground);
    auto under = nearest(*mesh, 0, {0, 0, 0}), over = nearest(*mesh, 0, {0, 5, 0});
    ASSERT_TRUE(under && over);
    EXPECT_NEAR(under->position.y, 0, 0.2f);
    EXPECT_NEAR(over->position.y, 5, 0.2f);
    EXPECT_NE(under->polygon, over->polygon);
    EXPECT_EQ(island(*mesh, under->polygon), island(*mesh, over->polygon));
    EXPECT_NEAR(path_length(*mesh, {0, 0, -8}, {0, 0, 8}), 16, 0.3f);
    EXPECT_GT(path_length(*mesh, {0, 0, 0}, {0, 5, 0}), 55);
    // Walking along the bridge and below it, one stays on one's level, and never steps off its side.
    for (bool high : {false, true}) {
        NavPoint at = *nearest(*mesh, 0, {-8, high ? 5.0f : 0.0f, 0});
        for (uint32_t i = 0; i < 2000; ++i) {
            Vec2 to{clamp(at.position.x + number(i * 2, -0.5f, 0.5f), -9, 9),
                    at.position.z + number(i * 2 + 1, -0.5f, 0.5f)};
            at = move_along(*mesh, 0, at, at_height(to, at.position.y));
            auto hit = ground_at(ground, at.position, 0.5f, 1.5f);
            ASSERT_TRUE(hit);
            ASSERT_NEAR(hit->height, high ? 5 : 0, 0.05f);
            at.position.y = hit->height;
        }
    }
}

TEST(Navmesh, BytesGiveTheSameMesh) {
    Ground ground = street();
    NavmeshPtr made = build(ground);
    std::string bytes = navmesh_bytes(*made);
    auto again = restore_navmesh(ground, {}, bytes, 1);
    ASSERT_TRUE(again);
    auto a = navmesh_triangles(*made), b = navmesh_triangles(**again);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0);
    for (uint32_t i = 0; i < 50; ++i) {
        float u = number(i, 0, 1);
        NavPoint p = random_place(*made, 0, u, 0.3f, 0.2f), q = random_place(**again, 0, u, 0.3f, 0.2f);
        EXPECT_EQ(p.polygon, q.polygon);
        EXPECT_EQ(p.position.x, q.position.x);
        EXPECT_EQ(island(*made, p.polygon), island(**again, q.polygon));
    }
    EXPECT_FALSE(restore_navmesh(ground, {}, std::string_view(bytes).substr(0, bytes.size() / 2), 1));
    EXPECT_FALSE(restore_navmesh(ground, {}, "", 1));
}

TEST(Navmesh, WaterIsNotWalkedOn) {
    Ground ground = square(20);
    for (size_t i = 0; i < ground.kinds.size(); ++i) ground.kinds[i] = Surface::water;
    auto mesh = build_navmesh(ground, {}, 1);
    ASSERT_FALSE(mesh);
    EXPECT_NE(mesh.error().message.find("no ground"), std::string::npos);
    EXPECT_FALSE(build_navmesh(Ground{}, {}, 2));
}

TEST(Navmesh, MoveAlongNeverLeavesTheMesh) {
    Ground ground = corner(30, 3);
    NavmeshPtr mesh = build(ground);
    NavPoint at = *nearest(*mesh, 0, {15, 0, 1.5f});
    for (uint32_t i = 0; i < 4000; ++i) {
        Vec3 to = at.position + Vec3{number(i * 2, -3, 3), 0, number(i * 2 + 1, -3, 3)};
        at = move_along(*mesh, 0, at, to);
        ASSERT_TRUE(ground_at(ground, at.position));
        ASSERT_GE(closest_wall(ground, at.position, 50)->distance, 0.2f);
    }
}

// Who is said to be on a polygon that lies a little beside it goes on all the same.
TEST(Navmesh, MoveAlongGetsAwayFromBesideItsPolygon) {
    Ground ground = square(60);
    ground.obstacles.push_back({{3, 0, 4}, 0.5f, {2, 1}});
    const NavmeshPtr mesh = build(ground);
    int tried = 0;
    for (int row = 0; row < 20; ++row) {
        std::optional<NavPoint> before;
        for (int k = 0; k < 5000; ++k) {
            const Vec3 p{static_cast<float>(k) * 0.01f - 25, 0, static_cast<float>(row) * 2.4f - 24};
            const auto here = nearest(*mesh, 0, p, {0.05f, 1, 0.05f});
            if (here && before && here->polygon != before->polygon) {
                const Vec3 beside = here->position + Vec3{0.05f, 0, 0};
                const auto there = nearest(*mesh, 0, beside + Vec3{0.03f, 0, 0}, {0.005f, 1, 0.005f});
                if (there && there->polygon == here->polygon) {
                    const NavPoint moved =
                        move_along(*mesh, 0, {beside, before->polygon}, beside + Vec3{0.03f, 0, 0});
                    EXPECT_NEAR(moved.position.x - beside.x, 0.03f, 1e-3f) << p.x << " " << p.z;
                    EXPECT_EQ(moved.polygon, here->polygon);
                    ++tried;
                }
            }
            before = here;
        }
    }
    EXPECT_GT(tried, 20);
}

// As of a house on a slope, whose foot lies as low as the lowest ground at it.
TEST(Navmesh, WallsStopWalkersHoweverDeepTheirFoot) {
    Ground ground = corridor(20, 4);
    add_wall(ground, {10, -6, -2}, {10, -6, 2}, 8);
    index_ground(ground);
    NavmeshPtr mesh = build(ground);
    EXPECT_NE(island(*mesh, nearest(*mesh, 0, {5, 0, 0})->polygon),
              island(*mesh, nearest(*mesh, 0, {15, 0, 0})->polygon));
}

TEST(Navmesh, BordersAreOrientedAndNearestFirst) {
    NavmeshPtr mesh = build(corridor(40, 4));
    Vec3 p{20, 0, 1};
    BorderLine lines[8];
    int n = borders_near(*mesh, p, 4, lines, 8);
    ASSERT_GE(n, 2);
    for (int i = 0; i < n; ++i) {
        EXPECT_GT(cross(on_ground(lines[i].b - lines[i].a), on_ground(p - lines[i].a)), 0);
    }
    EXPECT_GT(lines[0].a.z, 0);
    EXPECT_NEAR(lines[0].a.z - p.z, 0.5f, 0.26f);
    EXPECT_EQ(borders_near(*mesh, p, 0.1f, lines, 8), 0);
}

TEST(Navmesh, ClearViews) {
    NavmeshPtr mesh = build(corner(30, 3));
    EXPECT_TRUE(is_clear(*mesh, {1, 0, 1.5f}, {28.5f, 0, 1.5f}));
    EXPECT_TRUE(is_clear(*mesh, {28.5f, 0, 1.5f}, {28.5f, 0, 28}));
    EXPECT_FALSE(is_clear(*mesh, {1, 0, 1.5f}, {28.5f, 0, 28}));
    EXPECT_FALSE(is_clear(*mesh, {28.5f, 0, 28}, {1, 0, 1.5f}));
    EXPECT_FALSE(is_clear(*mesh, {15, 0, 1.5f}, {15, 0, 3}));
    EXPECT_TRUE(is_clear(*mesh, {15, 0, 1.5f}, {15, 0, 1.5f}));
    // Over the corner's inner border, where the mesh goes on behind.
    const auto border = first_border(*mesh, {25, 0, 1.5f}, {28.5f, 0, 6});
    ASSERT_TRUE(border);
    EXPECT_NEAR(border->a.z, border->b.z, 0.05f) << "the street's that it leaves";
    EXPECT_GT(border->a.z, 2);
    EXPECT_FALSE(first_border(*mesh, {25, 0, 1.5f}, {28.5f, 0, 1.5f}));
    // Along each border line, and from its ends into the mesh.
    BorderLine lines[32];
    int n = borders_near(*mesh, {28, 0, 3}, 20, lines, 32);
    ASSERT_GT(n, 3);
    for (int i = 0; i < n; ++i) EXPECT_TRUE(is_clear(*mesh, lines[i].a, lines[i].b));
}

// From border to border over what a tree takes away.
TEST(Navmesh, NoViewThroughAHole) {
    Ground ground = corridor(20, 6);
    ground.obstacles.push_back({{10, 0, 0}, 0, {0.2f, 0.2f}});
    NavmeshPtr mesh = build(ground);
    BorderLine lines[16];
    int n = borders_near(*mesh, {10, 0, 0}, 1, lines, 16), across = 0;
    ASSERT_GE(n, 4);
    for (int i = 0; i < n; ++i) {
        EXPECT_TRUE(is_clear(*mesh, lines[i].a, lines[i].b));
        for (int k = 0; k < n; ++k) {
            Vec3 from = (lines[i].a + lines[i].b) * 0.5f, to = lines[k].a;
            Vec2 along = normalize_or(on_ground(lines[i].b - lines[i].a), {});
            if (std::fabs(cross(along, on_ground(to - from))) < 0.1f) continue;
            EXPECT_FALSE(is_clear(*mesh, from, to)) << i << " " << k;
            ++across;
        }
    }
    EXPECT_GE(across, 8);
}

TEST(Navmesh, PlacesLieOnThePreferredGround) {
    Ground ground = street();
    NavmeshPtr mesh = build(ground);
    int crossing = 0;
    for (uint32_t i = 0; i < 500; ++i) {
        NavPoint p =
            random_place(*mesh, 0, number(i * 3, 0, 1), number(i * 3 + 1, 0, 1), number(i * 3 + 2, 0, 1));
        ASSERT_NE(p.polygon, 0u);
        auto hit = ground_at(ground, p.position, 0.5f, 1);
        ASSERT_TRUE(hit);
        // Voxels of 0.2 m draw the line between surfaces a little off.
        if (hit->kind == Surface::road) {
            EXPECT_TRUE(std::abs(p.position.z) > 3.5f || std::abs(p.position.x) < 2.5f);
        }
        crossing += hit->kind == Surface::crossing;
        NavPoint near = random_place_near(*mesh, 0, {-30, 6}, 5, number(i, 0, 1), 0.3f, 0.3f);
        ASSERT_NE(near.polygon, 0u);
        EXPECT_LT(near.position.x, 10);
    }
    EXPECT_GT(crossing, 5);
}

TEST(Navmesh, TheSameOnAnyNumberOfThreads) {
    Ground ground = street();
    auto one = navmesh_triangles(*build(ground, 1));
    for (int threads : {2, 7}) {
        auto more = navmesh_triangles(*build(ground, threads));
        ASSERT_EQ(one.size(), more.size());
        EXPECT_EQ(std::memcmp(one.data(), more.data(), one.size() * sizeof one[0]), 0);
    }
}

}  // namespace
}  // namespace flaneur
