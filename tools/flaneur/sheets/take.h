// A walk as `flaneur gait` was asked for it, over ground with the stairs, slope, kerb or wall, of which a
// strip shows a part and which is exported.
#pragma once

#include "tools/flaneur/gait/measure/walk.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// A walk somewhere, and from which of its ticks to which it is looked at.
struct Take {
    Ground ground;
    Walk walk;
    double first = 0, last = 0;
};

// All of `seconds` in which the person stands for a second, walks at `speed` m/s as `gait` says, and stands
// again for the last three. A turn comes after five, or another speed for as long. One who is to stand stands
// all of GaitOptions::stand, but turns on the spot or steps aside after five.
Take make_take(const GaitOptions& gait, const Person& person, double speed, double seconds);
// What tells most of such a walk: a stride, or the turn. All of standing, or the turn or the steps.
Take make_moment(const GaitOptions& gait, const Person& person, double speed);

}  // namespace flaneur
