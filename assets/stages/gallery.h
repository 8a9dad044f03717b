// A terrace with a row of plinths, on each of which inverse kinematics moves something: see
// sim/linkages/linkages.h.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/city.h"
#include "sim/linkages/linkages.h"

namespace flaneur {

City build_gallery(uint64_t seed);
// What stands on its plinths, row by row from left to right as those who face the wall see them.
std::vector<Linkage> make_exhibits(uint64_t seed);

}  // namespace flaneur
