// How fast bodies have moved of late: what drags behind them (skirts, hair, bags) hangs by that. A
// first-order lag of velocities, so that a point which trails a joint with that lag is k_trail times as much
// behind it.
#pragma once

#include <array>
#include <vector>

#include "sim/pose/pose.h"

namespace flaneur {

inline constexpr float k_trail = 0.1f;  // seconds

inline constexpr std::array<Joint, 8> k_trailed = {
    hips, upper_chest, head, left_hand, left_lower_leg, left_foot, right_lower_leg, right_foot};
inline constexpr size_t k_turning = 3;  // the first of them turn, too

struct alignas(64) TrailBlock {
    float moving[k_trailed.size()][3][k_block] = {};  // m/s, along the world's axes
    float turning[k_turning][k_block] = {};           // radians/s about the world's upright
};

// Blocks [begin, end) after a tick of so many seconds, from the poses `before` to the `last`. `from` may be
// `to`.
void advance_trails(const std::vector<PoseBlock>& before, const std::vector<PoseBlock>& last, size_t begin,
                    size_t end, float tick, const std::vector<TrailBlock>& from, std::vector<TrailBlock>& to);
// As of one who stood still.
void forget_trail(std::vector<TrailBlock>& trails, size_t walker);

// Of one walker.
struct Trail {
    std::array<Vec3, k_trailed.size()> moving;
    std::array<float, k_turning> turning;
};
Trail trail_of(const std::vector<TrailBlock>& trails, size_t walker);
// `between` 0, the first, and 1, the second.
Trail mixed_trail(const Trail& a, const Trail& b, float between);

}  // namespace flaneur
