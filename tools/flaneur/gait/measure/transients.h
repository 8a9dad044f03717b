// Starting, stopping and turning, out of a recorded walk.
#pragma once

#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

// The step, counted from 1, during which the pelvis, its swaying filtered away, comes to 90 % of the `steady`
// speed, m/s; walking is asked for at tick `asked`.
Quantities measure_start(const Walk& walk, size_t asked, double steady);

// Steps, and seconds, from the tick when standing is asked for until the last foot is down for good.
Quantities measure_stop(const Walk& walk, size_t asked);

// A turn asked for at a tick: the seconds that the trunk turns at more than a tenth of its peak rate, that
// rate, the least speed of the pelvis meanwhile, the steps taken, and by how much the head leads the trunk
// (the lag at which their yaw rates agree best).
Quantities measure_turn(const Walk& walk, size_t asked);

// A leap along +z after a tick: the longest time that both feet are in the air, and how wide a puddle may be
// that it clears: from the tip of the foot that leaves the ground to the heel of the one that comes down.
Quantities measure_leap(const Walk& walk, size_t first);

}  // namespace flaneur
