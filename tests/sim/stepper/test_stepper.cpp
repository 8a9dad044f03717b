// The rule of steps, on ground made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/stepper/own.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// Some who go to and fro on a floor with rubble and a plate that rises and sinks.
struct Walked {
    Ground ground;
    Movers movers;
    MovingGround both;
    Gait gait;
    Bipeds bipeds;
    WorkersPtr workers = make_workers(1);
    uint32_t tick = 0;
};

std::unique_ptr<Walked> walked(uint64_t seed, size_t count) {
    auto w = std::make_unique<Walked>();
    add_floor(w->ground, {-12, -4}, {12, 4}, 0, Surface::plaza);
    for (uint32_t n = 0; n < 8; ++n) {
        const RandomKey key{seed, n, 0, Purpose::city};
        const float x = -5 + 0.6f * static_cast<float>(n);
        add_floor(w->ground, {x, -3}, {x + 0.6f, 3}, random_between(key, 0.02f, 0.16f), Surface::plaza);
    }
    index_ground(w->ground);
    Mover plate;
    plate.solids = {{.half = {0.8f, 0.03f, 3}}};
    plate.place = {.middle = {3, 0.1f, 0}, .reach = {0, 0.08f, 0}, .period = {1, 400, 1}};
    w->movers = make_movers({plate});
    w->both = {&w->ground, &w->movers};
    std::vector<Body> bodies;
    std::vector<uint32_t> body;
    std::vector<BipedWay> ways;
    for (size_t i = 0; i < count; ++i) {
        const float z = -2.5f + static_cast<float>(i);
        bodies.push_back(standard_body(1.3f + 0.1f * static_cast<float>(i)));
        body.push_back(static_cast<uint32_t>(i));
        ways.push_back(make_way({{-10, z}, {10, z}}));
    }
    const std::vector<float> ones(count, 1.0f), none(count, 0.0f);
    const std::vector<Vec3> places(count, Vec3{-10, 0, 0});
    const std::vector<Vec2> still(count);
    start_gait(w->gait, count, bodies, body.data(), ones.data(),
               {places.data(), still.data(), none.data(), none.data()}, surroundings_of(w->both), seed);
    SetDown made = make_bipeds(std::move(ways), body, ones, false, w->both, w->gait, seed);
    EXPECT_EQ(made.placed, count);
    w->bipeds = std::move(made.bipeds);
    return w;
}

void step(Walked& w) {
    step_movers(w.movers, w.tick);
    step_bipeds(w.bipeds, w.both, w.gait, *w.workers, 1, w.tick);
    ++w.tick;
}

TEST(Bipeds, AFootStaysUntilItsPlaceIsOutOfReachAndTheFartherStepsFirst) {
    for (const uint64_t seed : {1u, 2u, 3u, 4u}) {
        auto w = walked(seed, 6);
        int steps = 0, farther = 0;
        for (int n = 0; n < 2400; ++n) {
            const std::vector<Biped> before = w->bipeds.all;
            float away[6][2];
            for (size_t i = 0; i < 6; ++i)
                for (const Side side : {k_left, k_right})
                    away[i][side] = off_wanted(w->bipeds, w->gait, i, side);
            step(*w);
            for (size_t i = 0; i < 6; ++i) {
                const Biped &was = before[i], &is = w->bipeds.all[i];
                ASSERT_TRUE(is.swings <= 2);
                // One is down whatever happens: from one in the air it goes to none.
                ASSERT_FALSE(was.swings != is.swings && was.swings != k_both_down &&
                             is.swings != k_both_down);
                if (was.swings != k_both_down || is.swings == k_both_down) continue;
                ++steps;
                farther += away[i][is.swings] + 0.04f >= away[i][1 - is.swings];
                // Who turns steps for the ball of the foot.
                if (std::fabs(is.turn_rate) > 0.02f) continue;
                ASSERT_GT(away[i][is.swings], 0.6f * is.reach) << i << " at " << w->tick;
            }
        }
        EXPECT_GT(steps, 250);
        EXPECT_GE(farther, steps * 97 / 100);
    }
}

TEST(Bipeds, TicksAllocateNothing) {
    auto w = walked(5, 6);
    for (int n = 0; n < 200; ++n) step(*w);
    const auto before = allocations();
    for (int n = 0; n < 600; ++n) step(*w);
    EXPECT_EQ(allocations(), before);
}

TEST(Bipeds, TheRayGoesFromFiveAboveToTwelveBelow) {
    Ground ground;
    add_floor(ground, {-5, -5}, {5, 5}, 0, Surface::plaza);
    add_floor(ground, {-1, -1}, {1, 1}, 3, Surface::plaza);
    add_floor(ground, {2, 2}, {4, 4}, 0.1f, Surface::water);
    index_ground(ground);
    const Movers none = make_movers({});
    const MovingGround both{&ground, &none};
    const Surroundings around = surroundings_of(both);
    const StandingOn on{both, around, 0};
    EXPECT_EQ(ray_down(on, {-3, 0}, 0.1f, 0.9f)->y, 0);
    EXPECT_EQ(ray_down(on, {0, 0}, 0.1f, 0.9f)->y, 0) << "under a roof";
    EXPECT_EQ(ray_down(on, {0, 0}, 2.9f, 0.9f)->y, 3);
    EXPECT_FALSE(ray_down(on, {0, 0}, 1.9f, 0.9f)) << "neither up a ledge nor down from one";
    EXPECT_FALSE(ray_down(on, {3, 3}, 0, 0.9f)) << "into water";
    EXPECT_FALSE(ray_down(on, {7, 0}, 0, 0.9f)) << "where there is nothing";
}

TEST(Bipeds, WaysAreClosed) {
    const BipedWay way = make_way({{0, 0}, {4, 0}, {4, 3}});
    EXPECT_FLOAT_EQ(way.along.back(), 12);
    for (float along = -20; along < 40; along += 0.37f) {
        const WayPoint at = point_on(way, along), later = point_on(way, along + 12);
        ASSERT_LT(length(at.place - later.place), 1e-4f);
        ASSERT_NEAR(length(at.ahead), 1, 1e-5f);
        const float back = nearest_along(way, at.place),
                    off = std::fabs(wrap_angle((back - along) * k_pi / 6));
        ASSERT_LT(off, 1e-3f) << along;
    }
}

}  // namespace
}  // namespace flaneur
