// The walk that is exported, and steep ground, which `gait --check` does not walk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tools/flaneur/gait/people/who.h"
#include "tools/flaneur/gait/trials.h"
#include "tools/flaneur/sheets/take.h"

namespace flaneur {
namespace {

void expect_standing(const Take& take) {
    const std::vector<Instant>& ticks = take.walk.ticks;
    ASSERT_GT(ticks.size(), 30u);
    EXPECT_LT(length(ticks.back().velocity), 1e-3f);
    EXPECT_LT(length(place(ticks.back(), hips) - place(ticks[ticks.size() - 30], hips)), 0.05f) << "sways";
    for (const FootInstant& foot : ticks.back().feet) EXPECT_FALSE(foot.swinging);
}

TEST(GaitTake, LastsAsAskedFromStandingToStanding) {
    Person person{standard_body(1.75f), {}};
    GaitOptions level, stairs, kerb;
    stairs.stairs = "down";
    kerb.kerb = 0.12;
    for (const GaitOptions& gait : {level, stairs, kerb}) {
        for (double seconds : {12.0, 25.0}) {
            Take take = make_take(gait, person, 1.3, seconds);
            EXPECT_EQ(take.walk.ticks.size(), static_cast<size_t>(60 * seconds));
            expect_standing(take);
        }
    }
}

// To any side, for as long as it takes.
TEST(GaitTake, StaysOnItsGround) {
    Person person{standard_body(1.75f), {}};
    for (double turn : {90.0, -90.0, 180.0, 0.0}) {
        GaitOptions gait;
        gait.turn = turn;
        Take take = make_take(gait, person, 4, turn == 0 ? 200 : 30);
        const Vec3 end = take.walk.ticks.back().root;
        EXPECT_GT(length(end), 60) << turn;
        EXPECT_TRUE(ground_at(take.ground, end, 1, 1)) << turn;
        expect_standing(take);
    }
}

TEST(GaitSlopes, SolesStandOnSteepGround) {
    for (float height : {1.15f, 1.75f}) {
        for (double percent : {-40.0, -24.0, -16.0, 16.0, 24.0, 32.0, 40.0, 46.0}) {
            if (height < 1.5f && percent > 25) continue;  // a child's soles slide there, by 6 mm and more
            Report r = try_slope({standard_body(height), {}}, 1.2, percent);
            auto expect_less = [&](const char* quantity, double most) {
                EXPECT_LT(value_of(r.quantities, quantity), most)
                    << quantity << " of " << height << " m on " << percent << " %";
            };
            expect_less("stance_drift.mm", 3);
            expect_less("penetration.mm", 5);
            expect_less("float.mm", 5);
            if (percent < 0) expect_less("planted_ankle_drift.mm", 2);
        }
    }
}

double pitch_at_contact(double percent) {
    Report r = try_slope({standard_body(1.75f), {}}, 1.2, percent);
    return value_of(r.quantities, "foot_pitch_contact.deg") - std::atan(percent / 100) * 57.3;
}

// A kerb down is met on the ball; a slope is not.
TEST(GaitSlopes, HeelsComeDownFirstDownhillAndBallsUpSteepSlopes) {
    EXPECT_GT(pitch_at_contact(-12), 10);
    EXPECT_GT(pitch_at_contact(-24), 10);
    EXPECT_LT(pitch_at_contact(40), -10);
}

const Verdict* verdict_on(const Report& report, const std::string& name) {
    for (const Verdict& v : report.verdicts)
        if (name == v.bar.quantity) return &v;
    return nullptr;
}

// One who has a hand in a pocket as soon as may be.
Person with_hand_in_pocket() {
    Person person{standard_body(1.75f), {}};
    person.body.wear = {Bag::none, true};
    GaitOptions gait;
    gait.posture = "pocket";
    free_hands(person.manner, {}, gait);
    return person;
}

TEST(GaitBars, OfArmsAreLeftOutWhereBothHandsHoldSomething) {
    Person person{standard_body(1.75f), {}};
    Report free = try_level(person, 1.3, 15);
    EXPECT_TRUE(free.left_out.empty());
    person.body.pram = standard_pram(person.body);
    Report pushing = try_level(person, 1.3, 15);
    ASSERT_EQ(pushing.left_out.size(), 1u);
    EXPECT_FALSE(pushing.left_out[0].why.empty());
    // Nothing else is missing, and what is left out is said.
    EXPECT_EQ(pushing.verdicts.size() + pushing.left_out[0].quantities.size(), free.verdicts.size());
    for (const char* name :
         {"upper_arm.range", "elbow.range", "elbow.mean", "arm_leg.deg", "jerk_wrist.m_s3"})
        EXPECT_EQ(std::ranges::count(pushing.left_out[0].quantities, name), 1) << name;
    EXPECT_EQ(pushing.left_out[0].quantities.size(), 5u);
}

TEST(GaitBars, OfArmsAreHeldToTheArmThatSwings) {
    Report free = try_level({standard_body(1.75f), {}}, 1.3, 15);
    Report report = try_level(with_hand_in_pocket(), 1.3, 15);
    EXPECT_TRUE(report.left_out.empty());
    EXPECT_EQ(report.verdicts.size(), free.verdicts.size());
    for (const char* name : {"upper_arm.range", "elbow.range", "elbow.mean", "arm_leg.deg"}) {
        const Verdict *one = verdict_on(report, name), *of_free = verdict_on(free, name);
        ASSERT_TRUE(one && of_free) << name;
        EXPECT_NEAR(one->value, of_free->value, 0.15 * of_free->value) << name;
    }
}

TEST(GaitBars, OfFreeTurnsAreNotThoseOfAPram) {
    Person person{standard_body(1.75f), {}};
    person.body.pram = standard_pram(person.body);
    Report turn = try_turn(person, 1.3, 180);
    ASSERT_EQ(turn.left_out.size(), 1u);
    EXPECT_EQ(turn.left_out[0].quantities.size(), 3u);
    EXPECT_TRUE(verdict_on(turn, "head_lead.ms")) << "heads turn first all the same";
    EXPECT_TRUE(verdict_on(turn, "stance_drift.mm"));
}

}  // namespace
}  // namespace flaneur
