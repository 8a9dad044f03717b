// The second half of cut_pieces.
#pragma once

#include <vector>

#include "assets/plan/ground_plan.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

// Corners a millimetre apart become one, and a corner on a neighbour's edge becomes the neighbour's corner
// too. A piece may come apart into several, or vanish.
void weld(std::vector<Piece>& pieces, Workers& workers);

}  // namespace flaneur
