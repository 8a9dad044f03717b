#include <cassert>

#include "sim/base/rng.h"
#include "sim/pose/blend.h"
#include "tools/flaneur/bench.h"

namespace flaneur {

namespace {

constexpr uint32_t k_keys = 30;

std::vector<LocalPose> random_keys(RandomKey key) {
    std::vector<LocalPose> keys(k_keys);
    uint32_t at = 0;
    auto some = [&] { return random_between(key, -0.3f, 0.3f, at++); };
    for (LocalPose& pose : keys) {
        for (int j = 0; j < k_joint_count; ++j)
            pose.rotations.push_back(normalize(Quat{some(), some(), some(), 1}));
        pose.way = {some(), some(), some()};
    }
    return keys;
}

// Two clips blended by one parameter, a third added; every walker at phases of its own.
BlendTree three_clips() {
    Skeleton person = humanoid(standard_body(1.7f));
    BlendTree tree;
    for (uint64_t c = 1; c <= 2; ++c)
        tree.clips.push_back(*make_clip(person, random_keys({c}), 30, true, Curve::linear));
    auto keys = random_keys({3});
    tree.clips.push_back(*make_additive_clip(person, keys, keys[0], 30, true, Curve::linear));
    using Kind = BlendNode::Kind;
    tree.nodes = {{Kind::grid, Curve::linear, {0, 0}, 1, 2, 1},
                  {Kind::clip, Curve::linear, {1, 0}, 0, 1, 1},
                  {Kind::clip, Curve::linear, {1, 0}, 1, 1, 1},
                  {Kind::clip, Curve::linear, {2, 0}, 2, 1, 1}};
    tree.layers = {{}, {3, true, 3, {}}};
    tree.inputs = 4;
    assert(check_tree(tree));
    return tree;
}

}  // namespace

Kernel blend_kernel(size_t walkers) {
    BlendTree tree = three_clips();
    size_t blocks = block_count(walkers);
    std::vector<LaneRow> inputs(blocks * tree.inputs), out(blocks * local_rows(k_joint_count));
    uint32_t at = 0;
    for (LaneRow& row : inputs) {
        for (float& f : row.lanes) f = random_unit({4}, at++);
    }
    auto ns = [=]() mutable {
        return ns_each(walkers, [&] { evaluate_blends(tree, inputs.data(), 0, blocks, out.data()); });
    };
    return {"blend tree, 3 clips", ns, {180, 100, 70}};
}

}  // namespace flaneur
