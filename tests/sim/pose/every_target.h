// Poses on every instruction set that kernels are compiled for and this CPU has.
#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstring>
#include <vector>

#include "sim/pose/pose.h"

namespace flaneur {

// Expects that `pose(poses)` writes the same bits on each.
template <class Pose>
void expect_same_on_every_target(size_t blocks, const Pose& pose) {
    std::vector<PoseBlock> first, poses(blocks);
    for (auto target : {HWY_SCALAR, HWY_SSSE3, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
        if (!(hwy::SupportedTargets() & target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        pose(poses);
        hwy::SetSupportedTargetsForTest(0);
        if (first.empty()) first = poses;
        EXPECT_EQ(0, std::memcmp(poses.data(), first.data(), poses.size() * sizeof(PoseBlock)))
            << hwy::TargetName(target);
    }
}

}  // namespace flaneur
