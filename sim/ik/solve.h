// Inverse kinematics for many chains and trees at once: FABRIK over blocks of k_chain_block chains that lie
// side by side, with the widest instruction set that the CPU has; the same bits on every one.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/result.h"
#include "sim/base/vec.h"

namespace flaneur {

inline constexpr int k_chain_block = 64;        // four vectors of the widest instruction set
inline constexpr int k_most_chain_joints = 64;  // of a chain or tree

struct alignas(64) LengthBlock {
    float v[k_chain_block];
};
struct alignas(64) PointBlock {
    float x[k_chain_block], y[k_chain_block], z[k_chain_block];
};
inline void set_point(PointBlock& to, size_t lane, Vec3 p) {
    to.x[lane] = p.x;
    to.y[lane] = p.y;
    to.z[lane] = p.z;
}

// `count` chains of the same number of joints. Chain c is lane c % k_chain_block of block c / k_chain_block;
// within a block joint follows joint. See fabrik-inl.h.
struct Chains {
    int joints = 0;  // of each chain
    size_t count = 0;
    float soft = 0;                   // metres before full extension from which a chain gives way
    std::vector<PointBlock> places;   // joint j of block b: [b * joints + j]; read and moved
    std::vector<LengthBlock> bones;   // bone i of block b: [b * (joints - 1) + i], metres
    std::vector<PointBlock> targets;  // one a block
    // With limits; both empty without.
    std::vector<LengthBlock> limits;  // as bones: cosine of the largest angle between bone i and the one
                                      // before; -1: free
    std::vector<PointBlock> axes;     // one a block: unit, the middle of bone 0's cone
};

// All lengths and places 0, all limits free. 2 <= joints <= k_most_chain_joints.
Chains make_chains(int joints, size_t count, bool limited);
void solve_chains(Chains& chains, int iterations);

// How the joints of a tree hang together, and which of them have targets.
inline constexpr int k_no_effector = -1;
struct TreeShape {
    std::vector<int> parents;    // of each joint; before it. Joint 0 is the root, its parent -1
    std::vector<int> effectors;  // of each joint: number of its target, or k_no_effector
    std::vector<int> proposals;  // of each joint: children that lead to an effector, itself counted as one
    int targets = 0;
};

// effectors[e] is the joint that goes for target e: any joint but the root, each once. Refuses more than
// k_most_chain_joints, parents that do not come before their children, and effectors that are none of the
// joints.
Result<TreeShape> make_tree_shape(const std::vector<int>& parents, const std::vector<int>& effectors);

// `count` trees of one shape, in blocks as Chains.
struct Trees {
    TreeShape shape;
    size_t count = 0;
    std::vector<PointBlock> places;   // joint j of block b: [b * joints + j]; read and moved
    std::vector<LengthBlock> bones;   // as places: from joint j to its parent, metres
    std::vector<PointBlock> targets;  // target e of block b: [b * shape.targets + e]
};

// All lengths and places 0.
Trees make_trees(const TreeShape& shape, size_t count);
void solve_trees(Trees& trees, int iterations);

}  // namespace flaneur
