// Blocks: sixteen walkers side by side, number by number, so that kernels take them in whole vectors.
#pragma once

#include <cstddef>

namespace flaneur {

inline constexpr int k_block = 16;  // walkers in a block

constexpr int lane_of(size_t walker) { return static_cast<int>(walker % k_block); }
constexpr size_t block_count(size_t walkers) { return (walkers + k_block - 1) / k_block; }

// One number of each walker of a block.
struct alignas(64) LaneRow {
    float lanes[k_block];
};

}  // namespace flaneur
