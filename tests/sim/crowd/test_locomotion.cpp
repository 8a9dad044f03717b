// A walker without feet, as its wish changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/locomotion.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

using Wish = std::function<Vec2(float)>;  // at a time, m/s

std::vector<Motion> drive(Motion m, float seconds, const Wish& wish, const GroundHit& under = {}) {
    std::vector<Motion> all;
    for (float t = 0; t < seconds; t += k_tick)
        all.push_back(m = next_motion(m, wish_on(under, wish(t)), k_tick));
    return all;
}

// Seconds until `holds` for good.
float settles(const std::vector<Motion>& all, const std::function<bool(const Motion&)>& holds) {
    size_t k = all.size();
    while (k > 0 && holds(all[k - 1])) --k;
    return static_cast<float>(k) * k_tick;
}

TEST(Locomotion, StartsWithinThreeStepsAndStopsWithinTwo) {
    for (float speed : {0.95f, 1.3f, 1.5f}) {
        auto start = drive({}, 4, [&](float) { return Vec2{0, speed}; });
        float until = settles(start, [&](const Motion& m) { return length(m.velocity) > 0.9f * speed; });
        EXPECT_GT(until, 0.4f);
        EXPECT_LT(until, 1.2f);
        auto stop = drive(start.back(), 4, [](float) { return Vec2{}; });
        until = settles(stop, [](const Motion& m) { return length(m.velocity) < 0.05f; });
        EXPECT_GT(until, 0.3f);
        EXPECT_LT(until, 1.2f);
    }
}

TEST(Locomotion, BrakesOverTheFootThatHasComeDown) {
    Motion m{.velocity = {0, 1.3f}, .aim = {0, 1.3f}};
    for (int ticks_left = 20; ticks_left > 0; --ticks_left) {
        m.feet.lands = static_cast<float>(ticks_left) * k_tick;
        m = next_motion(m, {}, k_tick);
        if (ticks_left <= 2) continue;
        ASSERT_FLOAT_EQ(length(m.velocity), 1.3f) << ticks_left;
        ASSERT_FLOAT_EQ(length(m.aim), 1.3f) << "so far feet go on too";
    }
    EXPECT_LT(length(m.velocity), 1.3f);
    // The other foot leaves the ground meanwhile.
    m.feet.lands = 0.4f;
    EXPECT_LT(length(next_motion(m, {}, k_tick).velocity), length(m.velocity));
    // Who slows down little by little does not wait.
    m = {.velocity = {0, 1.3f}, .aim = {0, 1.3f}, .feet = {.lands = 0.4f}};
    EXPECT_LT(length(next_motion(m, {0, 1.1f}, k_tick).velocity), 1.3f);
    // Nor does who was pushed.
    m = {.velocity = {0, 1.3f}, .feet = {.lands = 0.4f}};
    EXPECT_LT(length(next_motion(m, {}, k_tick).velocity), 1.3f);
}

TEST(Locomotion, HalfTurnTakesItsTimeAndKeepsMoving) {
    for (float speed : {0.95f, 1.3f, 1.5f}) {
        std::vector<Motion> all{{{0, speed}}};
        for (int tick = 0; tick < 360; ++tick) {
            Motion m = all.back();
            m.feet.swings = tick / 30 % 2 ? 1 : -1;
            all.push_back(next_motion(m, {0.001f, -speed}, k_tick));
        }
        float until = settles(
            all, [](const Motion& m) { return std::fabs(wrap_angle(m.heading - k_pi)) < 5 * k_radians; });
        EXPECT_GE(until, 1.6f);
        EXPECT_LE(until, 2.8f);
        float fastest = 0, slowest = 9;
        for (const Motion& m : all) {
            fastest = std::max(fastest, std::fabs(m.turn_rate));
            slowest = std::min(slowest, length(m.velocity));
        }
        EXPECT_GE(fastest, 110 * k_radians);
        EXPECT_LE(fastest, 170 * k_radians);
        EXPECT_GE(slowest, 0.1f);
        EXPECT_LE(slowest, 0.2f);
    }
}

TEST(Locomotion, SpeedFollowsCurvature) {
    // Round circles: where the wish turns steadily, the walker goes a circle of its own.
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (float rate : {0.7f, 0.9f, 1.1f, 1.3f, 1.5f, 1.7f}) {
        auto all = drive({{0, 1.3f}, 0, 0}, 12, [&](float t) { return heading_direction(rate * t) * 1.3f; });
        const Motion& m = all.back();
        float speed = length(m.velocity);
        double x = std::log(std::fabs(m.turn_rate) / speed), y = std::log(speed);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    double exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_GT(exponent, -0.40);
    EXPECT_LT(exponent, -0.25);
}

TEST(Locomotion, StepsAsideAndBackWithoutTurning) {
    for (float way : {0.5f * k_pi, -0.5f * k_pi, k_pi, 2.5f}) {
        auto all = drive({}, 3, [&](float) { return heading_direction(way) * 0.22f; });
        for (const Motion& m : all) EXPECT_EQ(m.heading, 0);
        EXPECT_NEAR(length(all.back().velocity - heading_direction(way) * 0.22f), 0, 0.01f);
    }
}

TEST(Locomotion, SlowerOnSlopesAndStairs) {
    auto speed_on = [](GroundHit under, float z) {
        return length(drive(
                          {{0, z}, z < 0 ? k_pi : 0, 0}, 4,
                          [&](float) {
                              return Vec2{0, z};
                          },
                          under)
                          .back()
                          .velocity);
    };
    GroundHit flat, steps{0, {0, 1, 0}, Surface::steps};
    GroundHit slope{0, normalize_or(Vec3{0, 1, -0.1f}, {}), Surface::road};
    EXPECT_NEAR(speed_on(flat, 1.3f), 1.3f, 1e-3f);
    EXPECT_NEAR(speed_on(slope, 1.3f), 1.3f * std::exp(-0.35f), 2e-2f);
    EXPECT_NEAR(speed_on(slope, -1.3f), 1.3f, 1e-2f);
    for (float z : {0.95f, 1.3f, 1.5f}) {
        EXPECT_GE(speed_on(steps, z), 0.49f);
        EXPECT_LE(speed_on(steps, z), 0.61f);
    }
}

TEST(Locomotion, NeverJumps) {
    // Whatever is wished, speed and turn rate stay within what legs can do.
    Motion m;
    for (uint32_t t = 0; t < 20000; ++t) {
        Vec2 wish{2.4f * std::sin(static_cast<float>(t / 40) * 12.9f),
                  2.4f * std::cos(static_cast<float>(t / 40) * 4.1f)};
        Motion next = next_motion(m, wish, k_tick);
        float turned = std::fabs(wrap_angle(next.heading - m.heading)) * length(m.velocity);
        ASSERT_LT(length(next.velocity - m.velocity), 2.7f * k_tick + turned + 0.02f);
        ASSERT_LE(std::fabs(next.turn_rate - m.turn_rate), 7.1f * k_tick);
        ASSERT_LE(std::fabs(next.turn_rate), 2.5f);
        m = next;
    }
}

TEST(Locomotion, RunnersTakeStairsInTwiceTheRhythmOfAWalk) {
    EXPECT_FLOAT_EQ(stair_speed(1.3f), 0.546f);
    EXPECT_FLOAT_EQ(stair_speed(2), 0.6f);
    EXPECT_FLOAT_EQ(stair_speed(3), 1.1f);
    EXPECT_FLOAT_EQ(stair_speed(5), 1.1f);
    EXPECT_FLOAT_EQ(stair_speed(3, 0.5f), 0.3f) << "with both feet on each";
    EXPECT_EQ(braking_way(0.4f), 0);
    // By the first step one has slowed down, whether one finishes a step before or not; a child too.
    for (float pace : {1.0f, 0.5f})
        for (float speed : {0.9f, 1.3f, 2.0f, 3.0f}) {
            const float way = braking_way(speed, pace), slow = stair_speed(speed, pace);
            float walked = 0;
            for (const Motion& m : drive({.velocity = {0, speed}, .aim = {0, speed}}, 4, [&](float) {
                     return Vec2{0, slow};
                 })) {
                if (length(m.velocity) < slow + 0.1f) break;
                walked += length(m.velocity) * k_tick;
            }
            EXPECT_LT(walked, way) << speed;
            if (speed >= 2) {
                EXPECT_GT(walked, 0.5f * way) << speed << ": who runs does not slow down from far";
                continue;
            }
            const float longest_step = 0.45f * speed;
            EXPECT_LT(walked + longest_step, way) << speed;
            EXPECT_GT(walked + longest_step, 0.7f * way) << speed << ": nor does who walks";
        }
}

TEST(Locomotion, WhoeverIsFastHasSlowedDownByTheFirstStep) {
    WorldOptions options;
    options.walkers = 24;
    options.kinds = {{standard_body(1.75f)}};
    auto made = make_world(std::make_shared<Ground>(steps()), options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    for (float& speed : w.crowd.identity.preferred_speed) speed = 1.9f;
    auto is_on_steps = [&](uint32_t i) {
        return surface_of(*w.navmesh, w.crowd.motion.polygon[i]) == Surface::steps;
    };
    std::vector<bool> was_on(w.crowd.capacity, true);
    size_t came = 0;
    float fastest = 0, anywhere = 0;
    for (int t = 0; t < 2400; ++t) {
        step(w);
        for (uint32_t i = 0; i < w.crowd.count; ++i) {
            const float speed = length(w.crowd.motion.velocity[i]);
            anywhere = std::max(anywhere, speed);
            if (is_on_steps(i) && !was_on[i]) fastest = std::max(fastest, speed), ++came;
            was_on[i] = is_on_steps(i);
        }
    }
    EXPECT_GT(came, 20u);
    EXPECT_GT(anywhere, 1.7f);
    EXPECT_LT(fastest, 1.3f) << "some turn to the steps when they are near";
}

}  // namespace
}  // namespace flaneur
