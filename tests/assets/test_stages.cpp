// Places that are no cities.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/additions.h"
#include "assets/scene.h"
#include "assets/stages/dais.h"
#include "assets/stages/gallery.h"
#include "assets/stages/platform.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/rng.h"
#include "sim/ways/platform.h"

namespace flaneur {
namespace {

// A convex outline of any size and turn.
std::vector<Vec2> random_outline(RandomKey key) {
    const auto corners = static_cast<uint32_t>(3 + 13 * random_unit(key, 0));
    const float size = random_between(key, 3, 100, 1), turn = 2 * k_pi * random_unit(key, 2);
    const float flat = random_between(key, 0.3f, 1, 3);
    std::vector<Vec2> outline;
    for (uint32_t k = 0; k < corners; ++k) {
        const float apart = 2 * k_pi / static_cast<float>(corners);
        const SinCos at = sin_cos((static_cast<float>(k) + 0.7f * random_unit(key, 10 + k)) * apart),
                     to = sin_cos(turn);
        const Vec2 p = Vec2{at.cosine, at.sine * flat} * size;
        outline.push_back({p.x * to.cosine - p.z * to.sine, p.x * to.sine + p.z * to.cosine});
    }
    if (random_unit(key, 4) < 0.5f) std::reverse(outline.begin(), outline.end());
    return outline;
}

TEST(PlatformStage, IsGroundWithinItsOutlineAndWaterBesideIt) {
    for (uint32_t n = 0; n < 60; ++n) {
        const RandomKey key{7, n, 0, Purpose::city};
        const std::vector<Vec2> outline = random_outline(key);
        const Result<City> city = build_platform(outline);
        ASSERT_TRUE(city) << city.error().message << " " << told_corners(outline);
        const Result<Platform> platform = make_platform(outline);
        ASSERT_TRUE(platform);
        for (uint32_t k = 0; k < 200; ++k) {
            const Vec2 p =
                Vec2{random_unit(key, 100 + 2 * k) - 0.5f, random_unit(key, 101 + 2 * k) - 0.5f} * 230;
            const float room = room_at(*platform, p);
            if (std::fabs(room) < 0.01f) continue;
            const auto hit = ground_at(city->ground, at_height(p, 0.1f), 0.5f, 2);
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->kind, room > 0 ? Surface::plaza : Surface::water) << told_corners(outline);
            EXPECT_GT(hit->normal.y, 0.99f);
        }
        // Its sides look outward.
        const Scenery& sides = city->scenery;
        for (size_t t = 0; t < sides.indices.size(); t += 3) {
            const Vec3 a = sides.vertices[sides.indices[t]].position,
                       b = sides.vertices[sides.indices[t + 1]].position,
                       c = sides.vertices[sides.indices[t + 2]].position;
            const Vec2 outward = on_ground(normalize_or(cross(b - a, c - a), {0, 1, 0}));
            EXPECT_LT(room_at(*platform, on_ground(a + b + c) / 3 + outward * 0.1f), 0)
                << told_corners(outline);
        }
    }
}

TEST(PlatformStage, RefusesWhatIsNotConvex) {
    EXPECT_FALSE(build_platform(std::vector<Vec2>{{0, 0}, {8, 0}, {1, 1}, {0, 8}}));
}

TEST(PlatformStage, MayHaveCornersMidwayOnAnEdge) {
    for (const std::vector<Vec2>& outline : {std::vector<Vec2>{{0, 0}, {3, 0}, {6, 0}, {6, 6}, {0, 6}},
                                             {{0, 0}, {0, 1}, {0, 4}, {0, 6}, {6, 6}, {6, 0}}}) {
        const Result<City> city = build_platform(outline);
        ASSERT_TRUE(city) << city.error().message;
        for (float x = -0.95f; x < 7; x += 0.3f)
            for (float z = -0.95f; z < 7; z += 0.3f) {
                const auto hit = ground_at(city->ground, {x, 0.1f, z}, 0.5f, 2);
                ASSERT_TRUE(hit);
                const bool is_on = std::min(x, z) > 0 && std::max(x, z) < 6;
                EXPECT_EQ(hit->kind, is_on ? Surface::plaza : Surface::water) << x << "," << z;
            }
        const auto read = parse_platform(told_corners(outline));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, outline) << "as it was written";
    }
}

TEST(PlatformStage, NothingIsPutIntoTheWater) {
    struct Case {
        Addition added;
        bool is_good;
    };
    const Case cases[] = {{{AddedKind::bench, {1, 0, 1}, {}, 0}, true},
                          {{AddedKind::bench, {30, 0, 0}, {}, 0}, false},
                          {{AddedKind::wall, {-2, 0, 0}, {3, 0, 0}, 0}, true},
                          {{AddedKind::wall, {0, 0, 0}, {20, 0, 0}, 0}, false},
                          {{AddedKind::wall, {20, -0.55f, 0}, {0, 0, 0}, 0}, false},
                          {{AddedKind::barrier, {30, -0.55f, 0}, {40, -0.55f, 0}, 0}, false}};
    for (const Case& c : cases) {
        City city = *build_platform(k_usual_platform);
        const Result<void> done = add_to_city(city, {&c.added, 1});
        EXPECT_EQ(static_cast<bool>(done), c.is_good) << c.added.at.x;
        if (!done) {
            EXPECT_NE(done.error().message.find("in the water: "), std::string::npos) << done.error().message;
        }
    }
}

TEST(PlatformStage, OutlinesAreReadAndTold) {
    const std::vector<Vec2> outline{{-8, -5.5f}, {8, -5}, {0, 9}};
    EXPECT_EQ(told_corners(outline), "-8,-5.5 8,-5 0,9");
    EXPECT_EQ(*parse_platform("-8,-5.5  8,-5 0,9 "), outline);
    for (const char* text :
         {"", "1", "1,2", "0,0 1,0 0,1,", "0,0 1,0 0,1 x", "0,0;1,0;0,1", "0,0 1e9,0 0,1", "0,0 nan,0 0,1"})
        EXPECT_FALSE(parse_platform(text)) << text;
    // Faults of scenes end without a full stop of their own.
    for (const char* text :
         {"0,0 8,0 1,1 0,8", "0,0 6,0 6,0 0,6", "0,0 1,0", "0,0 1,0 2,0", "0,0 800,0 1,1"}) {
        const auto refused = parse_platform(text);
        ASSERT_FALSE(refused) << text;
        EXPECT_NE(refused.error().message.back(), '.') << refused.error().message;
    }
}

// For a minute. The tree by chance has too many tips to be with all of them where they are led.
std::vector<Kind> man_and_woman() { return {{standard_body(1.78f)}, {standard_body(1.66f), 1, 30, true}}; }

// What a body's figure and its twin do with the ground and the walls of the dais.
struct Shown {
    float in_ground = 0, over_ground = 0;  // metres of a sole that stands
    float reach = 0;                       // of a hand, at most
    float on_wall = 9;                     // metres from the palm to the wall, least
};
Shown watch(const Troupe& f, size_t i, Shown shown) {
    const uint32_t twin = f.plans[i].twin_of;
    const size_t walker = twin == k_no_twin ? i : twin;
    const GaitBlock& gait = f.gait.blocks[walker / k_block];
    const size_t lane = walker % k_block;
    for (const Side side : {k_left, k_right}) {
        if (gait.feet[side].swinging[lane] == 0) {
            const Sole s = sole(f.poses, f.gait, i, side);
            const auto under = ground_at(*f.ground, s.ball, 0.5f, 1);
            if (!under) continue;
            const auto under_heel = ground_at(*f.ground, s.heel, 0.5f, 1);
            const float low = std::min(s.ball.y - under->height, s.tip.y - under->height),
                        heel = under_heel ? s.heel.y - under_heel->height : low;
            shown.in_ground = std::max({shown.in_ground, -low, -heel});
            shown.over_ground = std::max(shown.over_ground, std::min(low, heel));
        }
        shown.reach = std::max(shown.reach, gait.hands[side].reach[lane]);
        const Vec3 hand = joint_pose(f.poses, i, side == k_left ? left_hand : right_hand).position;
        if (const auto wall = closest_wall(*f.ground, hand, 1))
            shown.on_wall = std::min(shown.on_wall, wall->distance);
    }
    return shown;
}

// Each pair: with the technique it does what its label says, and without it does not.
TEST(GalleryStage, FiguresStandOnWhatIsThereAndTouchItAndTheirTwinsDoNot) {
    const std::vector<Kind> kinds = man_and_woman();
    Troupe f =
        make_figures(make_figure_plans(kinds), make_figure_ground(), {kinds[0].body, kinds[1].body}, 1);
    std::vector<Shown> shown(f.plans.size());
    for (uint32_t tick = 0; tick < 3600; ++tick) {
        step_figures(f, 1, tick);
        for (size_t i = 0; i < shown.size(); ++i) shown[i] = watch(f, i, shown[i]);
    }
    for (const size_t pair : {0u, 2u, 4u}) {
        EXPECT_LT(shown[pair].in_ground, 0.09f) << f.plans[pair].name;
        EXPECT_GT(shown[pair + 1].in_ground, shown[pair].in_ground + 0.04f) << f.plans[pair].name;
    }
    for (const size_t pair : {6u, 8u}) {
        EXPECT_GT(shown[pair].reach, 0.99f) << f.plans[pair].name;
        EXPECT_LT(shown[pair].on_wall, 0.13f) << f.plans[pair].name << ", wrist to wall";
    }
    float turns[2] = {0, 0};
    for (uint32_t tick = 3600; tick < 4800; ++tick) {
        step_figures(f, 1, tick);
        for (size_t i = 0; i < 2; ++i) {
            const Quat facing = joint_pose(f.poses, 10 + i, head).rotation;
            turns[i] = std::max(turns[i], std::fabs(rotate(facing, {0, 0, 1}).x));
        }
    }
    EXPECT_GT(turns[0], 0.3f) << "looks about";
    EXPECT_LT(turns[1], 0.15f);
    // Nobody leaves its way, and nobody comes into another's.
    for (size_t i = 0; i < f.plans.size(); ++i) {
        float near = 9;
        for (const Vec2 corner : f.plans[i].way)
            near = std::min(near, length(corner - on_ground(f.moves[i].position - f.plans[i].aside)));
        EXPECT_LT(near, 1.8f) << f.plans[i].name;
    }
}

TEST(GalleryStage, NothingIsPutIntoItsPlinthsNorIntoEachOther) {
    const City hall = build_gallery(1);
    auto put = [&](std::vector<Addition> added) {
        City city = hall;
        return static_cast<bool>(add_to_city(city, added));
    };
    using enum AddedKind;
    for (const AddedKind kind : {planter, tree, bench, lamp}) {
        EXPECT_FALSE(put({{kind, {0, 0, 1.6f}, {}, 0}})) << "in the middle of a plinth";
        EXPECT_FALSE(put({{kind, {0.38f, 0, 1.9f}, {}, 30}})) << "in its corner";
        EXPECT_TRUE(put({{kind, {0, 0, 5}, {}, 0}}));
        EXPECT_FALSE(put({{kind, {0, 0, 5}, {}, 0}, {planter, {0.05f, 0, 5}, {}, 0}}));
        EXPECT_TRUE(put({{kind, {0, 0, 5}, {}, 0}, {planter, {2.5f, 0, 5}, {}, 0}}));
    }
}

TEST(GalleryStage, WhatItShowsReachesItsTargets) {
    constexpr float k_near = 0.005f, k_near_of_tree = 0.15f;
    Linkages linkages = make_linkages(make_exhibits(1));
    ASSERT_EQ(linkages.all.size(), 11u);
    WorkersPtr workers = make_workers(2);
    std::vector<float> worst(linkages.all.size());
    for (uint32_t tick = 0; tick < 3600; ++tick) {
        step_linkages(linkages, *workers, tick);
        for (size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], linkages.solved[i].off);
    }
    for (size_t i = 0; i < worst.size(); ++i)
        EXPECT_LT(worst[i], linkages.all[i].leads.size() > 8 ? k_near_of_tree : k_near)
            << linkages.all[i].name;
}

}  // namespace
}  // namespace flaneur
