// Skeletons of any shape, and poses as local rotations, sixteen characters side by side.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/result.h"
#include "sim/pose/pose.h"

namespace flaneur {

// A hierarchy of joints and how it rests.
struct Skeleton {
    std::vector<int16_t> parents;  // before their children; joint 0 alone has k_no_parent
    std::vector<Vec3> places;      // at rest, metres, in the parent's axes; joint 0's in model space
    std::vector<Quat> rotations;   // at rest, against the parent
};

inline constexpr size_t k_most_joints = 1024;

// The 22 joints of `body`; its rest is the canonical pose.
Skeleton humanoid(const Body& body);

// Refuses, in a sentence, lists of unequal length, a parent that comes after its child, numbers that are not
// finite or rotations that are not unit.
Result<void> check_skeleton(const Skeleton& skeleton);

// A local pose of a block: four rows a joint for its rotation against its parent (vector part first), then
// three for the offset of joint 0 from its place at rest, metres, then padding.
constexpr size_t local_rows(size_t joints) { return (4 * joints + 3 + 15) / 16 * 16; }
constexpr size_t model_rows(size_t joints) { return 7 * joints; }

// Forward kinematics of one block. `model` has seven rows a joint: place (3) and rotation (4) in model space.
void model_pose(const Skeleton& skeleton, const LaneRow* local, LaneRow* model);

// The same for people, each with its own proportions: model space is where the person's canonical pose stands
// at the origin.
void world_pose(const PersonBlock& people, const LaneRow* local, PoseBlock& out);

// The local pose of people who are posed in the world. world_pose gives the joints back wherever each lies
// where its parent carries it.
void local_pose(const PersonBlock& people, const PoseBlock& poses, LaneRow* local);

}  // namespace flaneur
