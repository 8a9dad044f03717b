#include "sim/base/rng.h"
#include "sim/ik/solve.h"
#include "sim/linkages/linkages.h"
#include "tools/flaneur/bench/bench.h"

namespace flaneur {

namespace {

constexpr int k_iterations = 4;
constexpr float k_bone = 0.3f;  // metres
constexpr RandomKey k_key{1};

Vec3 random_place(uint32_t& at, float reach) {
    Vec3 p;
    for (float* f : {&p.x, &p.y, &p.z}) *f = random_between(k_key, -reach, reach, at++);
    return p;
}

Chains chains_of(size_t count) {
    constexpr int k_joints = 5;
    Chains chains = make_chains(k_joints, count, false);
    uint32_t at = 0;
    for (size_t c = 0; c < count; ++c) {
        size_t block = c / k_chain_block, lane = c % k_chain_block;
        for (int j = 0; j < k_joints; ++j) {
            float bent = j % 2 == 0 ? 0.0f : 0.05f;
            set_point(chains.places[block * k_joints + static_cast<size_t>(j)], lane,
                      {bent, k_bone * static_cast<float>(j), 0});
            if (j > 0) chains.bones[block * (k_joints - 1) + static_cast<size_t>(j) - 1].v[lane] = k_bone;
        }
        set_point(chains.targets[block], lane, random_place(at, 0.6f));
    }
    return chains;
}

// Four joints of a spine and two arms of three, each with a target.
Trees trees_of(size_t count) {
    const std::vector<int> parents = {-1, 0, 1, 2, 3, 4, 5, 3, 7, 8};
    const std::vector<int> effectors = {6, 9};
    TreeShape shape = *make_tree_shape(parents, effectors);
    Trees trees = make_trees(shape, count);
    uint32_t at = 0;
    for (size_t t = 0; t < count; ++t) {
        size_t block = t / k_chain_block, lane = t % k_chain_block;
        std::vector<Vec3> places(parents.size());
        for (size_t j = 0; j < parents.size(); ++j) {
            Vec3 bone = j == 0 ? Vec3{} : j < 4 ? Vec3{0, k_bone, 0} : Vec3{j < 7 ? k_bone : -k_bone, 0, 0};
            if (j > 0) places[j] = places[static_cast<size_t>(parents[j])] + bone;
            set_point(trees.places[block * parents.size() + j], lane, places[j]);
            trees.bones[block * parents.size() + j].v[lane] = j == 0 ? 0 : k_bone;
        }
        for (size_t e = 0; e < 2; ++e)
            set_point(trees.targets[block * 2 + e], lane, Vec3{0, 0.9f, 0} + random_place(at, 0.6f));
    }
    return trees;
}

// The same tree, whose tips are to be somewhere else in each.
Trees trees_like(const Linkage& f, size_t count) {
    const size_t joints = f.rest.size(), tips = f.leads.size();
    Trees trees = make_trees(f.shape, count);
    uint32_t at = 0;
    for (size_t t = 0; t < count; ++t) {
        const size_t block = t / k_chain_block, lane = t % k_chain_block;
        for (size_t j = 0; j < joints; ++j) {
            set_point(trees.places[block * joints + j], lane, f.rest[j]);
            trees.bones[block * joints + j].v[lane] = f.bones[j];
        }
        for (size_t e = 0; e < tips; ++e)
            set_point(trees.targets[block * tips + e], lane, f.leads[e].middle + random_place(at, 0.2f));
    }
    return trees;
}

}  // namespace

std::vector<Kernel> fabrik_kernels(size_t count) {
    // Solved again from where they were left: as many operations, whatever the places.
    return {{"FABRIK chain",
             [count, chains = chains_of(count)]() mutable {
                 return ns_each(count, [&] { solve_chains(chains, k_iterations); });
             },
             {27, 20, 15}},
            {"FABRIK tree",
             [count, trees = trees_of(count)]() mutable {
                 return ns_each(count, [&] { solve_trees(trees, k_iterations); });
             }},
            {"FABRIK tree of 64",
             [count, trees = trees_like(random_tree_linkage(64, k_bone, 1), count)]() mutable {
                 return ns_each(count, [&] { solve_trees(trees, k_iterations); });
             }}};
}

}  // namespace flaneur
