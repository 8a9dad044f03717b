// A meadow among hills and trees, for stages that lie in one.
#pragma once

#include "assets/city.h"
#include "sim/base/rng.h"

namespace flaneur {

struct Meadow {
    float level = 30;     // metres about the origin in which it is level: before it rises to hills
    float from = 20;      // metres from the origin where it begins; there the stage's own ground covers it
    float below = 0.02f;  // metres that its level part lies below 0
    float turn = 0;       // radians, of its hills
};

void add_land(Scenery& scenery, const Meadow& meadow);
// From so many metres about the origin.
void add_trees(City& city, const Meadow& meadow, float from, RandomKey key);

}  // namespace flaneur
