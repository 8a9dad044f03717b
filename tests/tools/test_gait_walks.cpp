// The walk that is exported, and steep ground, which `gait --check` does not walk.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace flaneur
