#include "tools/flaneur/window/cameras/steering.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace flaneur {
namespace {

constexpr float k_dead = 0.18f;  // of a stick's way, in which it does nothing
constexpr float k_dead_trigger = 0.08f;
constexpr float k_turn = 2.4f, k_tilt = 1.6f;  // radians a second, at most

struct Stick {
    float x, y;
};
// Round, so that it leans alike in all directions; gently about its middle.
Stick stick(float x, float y) {
    const float lean = std::hypot(x, y);
    if (!(lean > k_dead)) return {0, 0};
    const float share = std::min((lean - k_dead) / (1 - k_dead), 1.0f), gain = share * share / lean;
    return {x * gain, y * gain};
}

float trigger(float axis) {
    const float share = (axis + 1) / 2;
    return share > k_dead_trigger ? std::min((share - k_dead_trigger) / (1 - k_dead_trigger), 1.0f) : 0;
}

}  // namespace

Steering steering_of(const Pad& pad, float seconds) {
    const Stick moves = stick(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X], pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]);
    const Stick looks = stick(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X], pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]);
    Steering out;
    out.ahead = -moves.y, out.left = -moves.x;
    out.up = trigger(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER]) -
             trigger(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]);
    out.is_fast =
        pad.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] || pad.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER];
    out.turn = -looks.x * k_turn * seconds, out.tilt = -looks.y * k_tilt * seconds;
    return out;
}

Steering operator+(Steering a, const Steering& b) {
    auto within = [](float v) { return std::clamp(v, -1.0f, 1.0f); };
    a.ahead = within(a.ahead + b.ahead), a.left = within(a.left + b.left), a.up = within(a.up + b.up);
    a.is_fast = a.is_fast || b.is_fast;
    a.turn += b.turn, a.tilt += b.tilt;
    return a;
}

}  // namespace flaneur
