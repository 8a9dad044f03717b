// A terrace with a row of plinths, on each of which inverse kinematics moves something: see
// sim/linkages/linkages.h.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/city.h"
#include "sim/linkages/linkages.h"

namespace flaneur {

struct Gallery {
    City hall;
    std::vector<Linkage> linkages;  // from left to right, as those who face the wall see them
};
Gallery make_gallery(uint64_t seed);

}  // namespace flaneur
