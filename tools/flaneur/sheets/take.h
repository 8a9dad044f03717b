// The walk that a strip shows and that is exported: over ground with the stairs, slope, kerb or wall asked
// for.
#pragma once

#include "tools/flaneur/gait/walk.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// A walk somewhere, and the ticks of it that tell most: a stride, or a turn.
struct Take {
    Ground ground;
    Walk walk;
    double first = 0, last = 0;
};

// The person stands for a second, then walks at `speed` m/s as `gait` says.
Take make_take(const GaitOptions& gait, const Person& person, double speed);

}  // namespace flaneur
