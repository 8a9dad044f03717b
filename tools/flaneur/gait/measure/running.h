// What tells a run from a walk, out of a recorded one, between two ticks.
#pragma once

#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

// How the pelvis falls, m/s2 and down +: on the mean in flight, and at most while a foot stands, of three
// ticks.
Quantities measure_fall(const Walk& walk, size_t first, size_t last);

// A walk that becomes a run or the other way round: the most, over all ticks with a foot on the ground, that
// both knees are bent at once, degrees; and how many steps have neither both feet down nor both in the air,
// or both of these.
Quantities measure_change(const Walk& walk, size_t first, size_t last);

}  // namespace flaneur
