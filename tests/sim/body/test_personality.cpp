// What kinds of people there are, and that what shows of it keeps the spread that people have.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/body/personality.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr uint32_t k_people = 20000;

RandomKey key_of(uint32_t i, Purpose purpose = Purpose::personality) { return {5, i, 0, purpose}; }

template <class Of>
double mean(float age, bool woman, const Of& of) {
    double sum = 0;
    for (uint32_t i = 0; i < k_people; ++i) sum += of(draw_personality(age, woman, key_of(i)));
    return sum / k_people;
}

TEST(Personality, ShiftsWithAgeAndSexAsSurveysFind) {
    const auto neuroticism = [](const Personality& p) { return p.neuroticism; };
    const auto conscientiousness = [](const Personality& p) { return p.conscientiousness; };
    const auto agreeableness = [](const Personality& p) { return p.agreeableness; };
    EXPECT_NEAR(mean(40, true, neuroticism) - mean(40, false, neuroticism), 0.4, 0.05);
    EXPECT_NEAR(mean(40, true, agreeableness) - mean(40, false, agreeableness), 0.15, 0.05);
    EXPECT_NEAR(mean(60, false, conscientiousness) - mean(20, false, conscientiousness), 0.6, 0.05);
    EXPECT_LT(mean(60, true, neuroticism), mean(20, true, neuroticism) - 0.2);
    EXPECT_NEAR(mean(60, false, neuroticism), mean(20, false, neuroticism), 0.05);
}

// Weidmann's deviation stays what it was, and the outgoing half walk faster by 0.06 m/s.
TEST(Personality, ThePaceSpreadsAsBeforeAndTheOutgoingWalkFaster) {
    double sum = 0, squares = 0, outgoing = 0, others = 0;
    uint32_t outgoing_count = 0;
    for (uint32_t i = 0; i < k_people; ++i) {
        const Personality p = draw_personality(40, i % 2 == 0, key_of(i));
        const double score =
            pace_score(p, usual_personality(40, i % 2 == 0), random_normal(key_of(i, Purpose::body), 1));
        sum += score, squares += score * score;
        if (p.extraversion > usual_personality(40, i % 2 == 0).extraversion)
            outgoing += score, ++outgoing_count;
        else
            others += score;
    }
    EXPECT_NEAR(sum / k_people, 0, 0.03);
    EXPECT_NEAR(std::sqrt(squares / k_people), 1, 0.03);
    EXPECT_NEAR(0.26 * (outgoing / outgoing_count - others / (k_people - outgoing_count)), 0.06, 0.01);
}

TEST(Personality, WhatShowsOfItIsOneOnTheWholeAndBounded) {
    double room = 0, patience = 0, linger = 0;
    for (uint32_t i = 0; i < k_people; ++i) {
        const Personality p = draw_personality(40, i % 2 == 0, key_of(i));
        ASSERT_GE(room_share(p), 0.85f);
        ASSERT_LE(room_share(p), 1.2f);
        ASSERT_GE(patience_share(p), 0.8f);
        ASSERT_LE(patience_share(p), 1.4f);
        ASSERT_GE(linger_share(p), 0.6f);
        ASSERT_LE(linger_share(p), 1.5f);
        room += room_share(p), patience += patience_share(p), linger += linger_share(p);
        Manner m = manner_at_age(40);
        add_personality(m, p);
        ASSERT_GT(m.arm_swing[0], 0.4f);
        ASSERT_LT(m.arm_swing[0], 1.4f);
        ASSERT_LT(std::fabs(m.stoop), 5 * k_radians);
    }
    EXPECT_NEAR(room / k_people, 1, 0.02);
    EXPECT_NEAR(patience / k_people, 1, 0.02);
    EXPECT_NEAR(linger / k_people, 1, 0.02);
}

// One and the same person behind pace, room, patience and walk: who is in the crowd is who the body is of.
TEST(Personality, IsOneInTheCrowdAndInTheBody) {
    WorldOptions options;
    options.walkers = 200;
    options.kinds = {Kind{standard_body(1.75f), 1, 30, false}, Kind{standard_body(1.65f), 1, 70, true}};
    auto made = make_world(std::make_shared<const Ground>(square(60)), options);
    ASSERT_TRUE(made) << made.error().message;
    const World& w = **made;
    for (uint32_t i = 0; i < w.crowd.count; ++i) {
        const Personality p = personality_of(w, i);
        EXPECT_EQ(w.crowd.identity.room[i], room_share(p)) << i;
        EXPECT_EQ(w.crowd.identity.patience[i], patience_share(p)) << i;
        EXPECT_EQ(w.crowd.identity.linger[i], linger_share(p)) << i;
        Manner own;
        add_personality(own, p);
        EXPECT_EQ(w.gait.people[i / k_block].curiosity[i % k_block], own.curiosity) << i;
    }
}

}  // namespace
}  // namespace flaneur
