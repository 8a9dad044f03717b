#include "assets/gltf/character/rig_tree.h"

#include <algorithm>
#include <utility>

namespace flaneur {

namespace {

// What has less of all weights has it by a slip of the brush.
constexpr float k_least_share = 1e-4f;

struct Flesh {
    std::vector<uint8_t> own, below;  // by joint: whether it carries flesh; whether it or one below does
};

Flesh flesh_of(const std::vector<RigJoint>& rig) {
    float total = 0;
    for (const RigJoint& joint : rig) total += joint.mass;
    Flesh flesh;
    for (const RigJoint& joint : rig) flesh.own.push_back(joint.mass > k_least_share * total);
    flesh.below = flesh.own;
    for (size_t j = rig.size(); j-- > 0;)
        if (rig[j].parent >= 0) flesh.below[size_t(rig[j].parent)] |= flesh.below[j];
    return flesh;
}

RigTree part_of(const std::vector<RigJoint>& rig, const std::vector<uint8_t>& wanted) {
    RigTree tree;
    std::vector<int> place(rig.size(), -1);
    for (size_t j = 0; j < rig.size(); ++j) {
        if (!wanted[j]) continue;
        place[j] = int(tree.joints.size());
        tree.joints.push_back(rig[j]);
        tree.original.push_back(int(j));
        int parent = rig[j].parent;
        while (parent >= 0 && place[size_t(parent)] < 0) parent = rig[size_t(parent)].parent;
        tree.joints.back().parent = parent < 0 ? -1 : place[size_t(parent)];
    }
    return tree;
}

float distance_to_segment(Vec3 p, Vec3 from, Vec3 to) {
    Vec3 bone = to - from;
    float along = dot(bone, bone) > 0 ? clamp(dot(p - from, bone) / dot(bone, bone), 0, 1) : 0;
    return length(p - from - bone * along);
}

// Where a piece without a parent is nearest to what is joined already.
struct Gap {
    int piece, to = -1;
    float distance = 1e30f;
};

// The tree's joints below `root`, each other piece below the joint whose bone is nearest to where it begins,
// the nearest pieces first; those that begin farther than `reach` from all are left out.
RigTree joined_at(const RigTree& tree, const std::vector<int>& roots, int root, float extent, float reach) {
    const std::vector<RigJoint>& joints = tree.joints;
    std::vector<std::vector<int>> children(joints.size());
    for (size_t j = 0; j < joints.size(); ++j)
        if (joints[j].parent >= 0) children[size_t(joints[j].parent)].push_back(int(j));
    std::vector<Gap> gaps;
    for (int piece : roots)
        if (piece != root) gaps.push_back({piece});
    RigTree out;
    auto take = [&](int piece, int parent) {
        std::vector<std::pair<int, int>> open = {{piece, parent}};
        for (size_t next = 0; next < open.size(); ++next) {
            auto [j, above] = open[next];
            int here = int(out.joints.size());
            out.joints.push_back(joints[size_t(j)]);
            out.joints.back().parent = above;
            out.original.push_back(tree.original[size_t(j)]);
            for (int child : children[size_t(j)]) open.push_back({child, here});
            Vec3 place = joints[size_t(j)].place;
            bool begins = next == 0 && children[size_t(j)].empty();  // a bone without length
            int owner = begins ? here : next == 0 ? -1 : above;
            Vec3 from = begins ? place : owner < 0 ? Vec3{} : out.joints[size_t(owner)].place;
            if (owner < 0) continue;
            for (Gap& gap : gaps) {
                float distance = distance_to_segment(joints[size_t(gap.piece)].place, from, place);
                // Of bones that meet there, the one that was joined first.
                if (distance < gap.distance - 1e-3f * extent) gap.distance = distance, gap.to = owner;
            }
        }
    };
    take(root, -1);
    while (!gaps.empty()) {
        auto nearest = std::min_element(gaps.begin(), gaps.end(),
                                        [](const Gap& a, const Gap& b) { return a.distance < b.distance; });
        Gap gap = *nearest;
        out.whole = gap.distance <= reach;
        if (!out.whole) break;
        gaps.erase(nearest);
        take(gap.piece, gap.to);
    }
    return out;
}

}  // namespace

std::vector<uint8_t> living_joints(const std::vector<RigJoint>& rig) {
    constexpr float k_beyond = 2.5f;  // how far a chain's end may lie, of the way to its flesh's middle
    Flesh flesh = flesh_of(rig);
    std::vector<uint8_t> living = flesh.below, carries_on(rig.size(), 0);
    std::vector<int> bone(rig.size(), -1);  // the last joint with flesh
    for (size_t j = 0; j < rig.size(); ++j)
        if (flesh.below[j] && rig[j].parent >= 0) carries_on[size_t(rig[j].parent)] = 1;
    for (size_t j = 0; j < rig.size(); ++j) {
        int parent = rig[j].parent;
        bone[j] = flesh.own[j] ? int(j) : parent < 0 ? -1 : bone[size_t(parent)];
        if (flesh.below[j] || parent < 0 || !living[size_t(parent)]) continue;
        bool ends = flesh.own[size_t(parent)] ? !carries_on[size_t(parent)] : !flesh.below[size_t(parent)];
        if (!ends) continue;
        const RigJoint& last = rig[size_t(bone[j])];
        living[j] =
            rig[j].made_up || length(rig[j].place - last.place) <= k_beyond * length(last.flesh - last.place);
    }
    return living;
}

void add_ends(std::vector<RigJoint>& rig) {
    size_t count = rig.size();
    std::vector<uint8_t> living = living_joints(rig), leaf(count, 1);
    for (size_t j = 0; j < count; ++j)
        if (rig[j].parent >= 0 && living[j]) leaf[size_t(rig[j].parent)] = 0;
    for (size_t j = 0; j < count; ++j) {
        if (!leaf[j] || !living[j] || rig[j].mass <= 0) continue;
        const RigJoint& last = rig[j];
        RigJoint end;
        end.parent = int(j);
        end.made_up = true;
        Vec3 bone = (last.flesh - last.place) * 1.8f;
        float longest =
            last.parent < 0 ? length(bone) : 1.2f * length(last.place - rig[size_t(last.parent)].place);
        if (length(bone) > longest) bone = bone * (longest / length(bone));
        end.place = end.flesh = last.place + bone;
        rig.push_back(std::move(end));
    }
}

RigTree living_tree(const std::vector<RigJoint>& rig) { return part_of(rig, living_joints(rig)); }

std::vector<RigTree> joined_trees(const RigTree& tree, Vec3 low, Vec3 high) {
    constexpr size_t k_most_roots = 4;
    constexpr float k_apart = 0.1f;  // of the mesh's diagonal
    Flesh flesh = flesh_of(tree.joints);
    std::vector<uint8_t> wanted = flesh.own;
    for (size_t j = 0; j < wanted.size(); ++j) wanted[j] |= !flesh.below[j];
    RigTree bare = part_of(tree.joints, wanted);
    for (int& original : bare.original) original = tree.original[size_t(original)];
    const std::vector<RigJoint>& joints = bare.joints;

    // Limbs and head spring from what lies about the middle.
    Vec3 middle = (low + high) * 0.5f;
    std::vector<int> roots, piece(joints.size());
    std::vector<std::pair<float, int>> order;
    for (size_t j = 0; j < joints.size(); ++j) {
        int parent = joints[j].parent;
        piece[j] = parent < 0 ? int(j) : piece[size_t(parent)];
        if (parent < 0) roots.push_back(int(j));
        if (joints[j].mass > 0)
            order.push_back({length(joints[j].place - middle) + length(joints[j].flesh - middle), piece[j]});
    }
    std::vector<RigTree> out;
    if (roots.size() < 2) return out;
    std::sort(order.begin(), order.end());
    std::vector<uint8_t> tried(joints.size(), 0);
    float extent = length(high - low);
    size_t count = 0;
    for (auto [far, root] : order) {
        if (std::exchange(tried[size_t(root)], 1)) continue;
        if (++count > k_most_roots) break;
        out.push_back(joined_at(bare, roots, root, extent, k_apart * extent));
        if (!out.back().whole) out.push_back(joined_at(bare, roots, root, extent, 1e30f));
    }
    return out;
}

}  // namespace flaneur
