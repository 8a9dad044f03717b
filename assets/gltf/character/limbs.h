// Pairs of limbs in a skeleton: which may be legs and which arms.
#pragma once

#include <string>
#include <vector>

#include "assets/gltf/character/rig.h"
#include "assets/gltf/character/rig_names.h"

namespace flaneur {

struct Rig {
    const std::vector<RigJoint>& joints;
    std::vector<std::vector<int>> children;  // by joint; the last entry holds the roots
    std::vector<float> reach;                // length of the longest chain below
    std::vector<int> size;                   // joints below, itself included
    std::vector<float> mass;                 // of it and all below
    std::vector<BoneKind> kind;
    Vec3 low, high;    // of the mesh
    float extent = 0;  // diagonal of the mesh

    int root() const { return int(joints.size()); }
    Vec3 place(int j) const { return joints[size_t(j)].place; }
    bool below(int j, int ancestor) const;
    // By joint: whether it is `ancestor` or below it.
    std::vector<uint8_t> subtree(int ancestor) const;
};

Rig make_rig(const std::vector<RigJoint>& joints, Vec3 low, Vec3 high);

// The longest chain from `start` down.
std::vector<int> longest_path(const Rig& rig, int start);

// Two limbs that spring from one joint and mirror each other.
struct LimbPair {
    int from, a, b;  // `from` may be the root
    float length;    // of the shorter, from the start of a or b
    float hints;     // names: positive for arms, negative for legs
};

Vec3 middle(const Rig& rig, const LimbPair& pair);  // of where they spring
Vec3 end_of(const Rig& rig, const LimbPair& pair);  // the middle of their ends

struct Limbs {
    LimbPair legs, arms;
    float score;
};

// Legs and arms of an upright body, the likeliest first and none that are much less likely. Refuses with the
// sentence that names what is missing.
Result<std::vector<Limbs>> find_limbs(const Rig& rig);

// The longest two legs, with no regard to arms. Refuses a skeleton without any.
Result<LimbPair> find_legs(const Rig& rig);

// "left ", "right " or nothing, by the name of the joint or of one below it.
std::string side_of(const Rig& rig, int start);

}  // namespace flaneur
