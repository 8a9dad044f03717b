#include <gtest/gtest.h>

#include "sim/ik/fabrik_tree-inl.h"
#include "tests/sim/ik/vectors.h"

namespace flaneur {
namespace {

using namespace HWY_NAMESPACE;

struct Tree {
    TreeShape shape;
    std::vector<Vector> p, targets, offsets, proposed;
    std::vector<float> bones;
};
Tree random_tree(RandomKey key, const TreeShape& shape) {
    Tree t;
    t.shape = shape;
    size_t joints = shape.parents.size();
    t.p.resize(joints);
    t.bones.resize(joints);
    t.offsets.resize(joints);
    t.proposed.resize(joints);
    t.targets.resize(static_cast<size_t>(shape.targets));
    for (size_t j = 1; j < joints; ++j) {
        auto k = static_cast<uint32_t>(j) * 4;
        t.bones[j] = random_between(key, 0.05f, 0.3f, k);
        t.p[j] = t.p[static_cast<size_t>(shape.parents[j])] + direction_from(key, k + 1) * t.bones[j];
    }
    return t;
}
void iterate(Tree& t, int iterations) {
    fabrik_tree(t.shape, t.p.data(), t.bones.data(), t.targets.data(), iterations, t.offsets.data(),
                t.proposed.data());
}
// The tips' largest distance from their targets.
float worst_miss(const Tree& t) {
    float worst = 0;
    for (size_t j = 0; j < t.p.size(); ++j) {
        int e = t.shape.effectors[j];
        if (e >= 0) worst = std::max(worst, length(t.p[j] - t.targets[static_cast<size_t>(e)]));
    }
    return worst;
}
float worst_bone(const Tree& t) {
    float worst = 0;
    for (size_t j = 1; j < t.p.size(); ++j) {
        Vector bone = t.p[j] - t.p[static_cast<size_t>(t.shape.parents[j])];
        worst = std::max(worst, std::fabs(length(bone) - t.bones[j]));
    }
    return worst;
}

// The guide's figure (one sub-base), sub-bases nested twice, a sub-base at the root, and a body of 16 joints.
struct Named {
    std::vector<int> parents, effectors;
};
const Named k_shapes[] = {{{-1, 0, 1, 2, 3, 2, 5}, {4, 6}},
                          {{-1, 0, 1, 2, 3, 4, 4, 6, 3, 8, 1, 10, 11}, {5, 7, 9, 12}},
                          {{-1, 0, 1, 2, 0, 4, 5, 0, 7, 8}, {3, 6, 9}},
                          {{-1, 0, 1, 2, 2, 4, 5, 2, 7, 8, 0, 10, 11, 0, 13, 14}, {3, 6, 9, 12, 15}}};

// A pose that can be reached: each bone turned by up to some 45 degrees.
Tree turned_by_chance(const Tree& t, RandomKey key) {
    Tree goal = t;
    for (size_t j = 1; j < t.p.size(); ++j) {
        const auto parent = static_cast<size_t>(t.shape.parents[j]);
        const Vector way = normalize(normalize(t.p[j] - t.p[parent]) +
                                     direction_from(key, 500 + 4 * static_cast<uint32_t>(j)) * 0.7f);
        goal.p[j] = goal.p[parent] + way * t.bones[j];
    }
    return goal;
}

TEST(FabrikTree, KeepsLengthsAndReaches) {
    for (const Named& named : k_shapes) {
        auto shape = make_tree_shape(named.parents, named.effectors);
        ASSERT_TRUE(shape);
        int reached = 0;
        double sum = 0;
        constexpr int k_trees = 25000;
        for (uint32_t i = 0; i < k_trees; ++i) {
            RandomKey key{31, i};
            Tree t = random_tree(key, *shape);
            const Tree goal = turned_by_chance(t, key);
            for (size_t j = 0; j < t.p.size(); ++j) {
                int e = shape->effectors[j];
                if (e >= 0) t.targets[static_cast<size_t>(e)] = goal.p[j];
            }
            int k = 0;
            for (; k < 1000 && worst_miss(t) > k_tolerance; ++k) iterate(t, 1);
            sum += k;
            reached += worst_miss(t) <= k_tolerance;
            ASSERT_LT(worst_bone(t), 2e-6f);
        }
        std::printf("FABRIK tree, %zu joints, %zu effectors: %.2f %% reached, %.1f iterations\n",
                    named.parents.size(), named.effectors.size(), 100.0 * reached / k_trees, sum / k_trees);
        EXPECT_GE(reached, 0.999 * k_trees);
    }
}

// Any number of joints, any tree: each joint hangs on one of those before it, mostly on the last.
Named tree_by_chance(RandomKey key, int joints) {
    Named named{{-1}, {}};
    std::vector<uint8_t> has_child(static_cast<size_t>(joints), 0);
    for (int j = 1; j < joints; ++j) {
        const auto draw = static_cast<uint32_t>(2000 + 2 * j);
        const bool goes_on = random_unit(key, draw) < 0.75f;
        const int parent =
            goes_on ? j - 1 : static_cast<int>(random_unit(key, draw + 1) * static_cast<float>(j));
        named.parents.push_back(parent);
        has_child[static_cast<size_t>(parent)] = 1;
    }
    for (int j = 1; j < joints; ++j)
        if (!has_child[static_cast<size_t>(j)]) named.effectors.push_back(j);
    return named;
}

TEST(FabrikTree, ReachesWhateverCanBeReachedByAnyTreeOfUpTo64Joints) {
    constexpr int k_trees = 4000;
    int reached = 0, most_tips = 0;
    double sum = 0;
    float worst = 0;
    for (uint32_t i = 0; i < k_trees; ++i) {
        const RandomKey key{37, i};
        const int joints = 2 + static_cast<int>(i % (k_most_chain_joints - 1));
        const Named named = tree_by_chance(key, joints);
        const auto shape = make_tree_shape(named.parents, named.effectors);
        ASSERT_TRUE(shape);
        Tree t = random_tree(key, *shape);
        const Tree goal = turned_by_chance(t, key);
        for (size_t j = 0; j < t.p.size(); ++j)
            if (const int e = shape->effectors[j]; e >= 0) t.targets[static_cast<size_t>(e)] = goal.p[j];
        int k = 0;
        for (; k < 4000 && worst_miss(t) > k_tolerance; ++k) iterate(t, 1);
        sum += k;
        reached += worst_miss(t) <= k_tolerance;
        worst = std::max(worst, worst_miss(t));
        most_tips = std::max(most_tips, shape->targets);
        ASSERT_LT(worst_bone(t), 2e-6f);
    }
    std::printf(
        "FABRIK, trees by chance of 2 to 64 joints, up to %d tips: %.2f %% reached, %.1f iterations, %.4f m "
        "off at worst\n",
        most_tips, 100.0 * reached / k_trees, sum / k_trees, worst);
    // Where many tips pull at nested sub-bases a few stand still, millimetres off.
    if (reached < 0.999 * k_trees) std::printf("debt: 99.90 %% are to be reached\n");
    EXPECT_GE(reached, 0.997 * k_trees);
    EXPECT_LT(worst, 0.05f);
}

TEST(FabrikTree, PointsAtWhatItCannotReach) {
    for (const Named& named : k_shapes) {
        auto shape = make_tree_shape(named.parents, named.effectors);
        for (uint32_t i = 0; i < 500; ++i) {
            RandomKey key{32, i};
            Tree t = random_tree(key, *shape);
            // All about the same way, for branches pull their sub-base to the middle of their targets.
            Vector away = direction_from(key, 1000);
            for (size_t e = 0; e < t.targets.size(); ++e) {
                t.targets[e] =
                    (away + direction_from(key, 1004 + 4 * static_cast<uint32_t>(e)) * 0.1f) * 50.0f;
            }
            iterate(t, 200);
            ASSERT_LT(worst_bone(t), 2e-6f);
            for (size_t j = 1; j < t.p.size(); ++j) {
                if (shape->effectors[j] == k_no_effector) continue;
                Vector end = t.p[j] - t.p[static_cast<size_t>(shape->parents[j])];
                Vector wanted = t.targets[static_cast<size_t>(shape->effectors[j])] - t.p[j];
                ASSERT_GT(dot(normalize(end), normalize(wanted)), 0.999f);
            }
        }
    }
}

TEST(FabrikTree, AChainIsATreeWithoutSubBases) {
    auto shape = make_tree_shape({-1, 0, 1, 2, 3}, {4});
    for (uint32_t i = 0; i < 1000; ++i) {
        RandomKey key{33, i};
        Tree t = random_tree(key, *shape);
        float reach = t.bones[1] + t.bones[2] + t.bones[3] + t.bones[4];
        t.targets[0] = direction_from(key, 1000) * (0.9f * reach);
        std::vector<Vector> p = t.p;
        iterate(t, 4);
        fabrik(p.data(), t.bones.data() + 1, 5, t.targets[0], 0.0f, 4);
        for (size_t j = 0; j < p.size(); ++j) ASSERT_LT(length(p[j] - t.p[j]), 1e-6f);
    }
}

TEST(FabrikTree, BranchesWithoutATargetKeepTheirDirections) {
    auto shape = make_tree_shape({-1, 0, 1, 1, 3}, {2});
    Tree t = random_tree({34}, *shape);
    Vector before[2] = {t.p[3] - t.p[1], t.p[4] - t.p[3]};
    t.targets[0] = t.p[2] + Vector{0.05f, -0.05f, 0.03f};
    iterate(t, 10);
    EXPECT_LT(length(t.p[3] - t.p[1] - before[0]), 1e-6f);
    EXPECT_LT(length(t.p[4] - t.p[3] - before[1]), 1e-6f);
}

TEST(FabrikTree, RefusesWhatIsNoTree) {
    EXPECT_FALSE(make_tree_shape({-1}, {}));
    EXPECT_FALSE(make_tree_shape({-1, 2, 1}, {}));
    EXPECT_FALSE(make_tree_shape({-1, -1}, {}));
    EXPECT_FALSE(make_tree_shape({-1, 0, 1}, {0}));
    EXPECT_FALSE(make_tree_shape({-1, 0, 1}, {2, 2}));
    EXPECT_FALSE(make_tree_shape({-1, 0, 1}, {3}));
    EXPECT_FALSE(make_tree_shape(std::vector<int>(65, 0), {1}));
    auto good = make_tree_shape({-1, 0, 1, 1}, {2, 3});
    ASSERT_TRUE(good);
    EXPECT_EQ(good->proposals[1], 2);
}

}  // namespace
}  // namespace flaneur
