// Bodies without some of what makes them: see techniques.h.
#pragma once

#include "sim/pose/pose.h"
#include "sim/pose/techniques.h"

namespace flaneur {

// Poses blocks [begin, end) of `gait` into `poses` by the techniques that are `on`: canes, prams and recorded
// motion are laid over poses elsewhere, and are in none of these. `whole`: the same with all techniques,
// which gives the pelvis its place. A pure function of its input, the same bits on every instruction set.
void pose_bare(const Gait& gait, size_t begin, size_t end, Techniques on, const std::vector<PoseBlock>& whole,
               std::vector<PoseBlock>& poses);

}  // namespace flaneur
