// How fast people go who are late or have time. Private to sim/pastimes.
#pragma once

#include "sim/pastimes/pastimes.h"

namespace flaneur {

// How one goes on the trip that it is on, as things are in this tick.
Haste haste_of(const PastimeTick& tick, uint32_t walker);

// What is left of a speed, m/s, that one likes, or made of it.
float pace_of(Haste haste, float usual);

}  // namespace flaneur
