#include <gtest/gtest.h>

#include "tools/flaneur/window/time/clock.h"

namespace flaneur {
namespace {

uint32_t ticks_in(Clock& clock, double seconds, double frame) {
    uint32_t ticks = 0;
    for (double t = 0; t < seconds - 1e-9; t += frame) ticks += ticks_due(clock, frame);
    return ticks;
}

TEST(Clock, KeepsTime) {
    for (const float rate : {0.1f, 0.5f, 1.0f, 4.0f, 16.0f})
        for (const double frame : {1.0 / 144, 1.0 / 60, 1.0 / 24, 0.09}) {
            Clock clock{.rate = rate};
            EXPECT_NEAR(ticks_in(clock, 9, frame), 9 * 60 * rate, 2 + 0.03 * 60 * rate)
                << rate << " " << frame;
            EXPECT_EQ(clock.kept_back, 0);
        }
}

TEST(Clock, GivesUpWhatCannotBeMadeUpFor) {
    Clock clock;
    EXPECT_LE(ticks_due(clock, 5), 12u);
    EXPECT_GT(clock.kept_back, 4.5);
    EXPECT_EQ(ticks_due(clock, -1), 0u);
}

TEST(Clock, SaysWhatPaceIsReached) {
    Clock clock{.rate = 4};
    ticks_in(clock, 3, 1.0 / 60);
    EXPECT_FALSE(reached_rate(clock)) << "it keeps up";
    // Pictures that take half a second: a fifth of one is made up for each time.
    ticks_in(clock, 3, 0.5);
    ASSERT_TRUE(reached_rate(clock));
    EXPECT_NEAR(*reached_rate(clock), 4 * 0.2 / 0.5, 0.15);
    clock.rate = 1;
    ticks_due(clock, 0.01);
    EXPECT_FALSE(reached_rate(clock)) << "of another rate nothing is known yet";
    ticks_in(clock, 3, 0.5);
    EXPECT_TRUE(reached_rate(clock));
    clock.is_paused = true;
    ticks_due(clock, 0.01);
    EXPECT_FALSE(reached_rate(clock));
}

TEST(Clock, StandsStillButForSteps) {
    Clock clock{.is_paused = true};
    EXPECT_EQ(ticks_due(clock, 1), 0u);
    clock.steps = 3;
    EXPECT_EQ(ticks_due(clock, 0.01), 3u);
    EXPECT_EQ(ticks_due(clock, 0.01), 0u);
    EXPECT_EQ(between_ticks(clock), 1) << "after steps the last tick is shown";
    clock.is_paused = false;
    clock.steps = 5;
    EXPECT_EQ(ticks_due(clock, 0), 0u);
}

TEST(Clock, RatesGoUpAndDown) {
    float rate = k_least_rate;
    int steps = 0;
    for (; rate < k_most_rate; ++steps) rate = faster(rate);
    EXPECT_EQ(steps, 7);
    EXPECT_EQ(faster(rate), k_most_rate);
    for (; rate > k_least_rate; --steps) rate = slower(rate);
    EXPECT_EQ(steps, 0);
    EXPECT_EQ(slower(rate), k_least_rate);
    EXPECT_EQ(faster(0.7f), 1);
    EXPECT_EQ(slower(3), 2);
}

}  // namespace
}  // namespace flaneur
