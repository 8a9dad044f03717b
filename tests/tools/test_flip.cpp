#include <gtest/gtest.h>

#include "tools/flaneur/output/flip.h"

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

}  // namespace
}  // namespace flaneur
