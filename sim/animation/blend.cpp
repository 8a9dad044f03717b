#include "sim/animation/blend.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/animation/blend.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/animation/clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

using BlendTaps = TapList<4 * k_most_leaves>;

// What a key at distance `d` counts: Catmull-Rom's curve, or straight lines.
template <class T>
HWY_INLINE T key_weight(Curve curve, T d) {
    d = abs(d);
    T one = T(1.0f), zero = T(0.0f), away = T(2.0f) - d;
    if (curve == Curve::linear) return max(one - d, zero);
    T near = one + d * d * (T(1.5f) * d - T(2.5f));
    T far = T(0.5f) * away * away * (one - d);
    return select(d < one, near, select(d < T(2.0f), far, zero));
}

// What point `n` of `count` counts at `at`, in points. The curve stays at its ends: they are their own
// neighbours.
template <class T>
HWY_INLINE T point_weight(Curve curve, T at, size_t n, size_t count) {
    T distance = at - T(static_cast<float>(n));
    T weight = key_weight(curve, distance);
    if (curve == Curve::cubic && n == 0) weight = weight + key_weight(curve, distance + T(1.0f));
    if (curve == Curve::cubic && n + 1 == count) weight = weight + key_weight(curve, distance - T(1.0f));
    return weight;
}

HWY_INLINE Lanes point_at(const LaneRow* inputs, uint16_t input, size_t count, size_t lane) {
    Lanes value;
    load(value, inputs[input].lanes + lane);
    return clamp(value, Lanes(0.0f), Lanes(1.0f)) * Lanes(static_cast<float>(count - 1));
}

// Hands a grid's weights on to its children.
HWY_INLINE void spread(const BlendNode& node, const LaneRow* inputs, const LaneRow& weight,
                       LaneRow* weights) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        Lanes whole;
        load(whole, weight.lanes + lane);
        Lanes along = point_at(inputs, node.input[0], node.columns, lane);
        for (size_t r = 0; r < node.rows; ++r) {
            Lanes share = whole;
            if (node.rows > 1) {
                Lanes across = point_at(inputs, node.input[1], node.rows, lane);
                share = whole * point_weight(node.curve, across, r, node.rows);
            }
            for (size_t c = 0; c < node.columns; ++c)
                store(share * point_weight(node.curve, along, c, node.columns),
                      weights[node.first + r * node.columns + c].lanes + lane);
        }
    }
}

// What the characters of a block are made of, for one layer.
HWY_INLINE void collect_taps(const BlendTree& tree, size_t begin, size_t end, const LaneRow* inputs,
                             const LaneRow* weights, BlendTaps* lists) {
    for (size_t i = 0; i < k_block; ++i) lists[i].count = 0;
    for (size_t n = begin; n < end; ++n) {
        const BlendNode& node = tree.nodes[n];
        if (node.kind != BlendNode::Kind::clip) continue;
        const Clip& clip = tree.clips[node.first];
        LaneRow keys, fractions;
        for (size_t lane = 0; lane < k_block; lane += lane_count()) {
            Lanes phase;
            load(phase, inputs[node.input[0]].lanes + lane);
            KeyTime<Lanes> time = key_time(clip, phase);
            store(time.key, keys.lanes + lane);
            store(time.fraction, fractions.lanes + lane);
        }
        for (size_t i = 0; i < k_block; ++i)
            if (weights[n].lanes[i] != 0)
                add_taps(lists[i], clip, keys.lanes[i], fractions.lanes[i], weights[n].lanes[i]);
    }
}

HWY_INLINE Q4<Lanes> nlerp(Q4<Lanes> a, Q4<Lanes> b, Lanes t) {
    Lanes one = Lanes(1.0f), side = select(dot(a, b) < Lanes(0.0f), Lanes(-1.0f), one), s = one - t;
    t = t * side;
    return normalize_or_identity(
        Q4<Lanes>{a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t, a.w * s + b.w * t});
}

// Lays one joint's new rotation over the one below.
HWY_INLINE void lay_rotation(const BlendLayer& layer, float mask, const LaneRow& weight,
                             const float (*rows)[k_block], LaneRow* out) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        Lanes w, zero = Lanes(0.0f), one = Lanes(1.0f);
        load(w, weight.lanes + lane);
        w = clamp(w, zero, one) * Lanes(mask);
        Q4<Lanes> above = normalize_or_identity(load_rotation<Lanes>(rows, lane));
        Q4<Lanes> below = load_rotation<Lanes>(rows_of(out), lane);
        Q4<Lanes> laid = layer.additive
                             ? normalize_or_identity(below * nlerp({zero, zero, zero, one}, above, w))
                             : nlerp(below, above, w);
        auto none = w <= zero;
        store_rotation(Q4<Lanes>{select(none, below.x, laid.x), select(none, below.y, laid.y),
                                 select(none, below.z, laid.z), select(none, below.w, laid.w)},
                       rows_of(out), lane);
    }
}

HWY_INLINE void lay_offset(const BlendLayer& layer, float mask, const LaneRow& weight,
                           const float (*rows)[k_block], LaneRow* out) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        Lanes w, zero = Lanes(0.0f), one = Lanes(1.0f);
        load(w, weight.lanes + lane);
        w = clamp(w, zero, one) * Lanes(mask);
        V3<Lanes> above = load_place<Lanes>(rows, lane) * Lanes(k_offset_unit);
        V3<Lanes> below = load_place<Lanes>(rows_of(out), lane);
        V3<Lanes> laid = layer.additive ? below + above * w : lerp(below, above, w);
        auto none = w <= zero;
        store_place(V3<Lanes>{select(none, below.x, laid.x), select(none, below.y, laid.y),
                              select(none, below.z, laid.z)},
                    rows_of(out), lane);
    }
}

HWY_INLINE void put_base(const float (*rows)[k_block], bool is_offset, LaneRow* out) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        if (is_offset)
            store_place(load_place<Lanes>(rows, lane) * Lanes(k_offset_unit), rows_of(out), lane);
        else
            store_rotation(normalize_or_identity(load_rotation<Lanes>(rows, lane)), rows_of(out), lane);
    }
}

HWY_INLINE void evaluate_block(const BlendTree& tree, const LaneRow* inputs, LaneRow* out) {
    LaneRow weights[k_most_nodes];
    BlendTaps lists[k_block];
    size_t joints = tree.clips[0].joints;
    for (size_t l = 0; l < tree.layers.size(); ++l) {
        const BlendLayer& layer = tree.layers[l];
        size_t end = l + 1 < tree.layers.size() ? tree.layers[l + 1].root : tree.nodes.size();
        std::fill_n(weights[layer.root].lanes, k_block, 1.0f);
        for (size_t n = layer.root; n < end; ++n)
            if (tree.nodes[n].kind == BlendNode::Kind::grid)
                spread(tree.nodes[n], inputs, weights[n], weights);
        collect_taps(tree, layer.root, end, inputs, weights, lists);
        alignas(64) float rows[16][k_block];
        for (size_t j = 0; j <= joints; ++j) {  // the offset follows the last joint
            if (j % 4 == 0) sum_piece(lists, j / 4, rows);
            const auto* joint_rows = rows + 4 * (j % 4);
            LaneRow* to = out + 4 * j;
            float mask = layer.mask.empty() ? 1 : layer.mask[j < joints ? j : 0];
            if (l == 0)
                put_base(joint_rows, j == joints, to);
            else if (j < joints)
                lay_rotation(layer, mask, inputs[layer.weight], joint_rows, to);
            else
                lay_offset(layer, mask, inputs[layer.weight], joint_rows, to);
        }
    }
}

void evaluate_blends_here(const BlendTree& tree, const LaneRow* inputs, size_t begin, size_t end,
                          LaneRow* out) {
    size_t rows = local_rows(tree.clips[0].joints);
    for (size_t b = begin; b < end; ++b) evaluate_block(tree, inputs + b * tree.inputs, out + b * rows);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

namespace {

Result<void> check_node(const BlendTree& tree, size_t n, size_t end, std::vector<uint8_t>& has_parent) {
    const BlendNode& node = tree.nodes[n];
    std::string which = "node " + std::to_string(n);
    bool two = node.kind == BlendNode::Kind::grid && node.rows > 1;
    if (node.input[0] >= tree.inputs || (two && node.input[1] >= tree.inputs))
        return Error{which + " reads an input that is not there"};
    if (node.kind == BlendNode::Kind::clip) {
        if (node.first >= tree.clips.size()) return Error{which + " plays a clip that is not there"};
        return {};
    }
    size_t children = size_t(node.columns) * node.rows;
    if (children == 0 || node.first <= n || node.first + children > end)
        return Error{which + " needs children that lie behind it, in its own layer"};
    for (size_t c = node.first; c < node.first + children; ++c) {
        if (has_parent[c]) return Error{"node " + std::to_string(c) + " has two parents"};
        has_parent[c] = 1;
    }
    return {};
}

}  // namespace

Result<void> check_tree(const BlendTree& tree) {
    if (tree.clips.empty() || tree.layers.empty() || tree.nodes.empty() || tree.nodes.size() > k_most_nodes)
        return Error{"a blend tree needs a clip, a layer and 1 to " + std::to_string(k_most_nodes) +
                     " nodes"};
    for (const Clip& clip : tree.clips)
        if (clip.keys == 0 || clip.joints != tree.clips[0].joints)
            return Error{"the clips of a blend tree need one skeleton"};
    std::vector<uint8_t> has_parent(tree.nodes.size(), 0);
    for (size_t l = 0; l < tree.layers.size(); ++l) {
        const BlendLayer& layer = tree.layers[l];
        std::string which = "layer " + std::to_string(l);
        size_t end = l + 1 < tree.layers.size() ? tree.layers[l + 1].root : tree.nodes.size(), leaves = 0;
        if (layer.root >= end || (l == 0 && layer.root != 0))
            return Error{which + " has no nodes; sort the layers by their roots, the first from node 0"};
        if (l > 0 && layer.weight >= tree.inputs)
            return Error{which + " takes its weight from an input that is not there"};
        if (!layer.mask.empty() && layer.mask.size() != tree.clips[0].joints)
            return Error{which + " needs a mask of as many joints as its skeleton has, or none"};
        for (float m : layer.mask)
            if (!(m >= 0 && m <= 1)) return Error{which + " has a mask that is not in [0, 1]"};
        has_parent[layer.root] = 1;
        for (size_t n = layer.root; n < end; ++n) {
            if (!has_parent[n]) return Error{"node " + std::to_string(n) + " has no parent"};
            if (auto sound = check_node(tree, n, end, has_parent); !sound) return sound.error();
            leaves += tree.nodes[n].kind == BlendNode::Kind::clip;
        }
        if (leaves > k_most_leaves)
            return Error{which + " plays more than " + std::to_string(k_most_leaves) + " clips"};
    }
    return {};
}

HWY_EXPORT(evaluate_blends_here);

void evaluate_blends(const BlendTree& tree, const LaneRow* inputs, size_t begin, size_t end, LaneRow* out) {
    HWY_DYNAMIC_DISPATCH(evaluate_blends_here)(tree, inputs, begin, end, out);
}

}  // namespace flaneur
#endif
