// What hands ask for, with keys, mouse or a gamepad.
#pragma once

#include <array>

namespace flaneur {

struct Steering {
    float ahead = 0, left = 0, up = 0;  // -1..1
    bool is_fast = false;
    float turn = 0, tilt = 0;  // radians, to the left and up
    bool operator==(const Steering&) const = default;
};

// A gamepad as GLFW maps it: axes of the left and the right stick, to the right and down, and the triggers,
// -1 let go .. 1 pressed; buttons by GLFW_GAMEPAD_BUTTON_*.
struct Pad {
    std::array<float, 6> axes{0, 0, 0, 0, -1, -1};
    std::array<bool, 15> buttons{};
};

// The left stick moves, the right one looks about, the right trigger rises and the left one sinks; a bumper
// is fast. Sticks that hardly lean do nothing.
Steering steering_of(const Pad& pad, float seconds);

// Both hands' together.
Steering operator+(Steering a, const Steering& b);

}  // namespace flaneur
