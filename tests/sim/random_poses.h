// Random poses for tests of clips and blends.
#pragma once

#include "sim/animation/clip.h"
#include "sim/base/rng.h"

namespace flaneur {

// Rotations of up to about `bend` radians an axis and ways of up to a metre.
inline LocalPose random_pose(RandomKey key, size_t joints, float bend, uint32_t n) {
    LocalPose pose;
    uint32_t at = n * 10000;
    for (size_t j = 0; j < joints; ++j) {
        float x = random_between(key, -bend, bend, at), y = random_between(key, -bend, bend, at + 1);
        float z = random_between(key, -bend, bend, at + 2);
        pose.rotations.push_back(normalize(Quat{x / 2, y / 2, z / 2, 1}));
        at += 3;
    }
    pose.offset = {random_between(key, -1, 1, at), random_between(key, -1, 1, at + 1),
                   random_between(key, -1, 1, at + 2)};
    return pose;
}

inline std::vector<LocalPose> random_poses(RandomKey key, size_t joints, float bend, uint32_t count) {
    std::vector<LocalPose> poses;
    for (uint32_t n = 0; n < count; ++n) poses.push_back(random_pose(key, joints, bend, n));
    return poses;
}

// Radians between two rotations, for angles from 1e-7 on.
inline float angle_between(Quat a, Quat b) {
    Quat d = conjugate(a) * b;
    return 2 * std::asin(std::fmin(1.0f, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

}  // namespace flaneur
