#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstring>
#include <limits>

#include "sim/animation/blend.h"
#include "tests/sim/allocations.h"
#include "tests/sim/random_poses.h"

namespace flaneur {
namespace {

using Kind = BlendNode::Kind;
const Skeleton k_person = humanoid(standard_body(1.7f));
constexpr size_t k_rows = local_rows(k_joint_count);

Clip clip_of(uint32_t seed, uint32_t keys, Curve curve = Curve::linear, float bend = 0.6f) {
    return *make_clip(k_person, random_poses(RandomKey{seed}, k_joint_count, bend, keys), 30, true, curve);
}

BlendNode clip_node(uint16_t clip, uint16_t input) {
    return {Kind::clip, Curve::linear, {input, 0}, clip, 1, 1};
}
BlendNode line(uint16_t first, uint16_t count, uint16_t input, Curve curve = Curve::linear) {
    return {Kind::grid, curve, {input, 0}, first, count, 1};
}

// Walk and run, each of two clips and a speed, blended by a third parameter; a sway and a gesture on top.
BlendTree big_tree() {
    BlendTree tree;
    for (uint32_t c = 0; c < 4; ++c) tree.clips.push_back(clip_of(c + 1, 10 + 3 * c, Curve(c % 2)));
    auto keys = random_poses(RandomKey{9}, k_joint_count, 0.3f, 20);
    tree.clips.push_back(*make_additive_clip(k_person, keys, keys[0], 30, true, Curve::cubic));
    tree.clips.push_back(clip_of(11, 7));
    tree.nodes = {line(1, 2, 2),   line(3, 2, 3),   line(5, 2, 4),   clip_node(0, 0), clip_node(1, 0),
                  clip_node(2, 1), clip_node(3, 1), clip_node(4, 1), clip_node(5, 0)};
    tree.layers = {{}, {7, true, 5, {}}, {8, false, 6, {}}};
    tree.layers[2].mask.assign(k_joint_count, 0);
    for (int j = left_shoulder; j <= left_hand; ++j) tree.layers[2].mask[size_t(j)] = 1;
    tree.inputs = 7;
    return tree;
}

std::vector<LaneRow> random_inputs(const BlendTree& tree, size_t blocks, uint32_t seed = 1) {
    std::vector<LaneRow> inputs(tree.inputs * blocks);
    uint32_t n = 0;
    for (LaneRow& row : inputs)
        for (float& f : row.lanes) f = random_between(RandomKey{seed}, 0, 1, n++);
    return inputs;
}

std::vector<LaneRow> evaluate(const BlendTree& tree, const std::vector<LaneRow>& inputs) {
    auto sound = check_tree(tree);
    EXPECT_TRUE(sound) << (sound ? "" : sound.error().message);
    size_t blocks = inputs.size() / tree.inputs;
    std::vector<LaneRow> out(blocks * k_rows);
    evaluate_blends(tree, inputs.data(), 0, blocks, out.data());
    return out;
}

Quat rotation_of(const std::vector<LaneRow>& rows, size_t joint, size_t i) {
    const LaneRow* r = rows.data() + i / k_block * k_rows + 4 * joint;
    size_t lane = i % k_block;
    return {r[0].lanes[lane], r[1].lanes[lane], r[2].lanes[lane], r[3].lanes[lane]};
}

Vec3 way_of(const std::vector<LaneRow>& rows, size_t i) {
    Quat q = rotation_of(rows, k_joint_count, i);
    return {q.x, q.y, q.z};
}

Quat sum(std::vector<std::pair<float, Quat>> terms) {
    Quat q{0, 0, 0, 0};
    for (auto [w, t] : terms) q = {q.x + w * t.x, q.y + w * t.y, q.z + w * t.z, q.w + w * t.w};
    return normalize(q);
}

TEST(Blend, OneClipIsItsSample) {
    for (Curve curve : {Curve::linear, Curve::cubic}) {
        BlendTree tree;
        tree.clips = {clip_of(1, 25, curve)};
        tree.nodes = {clip_node(0, 0)};
        tree.layers = {{}};
        tree.inputs = 1;
        auto inputs = random_inputs(tree, 1);
        auto out = evaluate(tree, inputs);
        for (size_t i = 0; i < k_block; ++i) {
            LocalPose pose = sample(tree.clips[0], inputs[0].lanes[i]);
            for (size_t j = 0; j < k_joint_count; ++j) {
                Quat lanes = rotation_of(out, j, i);
                ASSERT_EQ(0, std::memcmp(&lanes, &pose.rotations[j], sizeof lanes)) << "float and lanes";
            }
            ASSERT_EQ(way_of(out, i), pose.offset);
        }
    }
}

TEST(Blend, TreeOfTreesIsWhatAHandWouldReckon) {
    BlendTree tree = big_tree();
    tree.layers = {{}};
    tree.nodes.resize(7);
    auto inputs = random_inputs(tree, 1);
    auto out = evaluate(tree, inputs);
    for (size_t i = 0; i < k_block; ++i) {
        auto in = [&](size_t n) { return inputs[n].lanes[i]; };
        LocalPose leaves[4] = {sample(tree.clips[0], in(0)), sample(tree.clips[1], in(0)),
                               sample(tree.clips[2], in(1)), sample(tree.clips[3], in(1))};
        float run = in(2), fast_walk = in(3), fast_run = in(4);
        float shares[4] = {(1 - run) * (1 - fast_walk), (1 - run) * fast_walk, run * (1 - fast_run),
                           run * fast_run};
        for (size_t j = 0; j < k_joint_count; ++j) {
            std::vector<std::pair<float, Quat>> terms;
            for (size_t c = 0; c < 4; ++c) terms.push_back({shares[c], leaves[c].rotations[j]});
            // Samples are normalised here and sums of keys are not there: a hair's breadth.
            ASSERT_LT(angle_between(rotation_of(out, j, i), sum(terms)), 0.02f);
        }
        Vec3 way;
        for (size_t c = 0; c < 4; ++c) way += leaves[c].offset * shares[c];
        ASSERT_LT(length(way_of(out, i) - way), 1e-5f);
    }
}

TEST(Blend, LinesAndGridsPassThroughTheirPoses) {
    for (Curve curve : {Curve::linear, Curve::cubic}) {
        BlendTree tree;
        auto keys = random_poses(RandomKey{7}, k_joint_count, 1, 13);
        for (const LocalPose& key : keys)
            tree.clips.push_back(*make_clip(k_person, {key}, 1, false, Curve::linear));
        tree.nodes = {{Kind::grid, curve, {0, 1}, 1, 4, 3}};
        for (uint16_t n = 0; n < 12; ++n) tree.nodes.push_back(clip_node(n, 0));
        tree.layers = {{}};
        tree.inputs = 2;
        std::vector<LaneRow> inputs(2);
        for (size_t i = 0; i < 12; ++i) {
            inputs[0].lanes[i] = float(i % 4) / 3;
            inputs[1].lanes[i] = float(i / 4) / 2;
        }
        auto out = evaluate(tree, inputs);
        for (size_t i = 0; i < 12; ++i)
            for (size_t j = 0; j < k_joint_count; ++j)
                ASSERT_LT(angle_between(rotation_of(out, j, i), keys[i].rotations[j]), 1e-4f);

        tree.nodes = {line(1, 13, 0, curve)};
        for (uint16_t n = 0; n < 13; ++n) tree.nodes.push_back(clip_node(n, 0));
        Quat last = keys[0].rotations[spine];
        for (int step = 0; step <= 1200; ++step) {
            inputs[0].lanes[0] = float(step) / 1200;
            auto on = evaluate(tree, inputs);
            Quat now = rotation_of(on, spine, 0);
            ASSERT_LT(angle_between(last, now), 0.05f);
            if (step % 100 == 0) {
                ASSERT_LT(angle_between(now, keys[size_t(step) / 100].rotations[spine]), 1e-3f);
            }
            last = now;
        }
    }
}

TEST(Blend, NoWeightChangesNoBitAndMasksHold) {
    BlendTree tree = big_tree();
    auto inputs = random_inputs(tree, 1);
    BlendTree base = tree;
    base.layers.resize(1);
    base.nodes.resize(7);
    auto below = evaluate(base, inputs);

    auto silent = inputs;
    for (size_t input : {5, 6}) std::fill_n(silent[input].lanes, k_block, 0.0f);
    auto same = evaluate(tree, silent);
    EXPECT_EQ(0, std::memcmp(same.data(), below.data(), (4 * k_joint_count + 3) * sizeof(LaneRow)));

    auto gesture = inputs;
    std::fill_n(gesture[5].lanes, k_block, 0.0f);
    std::fill_n(gesture[6].lanes, k_block, 1.0f);
    auto masked = evaluate(tree, gesture);
    for (size_t i = 0; i < k_block; ++i) {
        LocalPose pose = sample(tree.clips[5], inputs[0].lanes[i]);
        for (size_t j = 0; j < k_joint_count; ++j) {
            Quat q = rotation_of(masked, j, i), old = rotation_of(below, j, i);
            if (tree.layers[2].mask[j] > 0) {
                ASSERT_LT(angle_between(q, pose.rotations[j]), 1e-5f);
            } else {
                ASSERT_EQ(0, std::memcmp(&q, &old, sizeof q));
            }
        }
        ASSERT_EQ(way_of(masked, i), way_of(below, i));
    }
}

// a - reference + reference = a.
TEST(Blend, ADifferenceLaidOnItsReferenceIsThePose) {
    auto keys = random_poses(RandomKey{8}, k_joint_count, 1, 6);
    LocalPose reference = random_pose(RandomKey{8}, k_joint_count, 1, 77);
    BlendTree tree;
    tree.clips = {*make_clip(k_person, {reference}, 1, false, Curve::linear),
                  *make_additive_clip(k_person, keys, reference, 30, true, Curve::linear)};
    tree.nodes = {clip_node(0, 0), clip_node(1, 0)};
    tree.layers = {{}, {1, true, 1, {}}};
    tree.inputs = 2;
    std::vector<LaneRow> inputs(2);
    for (size_t i = 0; i < k_block; ++i) inputs[0].lanes[i] = float(i % 6) / 6, inputs[1].lanes[i] = 1;
    auto out = evaluate(tree, inputs);
    for (size_t i = 0; i < k_block; ++i) {
        for (size_t j = 0; j < k_joint_count; ++j)
            ASSERT_LT(angle_between(rotation_of(out, j, i), keys[i % 6].rotations[j]), 3e-4f);
        ASSERT_LT(length(way_of(out, i) - keys[i % 6].offset), 5e-4f);
    }
}

TEST(Blend, SameBitsOnEveryInstructionSetAndNoAllocation) {
    BlendTree tree = big_tree();
    auto inputs = random_inputs(tree, 8);
    inputs[0].lanes[3] = std::numeric_limits<float>::quiet_NaN();
    inputs[2].lanes[4] = std::numeric_limits<float>::infinity();
    auto expected = evaluate(tree, inputs);
    for (size_t i = 0; i < 8 * k_block; ++i)
        for (size_t j = 0; j < k_joint_count; ++j) {
            Quat q = rotation_of(expected, j, i);
            ASSERT_NEAR(dot(q, q), 1, 1e-5f);
        }
    int tried = 0;
    std::vector<LaneRow> out(expected.size());
    for (auto target : {HWY_SCALAR, HWY_SSSE3, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
        if (!(hwy::SupportedTargets() & target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        uint64_t before = allocations();
        evaluate_blends(tree, inputs.data(), 0, 8, out.data());
        EXPECT_EQ(allocations(), before);
        hwy::SetSupportedTargetsForTest(0);
        for (size_t b = 0; b < 8; ++b)
            EXPECT_EQ(0, std::memcmp(&out[b * k_rows], &expected[b * k_rows],
                                     (4 * k_joint_count + 3) * sizeof(LaneRow)))
                << hwy::TargetName(target);
        ++tried;
    }
    EXPECT_GE(tried, 1);
}

TEST(Blend, RefusesBrokenTrees) {
    auto refusal = [](auto&& change) {
        BlendTree tree = big_tree();
        change(tree);
        auto sound = check_tree(tree);
        return sound ? std::string() : sound.error().message;
    };
    EXPECT_EQ(refusal([](BlendTree&) {}), "");
    EXPECT_NE(refusal([](BlendTree& t) { t.clips.clear(); }), "");
    EXPECT_NE(refusal([](BlendTree& t) { t.nodes[1].first = 0; }), "");
    EXPECT_NE(refusal([](BlendTree& t) { t.nodes[1].columns = 9; }), "");
    EXPECT_NE(refusal([](BlendTree& t) { t.nodes[1].first = 5; }).find("two parents"), std::string::npos);
    EXPECT_NE(refusal([](BlendTree& t) { t.nodes[2].columns = 1; }).find("no parent"), std::string::npos);
    EXPECT_NE(refusal([](BlendTree& t) { t.nodes[4].first = 6; }).find("clip"), std::string::npos);
    EXPECT_NE(refusal([](BlendTree& t) { t.inputs = 4; }).find("input"), std::string::npos);
    EXPECT_NE(refusal([](BlendTree& t) { t.layers[1].root = 8; }), "");
    EXPECT_NE(refusal([](BlendTree& t) { t.layers[2].mask.pop_back(); }).find("mask"), std::string::npos);
    EXPECT_NE(refusal([](BlendTree& t) { t.layers[2].weight = 7; }).find("weight"), std::string::npos);
}

}  // namespace
}  // namespace flaneur
