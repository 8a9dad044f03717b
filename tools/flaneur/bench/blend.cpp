#include "sim/animation/blend.h"

#include "sim/base/rng.h"
#include "tools/flaneur/bench/bench.h"

namespace flaneur {

namespace {

// Two clips blended by one parameter, that with a third by another; all three always count.
BlendTree three_clips() {
    Skeleton person = humanoid(standard_body(1.7f));
    BlendTree tree;
    uint32_t at = 0;
    auto some = [&] { return random_between({1}, -0.3f, 0.3f, at++); };
    for (size_t keys : {40, 30, 100}) {
        std::vector<LocalPose> poses(keys);
        for (LocalPose& pose : poses) {
            for (int j = 0; j < k_joint_count; ++j)
                pose.rotations.push_back(normalize(Quat{some(), some(), some(), 1}));
            pose.offset = {some(), some(), some()};
        }
        tree.clips.push_back(*make_clip(person, poses, 30, true, Curve::linear));
    }
    using Kind = BlendNode::Kind;
    auto mix = [](uint16_t input, uint16_t first) {
        return BlendNode{Kind::grid, Curve::linear, {input, 0}, first, 2, 1};
    };
    auto play = [](uint16_t clip) { return BlendNode{Kind::clip, Curve::linear, {clip, 0}, clip, 1, 1}; };
    tree.nodes = {mix(3, 1), mix(4, 3), play(2), play(0), play(1)};
    tree.layers = {{}};
    tree.inputs = 5;
    return tree;
}

}  // namespace

Kernel blend_kernel(size_t walkers) {
    BlendTree tree = three_clips();
    size_t blocks = block_count(walkers);
    std::vector<LaneRow> inputs(blocks * tree.inputs), out(blocks * local_rows(k_joint_count));
    uint32_t at = 0;
    for (LaneRow& row : inputs) {
        for (float& f : row.lanes) f = random_unit({2}, at++);
    }
    auto ns = [=]() mutable {
        return ns_each(walkers, [&] { evaluate_blends(tree, inputs.data(), 0, blocks, out.data()); });
    };
    return {"blend tree, 3 clips", ns, {180, 100, 70}};
}

}  // namespace flaneur
