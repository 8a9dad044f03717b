// Hands on the handles of prams.
#pragma once

#include "sim/pose/pose.h"

namespace flaneur {

// Brings both arms of who pushes prams [begin, end) of `gait` to the handle as it is after the last tick:
// palms on it, elbows down and a little out. Where a handle is farther than the arm is long, the arm is as
// straight as arms are. Comes after all else that moves arms. The same bits on every instruction set.
void hold_prams(const Gait& gait, size_t begin, size_t end, std::vector<PoseBlock>& poses);
// The same in a tick of `dt` seconds after `before`, no faster than arms turn: a handle that a kerb throws up
// leaves the palms for a moment.
void hold_prams(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                std::vector<PoseBlock>& poses);

// Where the wrist of a hand is to be that lies on the handle, and how the hand is turned; `forearm` metres
// long.
JointPose wrist_on_handle(const Pram& pram, Side side, float forearm);

}  // namespace flaneur
