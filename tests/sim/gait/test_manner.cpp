#include <gtest/gtest.h>

#include <cmath>

#include "sim/gait/manner.h"

namespace flaneur {
namespace {

TEST(Manner, PeopleSpreadAroundTheMiddle) {
    for (float years : {7.0f, 30.0f, 85.0f}) {
        Manner middle = manner_at_age(years);
        constexpr int k_people = 4000;
        double stride = 0, squares = 0, width = 0;
        for (uint32_t i = 0; i < k_people; ++i) {
            Manner m = draw_manner(middle, {3, i, 0, Purpose::style});
            double s = static_cast<double>(m.stride / middle.stride) - 1;
            stride += s / k_people;
            squares += s * s / k_people;
            width += static_cast<double>(m.step_width / middle.step_width) / k_people;
            EXPECT_GT(m.step_width, 0);
            EXPECT_GT(m.arm_swing, 0);
            EXPECT_GT(m.toe_out, 0);
        }
        EXPECT_NEAR(stride, 0, 0.005);
        EXPECT_NEAR(std::sqrt(squares), 0.047, 0.006);
        EXPECT_NEAR(width, 1, 0.01);
    }
}

TEST(Manner, ChangesSmoothlyWithAge) {
    Manner grown = manner_at_age(30), neutral;
    EXPECT_EQ(grown.stride, neutral.stride);
    EXPECT_EQ(grown.step_width, neutral.step_width);
    EXPECT_EQ(grown.arm_swing, neutral.arm_swing);
    EXPECT_GT(manner_at_age(8).stride, grown.stride);
    EXPECT_GT(manner_at_age(8).step_width, grown.step_width);
    EXPECT_LT(manner_at_age(85).stride, grown.stride);
    EXPECT_LT(manner_at_age(85).arm_swing, grown.arm_swing);
    EXPECT_GT(manner_at_age(85).step_width, manner_at_age(72).step_width);
    for (float years = 0; years < 120; years += 0.25f) {
        Manner a = manner_at_age(years), b = manner_at_age(years + 0.25f);
        EXPECT_LT(std::fabs(a.stride - b.stride), 0.01f) << years;
        EXPECT_LT(std::fabs(a.step_width - b.step_width), 0.002f) << years;
        EXPECT_LT(std::fabs(a.arm_swing - b.arm_swing), 0.01f) << years;
    }
}

}  // namespace
}  // namespace flaneur
