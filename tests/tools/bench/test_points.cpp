#include <gtest/gtest.h>

#include "tools/flaneur/bench/study/study.h"

namespace flaneur {
namespace {

using Counts = std::vector<uint32_t>;

TEST(SweepPoints, GoByOneTwoFive) {
    EXPECT_EQ(sweep_points(100, 1000, 0), (Counts{100, 200, 500, 1000}));
    EXPECT_EQ(sweep_points(150, 2100, 0), (Counts{150, 200, 500, 1000, 2000, 2100}));
    EXPECT_EQ(sweep_points(1, 3, 0), (Counts{1, 2, 3}));
    EXPECT_EQ(sweep_points(100, 1'000'000, 0).size(), 13u);
}

TEST(SweepPoints, GoInEqualRatios) {
    EXPECT_EQ(sweep_points(100, 10'000, 3), (Counts{100, 1000, 10'000}));
    EXPECT_EQ(sweep_points(1, 2, 9), (Counts{1, 2}));  // none twice
}

TEST(ThreadPoints, EndWithAll) {
    EXPECT_EQ(thread_points(2), (std::vector<int>{1, 2}));
    EXPECT_EQ(thread_points(8), (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
    const std::vector<int> many = thread_points(64);
    EXPECT_EQ(many.back(), 64);
    EXPECT_LT(many.size(), 24u);
}

TEST(Medians, LeaveOutWhatWasNotMeasured) {
    std::vector<StudyPoint> points = {{100, {}}, {200, {}}};
    add_sample(points[0].figures, "draw", 5);
    for (const double ms : {3.0, 1.0, 2.0}) add_sample(points[1].figures, "step", ms);
    const std::vector<PlotPoint> step = medians(points, "step");
    ASSERT_EQ(step.size(), 1u);
    EXPECT_EQ(step[0].x, 200);
    EXPECT_EQ(step[0].y, 2);
}

}  // namespace
}  // namespace flaneur
