#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tools/flaneur/window/cameras/steering.h"

namespace flaneur {
namespace {

Steering leaning(int axis, float by) {
    Pad pad;
    pad.axes[static_cast<size_t>(axis)] = by;
    return steering_of(pad, 0.1f);
}

TEST(Steering, APadAtRestAsksForNothing) {
    EXPECT_EQ(steering_of(Pad{}, 0.1f), Steering{});
    for (const int axis : {GLFW_GAMEPAD_AXIS_LEFT_X, GLFW_GAMEPAD_AXIS_LEFT_Y, GLFW_GAMEPAD_AXIS_RIGHT_X,
                           GLFW_GAMEPAD_AXIS_RIGHT_Y})
        for (const float drift : {-0.15f, 0.1f, 0.17f}) EXPECT_EQ(leaning(axis, drift), Steering{}) << axis;
    EXPECT_EQ(leaning(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER, -0.9f), Steering{});
}

TEST(Steering, LeftMovesRightLooksTriggersRiseAndSink) {
    EXPECT_NEAR(leaning(GLFW_GAMEPAD_AXIS_LEFT_Y, -1).ahead, 1, 1e-5f);
    EXPECT_NEAR(leaning(GLFW_GAMEPAD_AXIS_LEFT_X, 1).left, -1, 1e-5f);
    EXPECT_NEAR(leaning(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER, 1).up, 1, 1e-5f);
    EXPECT_NEAR(leaning(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER, 1).up, -1, 1e-5f);
    EXPECT_LT(leaning(GLFW_GAMEPAD_AXIS_RIGHT_X, 1).turn, 0) << "headings grow to the left";
    EXPECT_GT(leaning(GLFW_GAMEPAD_AXIS_RIGHT_Y, -1).tilt, 0) << "pushed away, it looks up";
    Pad fast;
    fast.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] = true;
    EXPECT_TRUE(steering_of(fast, 0.1f).is_fast);
}

TEST(Steering, GrowsWithTheLeanAndHasBounds) {
    float last = 0;
    for (float lean = 0.2f; lean <= 1; lean += 0.05f) {
        const float ahead = leaning(GLFW_GAMEPAD_AXIS_LEFT_Y, -lean).ahead;
        EXPECT_GT(ahead, last);
        last = ahead;
    }
    Pad pad;  // sticks reach beyond their circle in corners
    pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -1;
    const Steering corner = steering_of(pad, 0.1f);
    EXPECT_LE(corner.ahead * corner.ahead + corner.left * corner.left, 1.0001f);
    const Steering both = corner + Steering{.ahead = 1, .turn = 0.2f};
    EXPECT_EQ(both.ahead, 1);
    EXPECT_FLOAT_EQ(both.turn, 0.2f + corner.turn);
}

}  // namespace
}  // namespace flaneur
