// Balls that are thrown: how they fly, and whom they push.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim/ball/ball.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/fields.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr auto k_thrown = Purpose::city;  // of chances that only this file takes

TEST(Balls, PassWhatTheyAreThrownAt) {
    for (uint32_t n = 0; n < 200; ++n) {
        auto number = [&](uint32_t k, float low, float high) {
            return random_between({5, n, k, k_thrown}, low, high);
        };
        const Vec3 from{0, number(0, 1, 4), 0}, at{number(1, -9, 9), number(2, 0.5f, 3), number(3, -9, 9)};
        const PlannedThrow how{.from = from, .at = at, .speed = number(4, 14, 30)};
        const Ball ball = thrown(how);
        ASSERT_NEAR(length(ball.velocity), how.speed, 1e-3f);
        const Vec3 way = at - from;
        const float far = length(on_ground(way)), level = length(on_ground(ball.velocity));
        const float t = level > 0 ? far / level : 0;
        const Vec3 there = from + ball.velocity * t - Vec3{0, 0.5f * k_gravity * t * t, 0};
        ASSERT_LT(length(there - at), 0.02f) << n;
    }
}

TEST(Balls, BounceLowerEachTimeAndComeToRestOnTheGround) {
    const Ground ground = square(60);
    const Surroundings around = surroundings_of(ground);
    for (uint32_t n = 0; n < 30; ++n) {
        Ball ball = thrown({.from = {0, 1.5f, 0},
                            .at = {random_between({6, n, 0, k_thrown}, -8, 8), 1, 5},
                            .speed = random_between({6, n, 1, k_thrown}, 2, 16)});
        float energy = 1e9f;
        for (int tick = 0; tick < 30 * 60; ++tick) {
            step_balls({&ball, 1}, ground, around, k_tick);
            ASSERT_GE(ball.place.y, ball.radius - 1e-3f) << n << " at " << tick;
            const float now = 0.5f * dot(ball.velocity, ball.velocity) + k_gravity * ball.place.y;
            // A tick of gravity is worked in whole.
            ASSERT_LE(now, energy + 0.05f) << n << " at " << tick;
            energy = now;
        }
        EXPECT_LT(length(ball.velocity), 0.05f) << n;
        EXPECT_NEAR(ball.place.y, ball.radius, 2e-3f) << n;
    }
}

TEST(Balls, GoThroughNoWall) {
    const Ground ground = square(8);
    const Surroundings around = surroundings_of(ground);
    for (uint32_t n = 0; n < 100; ++n) {
        const float yaw = random_between({7, n, 0, k_thrown}, -3, 3);
        Ball ball = thrown({.from = {0, 1, 0},
                            .at = at_height(heading_direction(yaw) * 5, 1),
                            .speed = random_between({7, n, 1, k_thrown}, 14, 40)});
        for (int tick = 0; tick < 10 * 60; ++tick) {
            step_balls({&ball, 1}, ground, around, k_tick);
            ASSERT_LT(std::max(std::fabs(ball.place.x), std::fabs(ball.place.z)), 4 + 1e-3f)
                << n << " at " << tick;
        }
    }
}

// What the first of so many who stand there, hit by a ball of `mass` at `height` from yaw `from`, does.
struct Told {
    bool was_hit = false, fell = false;
};
Told hit_once(float mass, float speed, float height, float from, uint64_t seed = 1) {
    WorldOptions options;
    options.walkers = 1;
    options.seed = seed;
    auto made = make_world(std::make_shared<Ground>(square(40)), options);
    EXPECT_TRUE(made);
    World& w = **made;
    EXPECT_TRUE(send_to(w, {0, 0}, w.crowd.motion.position[0]));
    for (int tick = 0; tick < 120; ++tick) step(w);
    const Vec3 at = w.crowd.motion.position[0] + Vec3{0, height, 0};
    throw_ball(w, thrown({.from = at + at_height(heading_direction(from) * 3, 0),
                          .at = at,
                          .speed = speed,
                          .mass = mass}));
    Told told;
    for (int tick = 0; tick < 240; ++tick) {
        step(w);
        told.was_hit |= !w.falls.all.empty();
        told.fell |= has_fallen(w, {0, 0});
    }
    return told;
}

TEST(Balls, PushWhomTheyHitTheMoreTheHeavierAndTheHigher) {
    for (int k = 0; k < 6; ++k) {
        const float from = static_cast<float>(k);
        EXPECT_TRUE(hit_once(4, 9, 1.2f, from).was_hit) << k;
        EXPECT_FALSE(hit_once(0.4f, 12, 1.2f, from).fell) << k;
        EXPECT_TRUE(hit_once(16, 14, 1.3f, from).fell) << k;
        EXPECT_FALSE(hit_once(12, 9, 0.15f, from).fell) << k;
        // Monotone in mass.
        bool has_fallen = false;
        for (const float mass : {1.0f, 3.0f, 5.0f, 8.0f, 12.0f, 18.0f}) {
            const bool falls = hit_once(mass, 10, 1.25f, from).fell;
            EXPECT_TRUE(falls || !has_fallen) << mass << " kg from " << from;
            has_fallen |= falls;
        }
        EXPECT_TRUE(has_fallen) << k;
    }
}

TEST(Balls, AreTheSameOnAnyThreadsAndFromASavedStateAndAllocateNothing) {
    auto make = [](int threads) {
        WorldOptions options;
        options.walkers = 60;
        options.threads = threads;
        for (uint32_t n = 0; n < 40; ++n)
            options.throws.push_back({.tick = 20 + 7 * n,
                                      .from = {-8, 1.6f, static_cast<float>(n % 9) - 4},
                                      .at = {0, 1.2f, 0},
                                      .speed = 12});
        return std::move(make_world(std::make_shared<Ground>(square(24)), options)).value();
    };
    const auto a = make(1), b = make(3);
    std::vector<std::byte> saved;
    for (int tick = 0; tick < 500; ++tick) {
        if (tick == 150) save_state(*a, saved);
        step(*a), step(*b);
    }
    EXPECT_EQ(a->balls.all.size(), k_most_balls);
    EXPECT_EQ(hash_world(*a), hash_world(*b));
    ASSERT_TRUE(load_state(*b, saved));
    while (b->tick < a->tick) step(*b);
    EXPECT_EQ(hash_world(*a), hash_world(*b));
    const auto c = make(1);
    for (int tick = 0; tick < 10; ++tick) step(*c);
    const size_t before = allocations();
    for (int tick = 0; tick < 300; ++tick) step(*c);
    EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace flaneur
