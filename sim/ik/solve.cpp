#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/ik/solve.cpp"
#include "sim/ik/solve.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cassert>

#include "sim/ik/fabrik-inl.h"
#include "sim/ik/fabrik_tree-inl.h"
#include "sim/ik/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

HWY_INLINE V3<Wide> point_at(const PointBlock& from, size_t lane) {
    V3<Wide> p;
    load(p.x, from.x + lane);
    load(p.y, from.y + lane);
    load(p.z, from.z + lane);
    return p;
}
HWY_INLINE void store_point(V3<Wide> from, PointBlock& to, size_t lane) {
    store(from.x, to.x + lane);
    store(from.y, to.y + lane);
    store(from.z, to.z + lane);
}

void solve_chains_here(Chains& chains, int iterations) {
    int joints = chains.joints;
    auto stride = static_cast<size_t>(joints);
    V3<Wide> p[k_most_chain_joints];
    Wide bones[k_most_chain_joints], limits[k_most_chain_joints];
    for (size_t first = 0; first < chains.count; first += wide_count()) {
        size_t b = first / k_chain_block, lane = first % k_chain_block;
        PointBlock* places = chains.places.data() + b * stride;
        for (size_t j = 0; j < stride; ++j) p[j] = point_at(places[j], lane);
        for (size_t i = 0; i + 1 < stride; ++i) load(bones[i], chains.bones[b * (stride - 1) + i].v + lane);
        V3<Wide> target = point_at(chains.targets[b], lane);
        if (chains.limits.empty()) {
            fabrik(p, bones, joints, target, Wide(chains.soft), iterations);
        } else {
            for (size_t i = 0; i + 1 < stride; ++i) {
                load(limits[i], chains.limits[b * (stride - 1) + i].v + lane);
            }
            fabrik_limited(p, bones, limits, point_at(chains.axes[b], lane), joints, target,
                           Wide(chains.soft), iterations);
        }
        for (size_t j = 1; j < stride; ++j) store_point(p[j], places[j], lane);
    }
}

void solve_trees_here(Trees& trees, int iterations) {
    size_t stride = trees.shape.parents.size();
    auto targets_each = static_cast<size_t>(trees.shape.targets);
    V3<Wide> p[k_most_chain_joints], offsets[k_most_chain_joints], proposed[k_most_chain_joints],
        targets[k_most_chain_joints];
    Wide bones[k_most_chain_joints];
    for (size_t first = 0; first < trees.count; first += wide_count()) {
        size_t b = first / k_chain_block, lane = first % k_chain_block;
        PointBlock* places = trees.places.data() + b * stride;
        for (size_t j = 0; j < stride; ++j) {
            p[j] = point_at(places[j], lane);
            load(bones[j], trees.bones[b * stride + j].v + lane);
        }
        for (size_t e = 0; e < targets_each; ++e) {
            targets[e] = point_at(trees.targets[b * targets_each + e], lane);
        }
        fabrik_tree(trees.shape, p, bones, targets, iterations, offsets, proposed);
        for (size_t j = 1; j < stride; ++j) store_point(p[j], places[j], lane);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(solve_chains_here);
HWY_EXPORT(solve_trees_here);

Chains make_chains(int joints, size_t count, bool limited) {
    assert(joints >= 2 && joints <= k_most_chain_joints);
    size_t blocks = (count + k_chain_block - 1) / k_chain_block;
    auto stride = static_cast<size_t>(joints);
    Chains c;
    c.joints = joints;
    c.count = count;
    c.places.resize(blocks * stride);
    c.bones.resize(blocks * (stride - 1));
    c.targets.resize(blocks);
    if (!limited) return c;
    c.axes.resize(blocks);
    c.limits.resize(c.bones.size());
    for (PointBlock& axis : c.axes) {
        for (float& y : axis.y) y = 1;
    }
    for (LengthBlock& limit : c.limits) {
        for (float& cosine : limit.v) cosine = -1;
    }
    return c;
}

void solve_chains(Chains& chains, int iterations) {
    HWY_DYNAMIC_DISPATCH(solve_chains_here)(chains, iterations);
}

Result<TreeShape> make_tree_shape(const std::vector<int>& parents, const std::vector<int>& effectors) {
    auto joints = static_cast<int>(parents.size());
    if (joints < 2 || joints > k_most_chain_joints) {
        return Error{"A tree for inverse kinematics has " + std::to_string(joints) +
                     " joints; it takes 2 to " + std::to_string(k_most_chain_joints) + "."};
    }
    TreeShape shape;
    shape.parents = parents;
    shape.effectors.assign(parents.size(), k_no_effector);
    shape.proposals.assign(parents.size(), 0);
    shape.targets = static_cast<int>(effectors.size());
    shape.parents[0] = -1;
    for (int j = 1; j < joints; ++j) {
        if (parents[j] < 0 || parents[j] >= j) {
            return Error{"Joint " + std::to_string(j) + " of a tree for inverse kinematics has parent " +
                         std::to_string(parents[j]) + "; list parents before their children."};
        }
    }
    for (int e = 0; e < shape.targets; ++e) {
        int j = effectors[e];
        if (j < 1 || j >= joints || shape.effectors[j] != k_no_effector) {
            return Error{"End effector " + std::to_string(e) + " is joint " + std::to_string(j) +
                         "; name each joint but the root at most once."};
        }
        shape.effectors[j] = e;
        shape.proposals[j] = 1;
    }
    for (int j = joints - 1; j > 0; --j) {
        if (shape.proposals[j] > 0) ++shape.proposals[parents[j]];
    }
    return shape;
}

Trees make_trees(const TreeShape& shape, size_t count) {
    size_t blocks = (count + k_chain_block - 1) / k_chain_block;
    Trees t;
    t.shape = shape;
    t.count = count;
    t.places.resize(blocks * shape.parents.size());
    t.bones.resize(t.places.size());
    t.targets.resize(blocks * static_cast<size_t>(shape.targets));
    return t;
}

void solve_trees(Trees& trees, int iterations) { HWY_DYNAMIC_DISPATCH(solve_trees_here)(trees, iterations); }

}  // namespace flaneur
#endif
