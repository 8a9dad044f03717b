// Ways to go without an errand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

WorldPtr world_on(Ground ground, uint32_t capacity, int threads = 1) {
    index_ground(ground);
    WorldOptions options;
    options.capacity = capacity;
    options.threads = threads;
    options.navmesh.agent_radius = 0.2f;
    auto world = make_world_on(ground, options);
    EXPECT_TRUE(world) << (world ? "" : world.error().message);
    return std::move(*world);
}

WalkerId add(World& w, Vec3 place, float speed = 1.3f, float heading = 0) {
    auto id = add_walker(w, {.place = place, .heading = heading, .speed = speed});
    EXPECT_TRUE(id) << (id ? "" : id.error().message);
    return *id;
}

// The place of number `k` in rows of `wide`, from `first` on.
Vec3 in_rows(int k, int wide, float apart, Vec2 first) {
    const int row = k / wide, column = k % wide;
    return at_height(first + Vec2{static_cast<float>(column), static_cast<float>(row)} * apart, 0);
}

Vec2 at(const World& w, WalkerId id) { return on_ground(motion_of(w, id)->position); }
float apart(const World& w, WalkerId a, WalkerId b) { return length(at(w, a) - at(w, b)); }

void run(World& w, float seconds) {
    for (int tick = 0; tick < static_cast<int>(seconds * 60); ++tick) step(w);
}

TEST(ByWay, OneFollowsRoundACornerKeepsItsDistanceAndStandsWhereTheOtherDoes) {
    WorldPtr w = world_on(corner(40, 4), 4);
    const WalkerId ahead = add(*w, {4, 0, 0}, 1.2f), after = add(*w, {1, 0, 0}, 1.4f);
    ASSERT_TRUE(send_to(*w, ahead, {39, 0, 36}));
    ASSERT_TRUE(let_follow(*w, after, ahead, 1.5f));
    float farthest = 0;
    for (int tick = 0; tick < 75 * 60; ++tick) {
        step(*w);
        if (tick > 10 * 60) farthest = std::max(farthest, apart(*w, ahead, after));
    }
    EXPECT_TRUE(has_arrived(*w, ahead));
    EXPECT_LT(farthest, 4);
    EXPECT_NEAR(apart(*w, ahead, after), 1.5f, 0.5f);
    EXPECT_LT(length(motion_of(*w, after)->velocity), 0.05f);
    EXPECT_FALSE(has_arrived(*w, after)) << "it was sent nowhere";
    remove_walker(*w, ahead);
    const Vec2 was = at(*w, after);
    run(*w, 5);
    EXPECT_LT(length(at(*w, after) - was), 0.6f) << "nobody to follow";
}

TEST(ByWay, OneLeadsAtThePaceOfWhoComesAlong) {
    WorldPtr w = world_on(corridor(60, 5), 4);
    const WalkerId guide = add(*w, {3, 0, 0}, 1.7f), guest = add(*w, {1, 0, 0}, 0.8f);
    ASSERT_TRUE(let_lead(*w, guide, guest, {55, 0, 0}, 5));
    ASSERT_TRUE(let_follow(*w, guest, guide));
    float farthest = 0;
    for (int tick = 0; tick < 90 * 60; ++tick)
        step(*w), farthest = std::max(farthest, apart(*w, guide, guest));
    EXPECT_LT(farthest, 7);
    EXPECT_GT(farthest, 4) << "it waits only when it has to";
    EXPECT_NEAR(at(*w, guide).x, 55, 1);
    EXPECT_TRUE(has_arrived(*w, guide));
    EXPECT_FALSE(has_arrived(*w, guest)) << "it was sent nowhere";
    EXPECT_LT(apart(*w, guide, guest), 2);
    EXPECT_FALSE(let_lead(*w, guide, guest, {500, 0, 0})) << "there is no ground";
}

TEST(ByWay, OneFleesToWhereItIsSafeAndNotIntoWalls) {
    for (uint32_t n = 0; n < 20; ++n) {
        WorldPtr w = world_on(square(40), 4);
        const RandomKey key{9, n, 0, Purpose::spawn};
        const WalkerId hare = add(*w, {random_between(key, -12, 12, 0), 0, random_between(key, -12, 12, 1)}),
                       hound = add(*w, {random_between(key, -12, 12, 2), 0, random_between(key, 13, 18, 3)},
                                   1.0f);
        ASSERT_TRUE(let_follow(*w, hound, hare));
        ASSERT_TRUE(let_flee(*w, hare, hound, 6));
        float mean = 0;
        int ticks = 0;
        for (int tick = 0; tick < 60 * 60; ++tick) {
            step(*w);
            ASSERT_FALSE(closest_wall(*w->ground, motion_of(*w, hare)->position, 0.15f))
                << n << " at " << tick;
            if (tick > 15 * 60) mean += apart(*w, hare, hound), ++ticks;
        }
        EXPECT_GT(mean / static_cast<float>(ticks), 4.5f) << n;
    }
    WorldPtr w = world_on(square(60), 4);
    const WalkerId shy = add(*w, {0, 0, 0}), calm = add(*w, {0, 0, 3});
    ASSERT_TRUE(let_flee(*w, shy, calm, 8));
    run(*w, 20);
    EXPECT_GT(apart(*w, shy, calm), 8);
    EXPECT_LT(apart(*w, shy, calm), 13) << "and no farther than it has to";
    EXPECT_LT(length(motion_of(*w, shy)->velocity), 0.05f);
}

// Where nobody is in the way: half as fast again as one likes to walk, on whichever way one is led.
TEST(ByWay, WhoFleesAndWhoFallsBehindGoFasterThanTheyLikeTo) {
    WorldPtr w = world_on(corridor(120, 8), 4);
    const WalkerId hound = add(*w, {2, 0, 0}, 2), hare = add(*w, {6, 0, 0}, 1.2f);
    ASSERT_TRUE(let_follow(*w, hound, hare));
    ASSERT_TRUE(let_flee(*w, hare, hound, 40));
    float fastest = 0, mean = 0;
    for (int tick = 0; tick < 12 * 60; ++tick) {
        step(*w);
        const float speed = length(motion_of(*w, hare)->velocity);
        fastest = std::max(fastest, speed);
        if (tick >= 6 * 60) mean += speed / (6 * 60);
    }
    EXPECT_NEAR(mean, 1.5f * 1.2f, 0.04f);
    EXPECT_LT(fastest, 1.5f * 1.2f + 0.05f);

    w = world_on(corridor(120, 8), 4);
    const WalkerId guide = add(*w, {20, 0, 0}, 1.4f), late = add(*w, {2, 0, 0}, 1.2f);
    ASSERT_TRUE(send_to(*w, guide, {118, 0, 0}));
    ASSERT_TRUE(let_follow(*w, late, guide));
    mean = 0;
    for (int tick = 0; tick < 12 * 60; ++tick) {
        step(*w);
        if (tick >= 6 * 60) mean += length(motion_of(*w, late)->velocity) / (6 * 60);
    }
    EXPECT_NEAR(mean, 1.25f * 1.2f, 0.03f);
}

// Thirty by rays in a walled field with a cube: ten minutes, and nobody meets a wall or somebody else.
TEST(ByWay, ThoseWhoRambleGoOnAndMeetNothing) {
    Ground field = square(40);
    const Vec3 a{4, 0, 4}, b{8, 0, 4}, c{8, 0, 8}, d{4, 0, 8};
    for (const auto& [from, to] : {std::pair{b, a}, {c, b}, {d, c}, {a, d}}) add_wall(field, from, to, 2);
    field.obstacles.push_back({{-8, 0, -6}, 0.4f, {1, 1}});
    WorldPtr w = world_on(std::move(field), 30);
    std::vector<WalkerId> all;
    for (int k = 0; k < 30; ++k) {
        all.push_back(add(*w, in_rows(k, 6, 3, {-16, -15})));
        ASSERT_TRUE(let_ramble(*w, all.back()));
    }
    double way = 0;
    std::vector<float> lows(30, 1e9f), highs(30, -1e9f);
    for (int tick = 0; tick < 600 * 60; ++tick) {
        step(*w);
        if (tick % 6 != 0) continue;
        ASSERT_LT(deepest_overlap(w->crowd), 0.05f);
        for (size_t k = 0; k < all.size(); ++k) {
            const auto m = motion_of(*w, all[k]);
            ASSERT_FALSE(closest_wall(*w->ground, m->position, 0.15f)) << k << " at " << tick;
            way += static_cast<double>(length(m->velocity)) * 0.1;
            lows[k] = std::min(lows[k], m->position.x), highs[k] = std::max(highs[k], m->position.x);
        }
    }
    EXPECT_GT(way / 30 / 600, 1.0) << "metres a second, of 1.3";
    for (size_t k = 0; k < all.size(); ++k) EXPECT_GT(highs[k] - lows[k], 25) << k << " sees the field";
}

// Where no ray of the fan is free, one goes from wall to wall all the same.
TEST(ByWay, ThoseWhoRambleInASmallRoomGoAboutInIt) {
    for (const float size : {2.2f, 3.0f, 4.5f}) {
        WorldPtr w = world_on(square(size), 2);
        const WalkerId id = add(*w, {0.2f, 0, 0.1f}, 1.2f, 0.3f);
        ASSERT_TRUE(let_ramble(*w, id));
        float way = 0, turned = 0, was = 0;
        Vec2 low{9, 9}, high{-9, -9};
        for (int tick = 0; tick < 120 * 60; ++tick) {
            step(*w);
            const auto m = motion_of(*w, id);
            way += length(m->velocity) / 60;
            const float bearing = w->crowd.wayfarers[0].bearing;
            turned += std::fabs(wrap_angle(bearing - was)) > 0.01f, was = bearing;
            low = {std::min(low.x, m->position.x), std::min(low.z, m->position.z)};
            high = {std::max(high.x, m->position.x), std::max(high.z, m->position.z)};
        }
        EXPECT_GT(way / 120, size < 2.5f ? 0.45f : 0.6f) << size << ": metres a second, of 1.2";
        EXPECT_LT(turned, 150) << size << ": in two minutes";
        EXPECT_GT(std::min(high.x - low.x, high.z - low.z), 0.5f * size) << size << ": sees the room";
    }
}

// With a body's own inertia, among others, on a platform that is exchanged.
TEST(ByWay, ThoseWhoStaggerStayOnTheirPlatformAndDoNotGoStraight) {
    WorldPtr w = world_on(square(60), 12);
    std::vector<Vec2> corners{{-8, -5}, {7, -7}, {9, 4}, {0, 9}};
    std::vector<WalkerId> all;
    for (int k = 0; k < 12; ++k) {
        all.push_back(add(*w, in_rows(k, 4, 2, {-3, -2}), 1));
        ASSERT_TRUE(let_stagger(*w, all.back(), corners));
    }
    double way = 0, to_right = 0, to_left = 0;
    int straight = 0, counted = 0;
    std::vector<float> headings(12, 0);
    for (int tick = 0; tick < 240 * 60; ++tick) {
        if (tick == 120 * 60) {
            for (Vec2& c : corners) c = c * 0.8f;
            for (const WalkerId id : all) ASSERT_TRUE(let_stagger(*w, id, corners));
        }
        step(*w);
        const auto platform = make_platform(corners);
        const bool is_new = tick % (120 * 60) < 5 * 60;
        for (size_t k = 0; k < all.size(); ++k) {
            const auto m = motion_of(*w, all[k]);
            if (!is_new) {
                ASSERT_GT(room_at(*platform, on_ground(m->position)), 0) << k << " at " << tick;
            }
            way += static_cast<double>(length(m->velocity)) / 60;
            if (tick % 60 == 0) {
                const float turn = wrap_angle(m->heading - headings[k]);
                headings[k] = m->heading;
                (turn < 0 ? to_right : to_left) += 1;
                straight += std::fabs(turn) < 0.02f, ++counted;
            }
        }
    }
    EXPECT_GT(way / 12 / 240, 0.65) << "metres a second";
    EXPECT_LT(straight, counted / 20);
    EXPECT_NEAR(to_right / (to_right + to_left), 0.5, 0.15) << "to both sides";
    const Vec2 small[] = {{0, 0}, {0.6f, 0}, {0.6f, 0.6f}, {0, 0.6f}};
    EXPECT_FALSE(let_stagger(*w, all[0], small));
}

// Neither for one walker's next way nor for who takes its slot.
TEST(ByWay, ChanceDoesNotBeginAnewWithEachWay) {
    auto made = [] { return world_on(square(12), 2); };
    auto add_one = [](World& w) { return add(w, {0, 0, 0}, 1.2f, 0.5f); };
    const Vec2 corners[] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
    for (const bool staggers : {false, true}) {
        auto begin = [&](World& w, WalkerId id) {
            return staggers ? static_cast<bool>(let_stagger(w, id, corners)) : let_ramble(w, id);
        };
        auto goes_to = [&](World& w, WalkerId id) {
            run(w, 20);
            return at(w, id);
        };
        WorldPtr once = made(), again = made(), anew = made();
        const WalkerId a = add_one(*once), b = add_one(*again);
        ASSERT_TRUE(begin(*once, a));
        ASSERT_TRUE(begin(*again, b));
        ASSERT_TRUE(let_ramble(*again, b));
        ASSERT_TRUE(begin(*again, b));
        remove_walker(*anew, add_one(*anew));
        const WalkerId c = add_one(*anew);
        ASSERT_TRUE(begin(*anew, c));
        EXPECT_EQ(c.index, a.index);
        const Vec2 first = goes_to(*once, a);
        EXPECT_GT(length(goes_to(*again, b) - first), 0.1f) << staggers;
        EXPECT_GT(length(goes_to(*anew, c) - first), 0.1f) << staggers;
    }
}

TEST(ByWay, IsEqualOnAnyThreadsTakenBackAndAfterARemoval) {
    uint64_t expected = 0;
    for (const int threads : {1, 3}) {
        WorldPtr w = world_on(square(50), 20, threads);
        std::vector<WalkerId> all;
        all.reserve(20);
        for (int k = 0; k < 20; ++k) all.push_back(add(*w, in_rows(k, 5, 4, {-8, -6})));
        const Vec2 corners[] = {{-9, -9}, {9, -9}, {0, 9}};
        for (size_t k = 0; k < all.size(); ++k) {
            const WalkerId whom = all[(k + 7) % all.size()];
            if (k % 5 == 0) {
                ASSERT_TRUE(let_follow(*w, all[k], whom));
            }
            if (k % 5 == 1) {
                ASSERT_TRUE(let_lead(*w, all[k], whom, {12, 0, 3}));
            }
            if (k % 5 == 2) {
                ASSERT_TRUE(let_flee(*w, all[k], whom));
            }
            if (k % 5 == 3) {
                ASSERT_TRUE(let_ramble(*w, all[k]));
            }
            if (k % 5 == 4) {
                ASSERT_TRUE(let_stagger(*w, all[k], corners));
            }
        }
        run(*w, 5);
        remove_walker(*w, all[7]);
        EXPECT_EQ(w->crowd.wayfarers.size(), 19u);
        std::vector<std::byte> bytes;
        save_state(*w, bytes);
        run(*w, 8);
        const uint64_t hash = hash_world(*w);
        if (expected == 0) expected = hash;
        EXPECT_EQ(hash, expected) << threads;
        ASSERT_TRUE(load_state(*w, bytes));
        run(*w, 8);
        EXPECT_EQ(hash_world(*w), expected) << threads << ", taken back";
    }
}

// What goes ahead of one keeps off walls, off whom one follows and on its platform.
TEST(ByWay, PramsHaveRoomOnAnyWay) {
    Ground field = square(24);
    index_ground(field);
    WorldOptions options;
    options.capacity = 3;
    options.threads = 1;
    Kind pushes{standard_body(1.7f)};
    pushes.body.pram = standard_pram(pushes.body);
    options.kinds = {Kind{standard_body(1.7f)}, pushes};
    const Vec2 corners[] = {{-6, -6}, {6, -6}, {6, 6}, {-6, 6}};
    for (const int way : {0, 1, 2}) {
        auto made = make_world_on(field, options);
        ASSERT_TRUE(made) << made.error().message;
        World& w = **made;
        const auto id = add_walker(w, {.place = Vec3{1, 0, 1}, .kind = 1, .speed = 1.2f}),
                   other = add_walker(w, {.place = Vec3{8, 0, 1}, .kind = 0, .speed = 1.0f});
        ASSERT_TRUE(id && other);
        if (way == 0) {
            ASSERT_TRUE(let_ramble(w, *id));
        } else if (way == 1) {
            ASSERT_TRUE(let_stagger(w, *id, corners));
        } else {
            ASSERT_TRUE(let_follow(w, *id, *other, 1));
        }
        const auto platform = make_platform(corners);
        float went = 0, least_room = 9, nearest_wall = 9;
        for (int tick = 0; tick < 120 * 60; ++tick) {
            step(w);
            const auto m = motion_of(w, *id);
            const Vec2 pram =
                on_ground(m->position) + heading_direction(m->heading) * w.crowd.identity.ahead[id->index];
            went += length(m->velocity) / 60;
            if (tick > 10 * 60) least_room = std::min(least_room, room_at(*platform, pram));
            nearest_wall = std::min(nearest_wall, 12 - std::max(std::fabs(pram.x), std::fabs(pram.z)));
        }
        const Vec2 between = at(w, *other) - at(w, *id);
        EXPECT_GT(nearest_wall, 1.3f) << way;
        if (way == 1) {
            EXPECT_GT(least_room, 0.2f) << "all of it is on the platform";
        }
        if (way == 2) {
            EXPECT_NEAR(length(between), w.crowd.identity.ahead[id->index] + 1, 0.15f);
        } else {
            EXPECT_GT(went / 120, 0.65f) << way << ": metres a second, of 1.2";
        }
    }
}

TEST(ByWay, WhoIsLetGoAsksForAPathOnlyToGoByOne) {
    WorldPtr w = world_on(square(20), 3);
    const WalkerId one = add(*w, {-5, 0, -5});
    ASSERT_TRUE(let_ramble(*w, one));
    drive(w->crowd, one.index);
    run(*w, 1);
    let_go(w->crowd);
    EXPECT_EQ(w->crowd.journeys[one.index].path_due, PathDue::no) << "it goes by none";
    ASSERT_TRUE(send_to(*w, one, {5, 0, 5}));
    run(*w, 1);
    drive(w->crowd, one.index);
    let_go(w->crowd);
    EXPECT_EQ(w->crowd.journeys[one.index].path_due, PathDue::to_goal) << "it does";
}

TEST(ByWay, WhatCannotBeIsRefused) {
    WorldPtr w = world_on(square(20), 3);
    const WalkerId a = add(*w, {0, 0, 0}), b = add(*w, {3, 0, 0});
    EXPECT_FALSE(let_follow(*w, a, a));
    EXPECT_FALSE(let_follow(*w, a, b, 0));
    EXPECT_FALSE(let_flee(*w, a, b, std::nanf("")));
    EXPECT_FALSE(let_lead(*w, a, b, {1, 0, 1}, 1000));
    EXPECT_TRUE(has_arrived(*w, a)) << "what is refused changes nothing";
    EXPECT_FALSE(let_stagger(*w, a, {}));
    const Vec2 away[] = {{40, 40}, {50, 40}, {50, 50}, {40, 50}};
    EXPECT_FALSE(let_stagger(*w, a, away)) << "there is no ground";
    const Vec2 half[] = {{0, 0}, {15, 0}, {15, 5}, {0, 5}};
    EXPECT_FALSE(let_stagger(*w, a, half)) << "half of it is behind a wall";
    EXPECT_TRUE(has_arrived(*w, a)) << "what is refused changes nothing";
    remove_walker(*w, b);
    EXPECT_FALSE(let_follow(*w, a, b));
    EXPECT_FALSE(let_ramble(*w, b));
    ASSERT_TRUE(let_ramble(*w, a));
    ASSERT_TRUE(let_wander(*w, a));
    EXPECT_TRUE(w->crowd.wayfarers.empty()) << "it goes about its errands again";
}

}  // namespace
}  // namespace flaneur
