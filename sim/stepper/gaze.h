// Heads that are turned to what is looked at, after the pose.
#pragma once

#include "sim/pose/pose.h"
#include "sim/stepper/stepper.h"

namespace flaneur {

// Turns neck and head of each by its gaze, two fifths and three fifths.
void turn_heads(const Bipeds& bipeds, std::vector<PoseBlock>& poses);

}  // namespace flaneur
