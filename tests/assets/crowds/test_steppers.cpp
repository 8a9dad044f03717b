// Those who step when they must, among others and pushed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/quayside.h"
#include "assets/stages/course.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/falls.h"
#include "sim/fields.h"
#include "sim/state.h"
#include "sim/stepping.h"

namespace flaneur {
namespace {

const std::vector<Vec2> k_flight{{-18.5f, 18.5f}, {-18.5f, 7.5f}, {-17.3f, 7.5f}, {-17.3f, 18.5f}};

std::unique_ptr<World> on_quay(uint64_t seed, uint32_t walkers, uint32_t steppers, int threads = 2) {
    static const auto city = std::make_shared<const City>(build_quayside(1));
    WorldOptions options;
    options.walkers = walkers;
    options.seed = seed;
    options.threads = threads;
    options.destinations = city->destinations;
    auto made = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
    EXPECT_TRUE(made) << made.error().message;
    const Result<void> set = let_step(**made, steppers, {k_flight});
    EXPECT_TRUE(set) << set.error().message;
    return std::move(made).value();
}

TEST(Steppers, GoUpAndDownAFlightAmongOthersAndTouchNobody) {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const auto w = on_quay(seed, 120, 3);
        const Bipeds& bipeds = w->stepping->bipeds;
        std::vector<float> from;
        for (const Biped& b : bipeds.all) from.push_back(b.along);
        float deepest = 0, highest = -9, lowest = 9;
        for (int tick = 0; tick < 180 * 60; ++tick) {
            const std::vector<Biped> before = bipeds.all;
            step(*w);
            const CrowdMotion& m = w->crowd.motion;
            for (size_t n = 0; n < bipeds.all.size(); ++n) {
                const uint32_t i = bipeds.walkers[n];
                ASSERT_TRUE(is_stepping(*w, i));
                ASSERT_LT(length(on_ground(m.position[i]) - bipeds.all[n].body), 1e-6f);
                highest = std::max(highest, m.position[i].y);
                lowest = std::min(lowest, m.position[i].y);
                for (const Side side : {k_left, k_right}) {
                    const bool stood = before[n].swings != static_cast<uint32_t>(side) &&
                                       bipeds.all[n].swings != static_cast<uint32_t>(side);
                    if (stood) {
                        ASSERT_EQ(before[n].feet[side].place, bipeds.all[n].feet[side].place);
                    }
                }
                for (uint32_t k = 0; k < w->crowd.count; ++k)
                    if (k != i && std::fabs(m.position[k].y - m.position[i].y) < 1)
                        deepest =
                            std::max(deepest, w->crowd.identity.radius[i] + w->crowd.identity.radius[k] -
                                                  length(on_ground(m.position[k] - m.position[i])));
            }
        }
        float least = 1e9f;
        for (size_t n = 0; n < bipeds.all.size(); ++n) least = std::min(least, bipeds.all[n].along - from[n]);
        std::printf("steppers of seed %u: overlap %.3f m, way %.0f m, from %.2f to %.2f m\n",
                    static_cast<unsigned>(seed), deepest, least, lowest, highest);
        EXPECT_LT(deepest, 0.05f);
        EXPECT_GT(least, 35);
        EXPECT_GT(highest - lowest, 1.4f);
    }
}

TEST(Steppers, AreTheSameOnAnyThreadsAndFromASavedState) {
    const auto a = on_quay(4, 60, 2, 1), b = on_quay(4, 60, 2, 3);
    std::vector<std::byte> saved;
    for (int tick = 0; tick < 1200; ++tick) {
        if (tick == 500) (void)push(*a, {a->stepping->bipeds.walkers[0], 0}, {150, 0});
        if (tick == 500) (void)push(*b, {b->stepping->bipeds.walkers[0], 0}, {150, 0});
        if (tick == 600) save_state(*a, saved);
        step(*a), step(*b);
    }
    EXPECT_EQ(hash_world(*a), hash_world(*b));
    ASSERT_TRUE(load_state(*b, saved));
    while (b->tick < a->tick) step(*b);
    EXPECT_EQ(hash_world(*a), hash_world(*b));
}

// How one of the quay answers a push so hard, newton seconds: by how many steps within two seconds, and
// whether it fell and went on after.
struct Answer {
    int steps = 0;
    bool fell = false;
    float up_after = 0, goes_on = 0;  // seconds; metres of way within 25 s
};
Answer pushed(uint64_t seed, float hard, float yaw) {
    const auto w = on_quay(seed, 8, 1, 1);
    const uint32_t i = w->stepping->bipeds.walkers[0];
    for (int tick = 0; tick < 90; ++tick) step(*w);
    const Biped& b = w->stepping->bipeds.all[0];
    EXPECT_TRUE(push(*w, {i, w->crowd.slots.generation[i]}, heading_direction(b.heading + yaw) * hard));
    Answer answer;
    const float from = b.along;
    float up = 0;
    for (int tick = 0; tick < 25 * 60; ++tick) {
        const uint32_t swings = b.swings;
        step(*w);
        answer.steps += tick < 120 && swings == 2 && b.swings != 2;
        if (b.is_down == 0) continue;
        answer.fell = true;
        up = static_cast<float>(tick) / 60;
    }
    answer.up_after = up;
    answer.goes_on = b.along - from;
    return answer;
}

TEST(Steppers, AnswerPushesByStepsAndHardOnesByAFallAndGoOn) {
    for (const float yaw : {0.0f, 1.57f, 3.14f, -1.57f}) {
        bool has_fallen = false;
        float falls_at = 0;
        for (const float hard : {10.0f, 40.0f, 70.0f, 100.0f, 130.0f, 160.0f, 220.0f, 320.0f}) {
            const Answer a = pushed(5, hard, yaw);
            if (a.fell && !has_fallen) falls_at = hard;
            EXPECT_TRUE(a.fell || !has_fallen) << hard << " Ns at " << yaw << ": not monotone";
            has_fallen |= a.fell;
            EXPECT_LT(a.up_after, 12) << hard << " Ns at " << yaw;
            EXPECT_GT(a.goes_on, 3) << hard << " Ns at " << yaw;
            EXPECT_TRUE(hard < 40 || a.fell || a.steps >= 1) << hard << " Ns at " << yaw;
        }
        std::printf("pushed at %.2f: falls from %.0f Ns on\n", yaw, falls_at);
        EXPECT_GT(falls_at, 40) << yaw;
        EXPECT_TRUE(has_fallen) << yaw;
    }
}

TEST(Steppers, HoldTheirOwnWhereTheyWouldFallOffTheCourseAndFallElsewhere) {
    const auto city = std::make_shared<const City>(build_course(1, false));
    int fell = 0, held = 0;
    for (const uint64_t seed : {1u, 2u}) {
        WorldOptions options;
        options.walkers = 10;
        options.seed = seed;
        auto made = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
        ASSERT_TRUE(made);
        World& w = **made;
        ASSERT_TRUE(set_on_course(w, make_course(false)));
        const Bipeds& bipeds = w.stepping->bipeds;
        float worst_up = 0;
        std::vector<uint32_t> down_since(10, 0);
        for (uint32_t tick = 0; tick < 120 * 60; ++tick) {
            // Everybody, every twenty seconds.
            if (tick % 1200 == 600 && tick < 90 * 60)
                for (uint32_t i = 0; i < 10; ++i) {
                    const bool can = can_fall(w, i);
                    const Vec2 way = heading_direction(static_cast<float>(tick / 1200 + i));
                    ASSERT_TRUE(push(w, {i, 0}, way * 260));
                    if (!can) ++held;
                }
            step(w);
            for (uint32_t i = 0; i < 10; ++i) {
                if (bipeds.all[i].is_down == 0) {
                    if (down_since[i] != 0)
                        worst_up = std::max(worst_up, static_cast<float>(tick - down_since[i]) / 60);
                    down_since[i] = 0;
                } else if (down_since[i] == 0) {
                    down_since[i] = tick;
                    ++fell;
                }
                ASSERT_GT(w.crowd.motion.position[i].y, -0.3f) << i << " at " << tick;
            }
        }
        EXPECT_LT(worst_up, 11);
        // All go on.
        std::vector<float> from;
        for (const Biped& b : bipeds.all) from.push_back(b.along);
        for (int tick = 0; tick < 40 * 60; ++tick) step(w);
        for (uint32_t i = 0; i < 10; ++i)
            EXPECT_GT(bipeds.all[i].along - from[i], 4) << i << " of seed " << seed;
    }
    std::printf("on the course: %d falls, %d held\n", fell, held);
    EXPECT_GT(fell, 10);
    EXPECT_GT(held, 5);
}

}  // namespace
}  // namespace flaneur
