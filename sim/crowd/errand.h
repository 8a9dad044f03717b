// Private to sim/crowd.
#pragma once

#include "sim/crowd/crowd.h"

namespace flaneur {

// Finds the path that the walker's path_due asks for, choosing a new goal first where it asks for one.
void plan_path(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick, uint64_t seed);

}  // namespace flaneur
