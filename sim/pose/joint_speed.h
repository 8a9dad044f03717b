// Legs turn no faster than muscles can turn them.
#pragma once

#include "sim/pose/pose.h"

namespace flaneur {

// The fastest that a hip, knee, ankle or ball of the foot turns against its parent, rad/s: 850 degrees a
// second of a walker, whose knee reaches 430 in steady steps, 1250 of a runner.
inline constexpr float k_fastest_walking = 14.835f, k_fastest_running = 21.817f;

// Poses are found anew each tick; where a plan was poor (a foot left far behind by a sudden start, a push)
// two in a row may differ by more than a leg can move in `dt` seconds. Such a leg comes after as fast as it
// can, and its foot is late by millimetres. Changes legs of `now` in blocks [begin, end); `before` holds the
// poses of `dt` earlier. Kernels: the same bits on every instruction set.
void limit_joint_speeds(const Gait& gait, size_t begin, size_t end, float dt,
                        const std::vector<PoseBlock>& before, std::vector<PoseBlock>& now);

}  // namespace flaneur
