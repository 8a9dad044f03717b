#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/flaneur/gait/measure/signal.h"

namespace flaneur {
namespace {

constexpr double k_tau = 2 * std::numbers::pi;
constexpr double k_rate = 60;

Cycle wave(double amplitude, double shift, double offset = 0, int k = 1) {
    Cycle c;
    for (size_t p = 0; p < c.size(); ++p)
        c[p] = offset + amplitude * std::sin(k_tau * (k * static_cast<double>(p) / 100 - shift));
    return c;
}

Samples tone(double hertz, size_t n = 600) {
    Samples s;
    for (size_t t = 0; t < n; ++t) s.push_back(std::sin(k_tau * hertz * static_cast<double>(t) / k_rate));
    return s;
}

double loudness(const Samples& s) {
    double sum = 0;
    for (size_t t = 120; t < s.size() - 120; ++t) sum += s[t] * s[t];
    return std::sqrt(2 * sum / static_cast<double>(s.size() - 240));
}

TEST(GaitSignal, SinesHaveKnownErrorsAndCorrelations) {
    EXPECT_NEAR(rmse(wave(10, 0), wave(0, 0)), 10 / std::numbers::sqrt2, 1e-9);
    EXPECT_NEAR(rmse(wave(10, 0, 3), wave(10, 0)), 3, 1e-9);
    EXPECT_NEAR(rmse(centred(wave(10, 0, 3)), wave(10, 0)), 0, 1e-9);
    EXPECT_NEAR(correlation(wave(10, 0, 5), wave(2, 1.0 / 6)), 0.5, 1e-9);
    EXPECT_NEAR(correlation(wave(10, 0), wave(1, 0.5)), -1, 1e-9);
    EXPECT_EQ(correlation(wave(10, 0), wave(0, 0)), 0);
    EXPECT_NEAR(range(wave(10, 0, 7)), 20, 1e-9);
}

TEST(GaitSignal, PeaksLieBetweenPercents) {
    Peak top = highest(wave(10, 0.123), 10, 60);  // at 25 + 12.3
    EXPECT_NEAR(top.percent, 37.3, 0.02);
    EXPECT_NEAR(top.value, 10, 0.01);
    EXPECT_NEAR(lowest(wave(10, 0.26), -10, 10).percent, 1, 0.02);
    EXPECT_NEAR(lowest(wave(10, 0.20), -10, 10).percent, -5, 0.02);
    EXPECT_EQ(highest(wave(10, 0), 40, 60).percent, 40);  // no peak within: the end
}

TEST(GaitSignal, HarmonicsHaveAmplitudeAndPhase) {
    Cycle c = wave(3, 0);
    Cycle second = wave(2, 0, 0, 2);
    for (size_t p = 0; p < c.size(); ++p) c[p] += second[p];
    EXPECT_NEAR(harmonic(c, 1).amplitude, 3, 1e-9);
    EXPECT_NEAR(harmonic(c, 2).amplitude, 2, 1e-9);
    EXPECT_NEAR(harmonic(c, 3).amplitude, 0, 1e-9);
    EXPECT_NEAR(phase_between(harmonic(wave(1, 0), 1), harmonic(wave(5, 0.25), 1)), 90, 1e-6);
    EXPECT_NEAR(phase_between(harmonic(wave(1, 0), 1), harmonic(wave(5, -0.25), 1)), 270, 1e-6);
}

TEST(GaitSignal, LowPassKeepsSlowAndTakesFastWithoutDelay) {
    EXPECT_NEAR(loudness(low_pass(tone(1), k_rate, 10)), 1, 1e-3);
    EXPECT_NEAR(loudness(low_pass(tone(10), k_rate, 10)), std::numbers::sqrt2 / 2, 0.02);
    EXPECT_LT(loudness(low_pass(tone(25), k_rate, 10)), 0.01);
    Samples slow = tone(1), passed = low_pass(slow, k_rate, 10);
    for (size_t t = 100; t < 500; ++t) EXPECT_NEAR(passed[t], slow[t], 1e-3);
    Samples level(200, 4.0);
    for (double v : low_pass(level, k_rate, 10)) EXPECT_NEAR(v, 4, 1e-9);
}

TEST(GaitSignal, JerkOfASwingIsKnown) {
    constexpr double k_hertz = 1.5, k_amplitude = 0.1;
    std::vector<Vec3> path;
    for (double v : tone(k_hertz)) path.push_back({static_cast<float>(k_amplitude * v), 1, 0});
    double expected = k_amplitude * std::pow(k_tau * k_hertz, 3) * 2 / std::numbers::pi;
    EXPECT_NEAR(mean_jerk(path, k_rate, 100, 500), expected, 0.03 * expected);
    std::vector<Vec3> still(100, Vec3{1, 2, 3});
    EXPECT_NEAR(mean_jerk(still, k_rate, 0, 100), 0, 1e-6);
}

TEST(GaitSignal, CyclesAreCutBetweenTicks) {
    Samples ramp;
    for (int t = 0; t < 100; ++t) ramp.push_back(t);
    Cycle c = cycle_of(ramp, 10.5, 60.5);
    EXPECT_NEAR(c[0], 10.5, 1e-9);
    EXPECT_NEAR(c[50], 35.5, 1e-9);
    EXPECT_NEAR(c[100], 60.5, 1e-9);
}

}  // namespace
}  // namespace flaneur
