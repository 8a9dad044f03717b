// Hands that hold canes.
#pragma once

#include "sim/pose/pose.h"

namespace flaneur {

// Brings the right arms of canes [begin, end) of `gait` to where their tips are at their places: a cane turns
// about its tip, so its hand goes to the point nearest to where the arm would swing that lies a cane's length
// from there and within the arm's reach, and the hand turns with the cane. Comes after all else that moves
// arms. No joint turns faster than a leg's (k_fastest_walking) from `before`, the poses of `dt` seconds
// earlier: where more is asked for, the tip is late. The same bits on every instruction set.
void hold_canes(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                std::vector<PoseBlock>& poses);
// The same of those who were not there before.
void hold_canes(const Gait& gait, size_t begin, size_t end, std::vector<PoseBlock>& poses);

// Where the tip of a posed cane is in the world, for checks.
Vec3 posed_tip(const std::vector<PoseBlock>& poses, const Cane& cane);

}  // namespace flaneur
