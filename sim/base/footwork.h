// What the feet under a body are about to do, as far as it concerns where the body goes.
#pragma once

#include "sim/base/vec.h"

namespace flaneur {

struct Footwork {
    float lands = 0;   // seconds until the foot in the air comes down; 0: both stand
    float swings = 0;  // +1: that is the left foot, -1: the right one, 0: neither, or both are in the air
    Vec2 beside{};     // metres from the body to the nearest place between its feet, as they stand and will
};

}  // namespace flaneur
