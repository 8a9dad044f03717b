// Bodies and things to be recorded, and how far what is read of them is off.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "assets/recording/motion.h"
#include "sim/base/rng.h"

namespace flaneur {

// Largest differences: root's places and joints' from there in metres, rotations in radians.
struct Off {
    float root = 0, place = 0, turn = 0;
};

inline float angle_between(Quat a, Quat b) {
    const Quat q = conjugate(a) * b;
    return 2 * std::asin(std::min(1.0f, length(Vec3{q.x, q.y, q.z})));
}

inline void compare(const PoseBlock& block, int lane, const MotionPose& read, Off& off) {
    const auto of = [&](const float(&rows)[3][k_block]) {
        return Vec3{rows[0][lane], rows[1][lane], rows[2][lane]};
    };
    const Vec3 root = of(block.position[0]);
    off.root = std::max(off.root, length((read.origin - of(block.origin)) + (read.places[0] - root)));
    for (size_t j = 0; j < k_joint_count; ++j) {
        const auto& q = block.rotation[j];
        off.place =
            std::max(off.place, length((read.places[j] - read.places[0]) - (of(block.position[j]) - root)));
        off.turn = std::max(off.turn,
                            angle_between({q[0][lane], q[1][lane], q[2][lane], q[3][lane]}, read.turns[j]));
    }
}

// A body far from the origin that waves all its joints, each walker otherwise.
inline void pose_waving(std::vector<PoseBlock>& poses, uint32_t walker, const BoneTree& tree, float seconds) {
    PoseBlock& block = poses[walker / k_block];
    const int lane = lane_of(walker);
    uint32_t drawn = 0;
    const auto draw = [&] { return random_unit({7, walker, 0, Purpose::style}, drawn++); };
    std::array<Vec3, k_joint_count> places;
    std::array<Quat, k_joint_count> turns;
    for (size_t j = 0; j < k_joint_count; ++j) {
        const float by = 0.5f * sin_cos(seconds * (2 + 5 * draw()) + 6 * draw()).sine;
        const Quat local = rotation_x(by) * rotation_y(by * draw()) * rotation_z(by * 0.3f);
        turns[j] = j == 0 ? rotation_y(seconds * draw() * 2) * local : turns[tree.parents[j]] * local;
        places[j] = j == 0 ? Vec3{seconds * 1.4f, 0.9f, 0.1f}
                           : places[tree.parents[j]] + rotate(turns[tree.parents[j]], tree.offsets[j]);
        for (int axis = 0; axis < 3; ++axis) block.position[j][axis][lane] = (&places[j].x)[axis];
        for (int axis = 0; axis < 4; ++axis) block.rotation[j][axis][lane] = (&turns[j].x)[axis];
    }
    block.origin[0][lane] = -12'345.5f + static_cast<float>(walker);
    block.origin[1][lane] = 12;
    block.origin[2][lane] = 9'876.25f;
}

}  // namespace flaneur
