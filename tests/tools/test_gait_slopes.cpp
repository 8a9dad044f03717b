// Steep ground: what `gait --check` does not walk.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/flaneur/gait/trials.h"

namespace flaneur {
namespace {

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
