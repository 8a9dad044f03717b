// Canes of those who fall.
#pragma once

#include "sim/falls.h"

namespace flaneur {

// The cane of one who falls stays in a hand that holds it no longer: it hangs, drags and lies, and is set up
// again as its owner stands up. Of those without a cane, or still on their feet, nothing. After the fall's
// own tick.
void step_cane(World& world, const Fall& fall);

}  // namespace flaneur
