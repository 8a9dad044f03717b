// Rectangles of the ground plane.
#pragma once

#include "sim/base/vec.h"

namespace flaneur {

struct Rectangle {
    Vec2 low, high;  // metres
};

inline Rectangle widened(const Rectangle& area, float by) {
    return {{area.low.x - by, area.low.z - by}, {area.high.x + by, area.high.z + by}};
}

inline bool touch(const Rectangle& a, const Rectangle& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace flaneur
