// The walk that is exported.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace flaneur
