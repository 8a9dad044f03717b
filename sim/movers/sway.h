// Values that go to and fro for ever, as a function of the tick alone.
#pragma once

#include <cstdint>

#include "sim/base/vec.h"

namespace flaneur {

// A place, or three angles, that move for ever: along each axis to and fro about the middle, `reach` to
// either side, once in `period` ticks from `start` ticks before the first. Reaches of 0 stay.
struct Sway {
    Vec3 middle{}, reach{};
    uint32_t period[3] = {1, 1, 1}, start[3] = {};
    uint32_t rests = 0;  // 0: as a pendulum; the more, the longer it stays near either end
};
Vec3 sway_at(const Sway& sway, uint32_t tick);

}  // namespace flaneur
