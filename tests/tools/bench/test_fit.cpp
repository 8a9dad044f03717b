#include <gtest/gtest.h>

#include <cmath>

#include "tools/flaneur/bench/study/fit.h"

namespace flaneur {
namespace {

std::vector<PlotPoint> power(double factor, double exponent) {
    std::vector<PlotPoint> points;
    for (const double x : {100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4})
        points.push_back({x, factor * std::pow(x, exponent)});
    return points;
}

TEST(FitPower, FindsExactLaws) {
    for (const double exponent : {-0.5, 0.0, 1.0, 1.37, 2.0}) {
        const auto law = fit_power(power(0.003, exponent));
        ASSERT_TRUE(law);
        EXPECT_NEAR(law->exponent, exponent, 1e-9);
        EXPECT_NEAR(law->factor, 0.003, 1e-9);
    }
}

TEST(FitPower, LooksAtTheUpperHalf) {
    std::vector<PlotPoint> points = power(2, 1);
    for (size_t i = 0; i < 3; ++i) points[i].y = 1000;  // what every call costs
    const auto law = fit_power(points);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, 1, 1e-9);
    EXPECT_EQ(law->from, 1e3);
    EXPECT_EQ(law->to, 1e4);
}

TEST(FitPower, NeedsThreePointsAboveZero) {
    EXPECT_FALSE(fit_power(std::vector<PlotPoint>{{1, 1}, {2, 2}}));
    EXPECT_FALSE(fit_power(std::vector<PlotPoint>{{1, 0}, {2, 2}, {3, 3}}));
    EXPECT_FALSE(fit_power(std::vector<PlotPoint>{{2, 1}, {2, 2}, {2, 3}}));
}

TEST(Crossing, LiesOnThePowerBetweenTwoPoints) {
    const std::vector<PlotPoint> points = {{100, 1}, {1000, 10}, {10'000, 1000}};
    EXPECT_NEAR(crossing(points, 5).value(), 500, 1e-6);
    EXPECT_NEAR(crossing(points, 100).value(), std::sqrt(1e7), 1e-6);
    EXPECT_FALSE(crossing(points, 2000));
    EXPECT_FALSE(crossing(points, 0.5));
}

TEST(FitAmdahl, FindsTheSerialPart) {
    std::vector<PlotPoint> points;
    for (const double threads : {1.0, 2.0, 3.0, 4.0, 8.0}) points.push_back({threads, 3 + 17 / threads});
    const auto law = fit_amdahl(points);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->serial_ms, 3, 1e-9);
    EXPECT_NEAR(law->shared_ms, 17, 1e-9);
    EXPECT_NEAR(law->serial_share(), 0.15, 1e-9);
}

TEST(FitAmdahl, KeepsPartsFromBelowZero) {
    const auto better = fit_amdahl(std::vector<PlotPoint>{{1, 10}, {2, 4}});  // than perfect
    ASSERT_TRUE(better);
    EXPECT_EQ(better->serial_share(), 0);
    const auto worse = fit_amdahl(std::vector<PlotPoint>{{1, 10}, {2, 12}});
    ASSERT_TRUE(worse);
    EXPECT_EQ(worse->serial_share(), 1);
    EXPECT_FALSE(fit_amdahl(std::vector<PlotPoint>{{2, 10}, {2, 12}}));
    EXPECT_FALSE(fit_amdahl(std::vector<PlotPoint>{{1, 0}, {2, 0}}));
}

}  // namespace
}  // namespace flaneur
