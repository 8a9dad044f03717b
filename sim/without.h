// Everybody once more, posed without some techniques, for pictures of what those do.
#pragma once

#include <vector>

#include "sim/pose/curves.h"
#include "sim/pose/techniques.h"
#include "sim/world.h"

namespace flaneur {

// Poses everybody as they are after the world's last tick by the techniques that are `on`, into as many
// blocks as the world has. Legs, and all above the pelvis, are the world's own to the last bit where no
// technique that moves them is off. The world stays as it is; the same state, and without the gait the same
// clocks, give the same poses. Without the gait and without clocks bodies are as those who set out on the
// curves just now. Runs on the world's threads, beside none of its steps.
void pose_without(const World& world, Techniques on, std::vector<PoseBlock>& poses,
                  const std::vector<LimbClock>* clocks = nullptr);

// As the world's poses are: after the last tick, and the one before.
struct Without {
    Techniques on;
    std::vector<PoseBlock> poses, previous;
    uint32_t tick = 0;  // of `previous`
    // Of those whose limbs go by curves; begun anew where a tick was left out.
    std::vector<LimbClock> clocks;
    uint32_t clocks_tick = 0;
};
inline bool is_whole(const Without& without) { return without.on == Techniques{}; }
// Before a tick.
void keep_previous(Without& without, const World& world);
// For a picture of the world as it is.
void catch_up(Without& without, const World& world);

// As joint_between() of world.h.
JointPose joint_between(const Without& without, size_t walker, Joint joint, float between);

}  // namespace flaneur
