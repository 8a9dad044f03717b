#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/rendercheck/verdict/flip.h"

namespace flaneur {
namespace {

constexpr int k_width = 48, k_height = 32;

std::vector<uint8_t> plain(uint8_t r, uint8_t g, uint8_t b) {
    std::vector<uint8_t> rgba;
    for (int i = 0; i < k_width * k_height; ++i) rgba.insert(rgba.end(), {r, g, b, 255});
    return rgba;
}

TEST(Flip, EqualPicturesDoNotDiffer) {
    const std::vector<uint8_t> grey = plain(90, 120, 130);
    EXPECT_LT(mean_flip(grey, grey, k_width), 1e-6);
}

// A uniform change has no features, so the error is the colour's, which the paper's formula gives by hand:
// black to white is HyAB 100, 100^0.7 = 25.12; green to blue, the greatest, is 203.3^0.7 = 41.28, and the
// knee 16.51, where the error is 0.95.
TEST(Flip, BlackAgainstWhiteIsNearOne) {
    EXPECT_NEAR(mean_flip(plain(0, 0, 0), plain(255, 255, 255), k_width), 0.9674, 1e-3);
}

TEST(Flip, GreenAgainstBlueIsOne) {
    EXPECT_NEAR(mean_flip(plain(0, 255, 0), plain(0, 0, 255), k_width), 1, 1e-3);
}

TEST(Flip, GrowsWithTheChangeAndIsTheSameBothWays) {
    const std::vector<uint8_t> grey = plain(128, 128, 128);
    double last = 0;
    for (int step : {2, 8, 32, 96}) {
        const auto changed = plain(static_cast<uint8_t>(128 + step), 128, 128);
        const double error = mean_flip(grey, changed, k_width);
        EXPECT_GT(error, last);
        EXPECT_NEAR(mean_flip(changed, grey, k_width), error, 1e-6);
        last = error;
    }
}

TEST(Flip, ErrorsLieWhereThePicturesDiffer) {
    std::vector<uint8_t> a = plain(60, 60, 60), b = a;
    const size_t spot = 4 * (16 * k_width + 8);
    b[spot] = b[spot + 1] = b[spot + 2] = 250;
    const std::vector<float> errors = flip(a, b, k_width);
    EXPECT_GT(errors[16 * k_width + 8], 0.1f);
    EXPECT_LT(errors[16 * k_width + 44], 1e-3f);
}

// The same pictures through the authors' own FLIP.h, 67 pixels a degree: mean, and two pixels.
TEST(Flip, AgreesWithTheAuthorsProgram) {
    struct Published {
        double mean;
        float at_10_10, at_23_16;
    };
    constexpr Published k_theirs[] = {
        {0.146487, 0.121354f, 0.152097f}, {0.273561, 0.529715f, 0.408334f}, {0.456624, 0.617232f, 0.270790f}};
    for (int k = 0; k < 3; ++k) {
        uint32_t state = static_cast<uint32_t>(1 + k);
        auto noise = [&state] { return static_cast<int>((state = state * 1664525u + 1013904223u) >> 24); };
        std::vector<uint8_t> a, b;
        for (int y = 0; y < k_height; ++y)
            for (int x = 0; x < k_width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const int one = k == 0 ? x * 5 : k == 1 ? ((x / 6 + y / 6) % 2 ? 200 : 40) : noise();
                    const int other = k == 0   ? one + (c == 0 ? 12 : 0)
                                      : k == 1 ? (((x + 1) / 6 + y / 6) % 2 ? 200 : 40)
                                               : noise();
                    a.push_back(static_cast<uint8_t>(one));
                    b.push_back(static_cast<uint8_t>(std::min(other, 255)));
                }
                a.push_back(255), b.push_back(255);
            }
        const std::vector<float> errors = flip(a, b, k_width);
        EXPECT_NEAR(mean_of(errors), k_theirs[k].mean, 2e-4) << k;
        EXPECT_NEAR(errors[10 * k_width + 10], k_theirs[k].at_10_10, 2e-3f) << k;
        EXPECT_NEAR(errors[16 * k_width + 23], k_theirs[k].at_23_16, 2e-3f) << k;
    }
}

// The same, with HDR-FLIP.
TEST(HdrFlip, AgreesWithTheAuthorsProgram) {
    struct Published {
        double mean;
        float start, stop;
        int count;
        float at_10_20;
    };
    constexpr Published k_theirs[] = {{0.121108, -4.022847f, 1.727153f, 6, 0.273038f},
                                      {0.153223, -2.878604f, -1.967934f, 2, 0.117592f}};
    for (int k = 0; k < 2; ++k) {
        uint32_t state = static_cast<uint32_t>(7 + k);
        auto noise = [&state] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 24); };
        std::vector<float> a, b;
        for (int y = 0; y < k_height; ++y)
            for (int x = 0; x < k_width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const float one =
                        k == 0 ? 0.01f * std::exp2(static_cast<float>(x) * 0.25f) : (noise() + 1) / 16;
                    a.push_back(one);
                    b.push_back(k == 0 ? one * (y < 16 ? 1.0f : 1.25f) : one * (1 + noise() / 512));
                }
                a.push_back(1), b.push_back(1);
            }
        const Exposures exposures = exposures_of(a);
        EXPECT_NEAR(exposures.start, k_theirs[k].start, 1e-3f);
        EXPECT_NEAR(exposures.stop, k_theirs[k].stop, 1e-3f);
        EXPECT_EQ(exposures.count, k_theirs[k].count);
        const std::vector<float> errors = hdr_flip(a, b, k_width);
        EXPECT_NEAR(mean_of(errors), k_theirs[k].mean, 2e-4) << k;
        EXPECT_NEAR(errors[20 * k_width + 10], k_theirs[k].at_10_20, 2e-3f) << k;
    }
}

TEST(HdrFlip, TakesWhatIsNoLight) {
    const float odd[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -3,
                         0, 1e38f};
    std::vector<float> a(4 * k_width * k_height, 0.0f), b = a;
    EXPECT_LT(mean_of(hdr_flip(a, b, k_width)), 1e-6);
    for (size_t i = 0; i < a.size(); ++i) a[i] = odd[i % 5], b[i] = odd[(i + 1) % 5];
    for (const float error : hdr_flip(a, b, k_width)) EXPECT_TRUE(error >= 0 && error <= 1);
}

}  // namespace
}  // namespace flaneur
