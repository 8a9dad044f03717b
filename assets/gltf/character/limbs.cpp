#include "assets/gltf/character/limbs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>

namespace flaneur {

namespace {

// A skeleton may be made to have any number of limbs; people have few.
constexpr size_t k_most_children = 12, k_most_pairs = 128;
constexpr size_t k_most_choices = 8;
constexpr float k_much_less_likely = 1.5f;
// Cosine of the angle between legs and trunk, at most: short legs with long feet reach ahead as much as down.
constexpr float k_upright = -0.4f;

float limb_hints(const Rig& rig, int start) {
    float hints = 0;
    std::vector<uint8_t> in = rig.subtree(start);
    for (size_t j = 0; j < in.size(); ++j) {
        if (!in[j]) continue;
        BoneKind k = rig.kind[j];
        if (k == BoneKind::upper_arm || k == BoneKind::lower_arm || k == BoneKind::hand) hints += 1;
        if (k == BoneKind::upper_leg || k == BoneKind::lower_leg || k == BoneKind::foot ||
            k == BoneKind::toes)
            hints -= 1;
    }
    return clamp(hints, -1, 1);
}

// The `most` longest, in the order in which they stood.
template <class T, class Length>
void keep_longest(std::vector<T>& all, size_t most, Length&& length_of) {
    if (all.size() <= most) return;
    std::vector<float> lengths;
    lengths.reserve(all.size());
    for (const T& one : all) lengths.push_back(length_of(one));
    std::nth_element(lengths.begin(), lengths.begin() + std::ptrdiff_t(most), lengths.end(),
                     std::greater<>());
    float least = lengths[most];
    std::erase_if(all, [&](const T& one) { return length_of(one) < least; });
    if (all.size() > most) all.resize(most, all.front());
}

// 1 on the left, -1 on the right, by the first name along the chain that tells; 0 where names tell of
// neither, and nothing where there are none.
std::optional<int> chain_side(const Rig& rig, int start) {
    std::optional<int> side;
    for (int j : longest_path(rig, start)) {
        const std::string& name = rig.joints[size_t(j)].name;
        if (!name.empty() && side.value_or(0) == 0) side = bone_side(name);
    }
    return side;
}

// As long, and with as many joints or as much flesh: one of them may lack its hand. Where names tell left
// from right, one of each: a tail is no leg's like. What they tell to be one of each may be longer by what it
// holds.
bool mirrors(const Rig& rig, int a, int b) {
    float la = rig.reach[size_t(a)], lb = rig.reach[size_t(b)], alike = std::min(la, lb) / std::max(la, lb);
    if (std::max(la, lb) < 0.05f * rig.extent || alike < 0.4f) return false;
    auto side_of_a = chain_side(rig, a), side_of_b = chain_side(rig, b);
    // A copy may have kept the name of its original, and its side.
    bool named = side_of_a && side_of_b && *side_of_a != *side_of_b;
    if (named ? *side_of_a * *side_of_b >= 0 : alike < 0.65f) return false;
    Vec3 gap = rig.place(longest_path(rig, a).back()) - rig.place(longest_path(rig, b).back());
    if (length(gap) < 0.01f * rig.extent) return false;
    bool as_many = std::abs(rig.size[size_t(a)] - rig.size[size_t(b)]) <= 2 + rig.size[size_t(a)] / 3;
    float ma = rig.mass[size_t(a)], mb = rig.mass[size_t(b)];
    return as_many || (ma > 0.5f * mb && mb > 0.5f * ma);
}

std::vector<LimbPair> find_pairs(const Rig& rig) {
    std::vector<LimbPair> pairs;
    for (int from = 0; from <= rig.root(); ++from) {
        std::vector<int> below;
        for (int child : rig.children[size_t(from)])
            if (rig.reach[size_t(child)] > 0.03f * rig.extent) below.push_back(child);
        keep_longest(below, k_most_children, [&](int child) { return rig.reach[size_t(child)]; });
        for (size_t i = 0; i < below.size(); ++i)
            for (size_t k = i + 1; k < below.size(); ++k) {
                int a = below[i], b = below[k];
                if (mirrors(rig, a, b))
                    pairs.push_back({from, a, b, std::min(rig.reach[size_t(a)], rig.reach[size_t(b)]), 0});
            }
    }
    keep_longest(pairs, k_most_pairs, [](const LimbPair& p) { return p.length; });
    for (LimbPair& pair : pairs) pair.hints = (limb_hints(rig, pair.a) + limb_hints(rig, pair.b)) * 0.5f;
    return pairs;
}

// From one side to the other.
Vec3 across(const Rig& rig, const LimbPair& p) {
    Vec3 starts = rig.place(p.a) - rig.place(p.b);
    Vec3 ends = rig.place(longest_path(rig, p.a).back()) - rig.place(longest_path(rig, p.b).back());
    return normalize_or(starts + ends, {});
}

// What a pair of limbs is when there is no other to tell it from: legs reach the end of the mesh that they
// point to.
bool look_like_legs(const Rig& rig, const LimbPair& pair) {
    if (std::fabs(pair.hints) > 0.3f) return pair.hints < 0;
    Vec3 down = end_of(rig, pair) - middle(rig, pair);
    if (length(down) < 0.5f * pair.length) return false;
    Vec3 way = normalize_or(down, {});
    float least = 1e30f, most = -1e30f;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 p{corner & 1 ? rig.high.x : rig.low.x, corner & 2 ? rig.high.y : rig.low.y,
               corner & 4 ? rig.high.z : rig.low.z};
        least = std::min(least, dot(p, way)), most = std::max(most, dot(p, way));
    }
    return dot(end_of(rig, pair), way) > least + 0.85f * (most - least);
}

// The start of a limb that has no like: for an arm what reaches farthest to a side above the legs, for a leg
// what its name says.
int lone_limb(const Rig& rig, const LimbPair& pair, bool arm) {
    Vec3 side = across(rig, pair), centre = middle(rig, pair), down = end_of(rig, pair) - centre;
    auto out = [&](int j) { return std::fabs(dot(rig.place(j) - centre, side)); };
    int best = k_not_found;
    float farthest = 0.07f * rig.extent;
    for (int j = 0; j < rig.root(); ++j) {
        if (rig.below(j, pair.a) || rig.below(j, pair.b)) continue;
        bool long_enough = rig.reach[size_t(j)] > 0.3f * pair.length && !rig.below(pair.a, j);
        if (!arm && long_enough && limb_hints(rig, j) < -0.5f) return j;
        if (arm && dot(rig.place(j) - centre, down) < 0 && out(j) > farthest) farthest = out(j), best = j;
    }
    // Up to the trunk.
    for (int up = best; up >= 0 && out(up) > 0.02f * rig.extent && !rig.below(pair.a, up);
         up = rig.joints[size_t(up)].parent)
        best = up;
    return best != k_not_found && rig.reach[size_t(best)] > 0.3f * pair.length ? best : k_not_found;
}

Error missing_limbs(const Rig& rig, const std::vector<LimbPair>& pairs) {
    const std::string needs = "; a character needs both arms, both legs and a head";
    if (pairs.empty())
        return Error{
            "its skeleton has no pair of limbs: neither its left and right leg nor its left and right arm "
            "were found" +
            needs};
    const LimbPair& pair = *std::max_element(
        pairs.begin(), pairs.end(), [](const LimbPair& a, const LimbPair& b) { return a.length < b.length; });
    bool legs = look_like_legs(rig, pair);
    std::string has = legs ? "legs" : "arms", lacks = legs ? "arm" : "leg";
    int lone = lone_limb(rig, pair, legs);
    if (lone == k_not_found)
        return Error{"its skeleton has " + has + ", but neither its left nor its right " + lacks +
                     " was found" + needs + (legs ? ", unless --force lets it walk on its legs" : "")};
    std::string side = side_of(rig, lone);
    std::string other = side == "left " ? "right " : side == "right " ? "left " : "other ";
    return Error{"its skeleton has " + has + " and a " + side + lacks + ", at joint '" +
                 rig.joints[size_t(lone)].name + "', but its " + other + lacks + " was not found" + needs};
}

}  // namespace

bool Rig::below(int j, int ancestor) const {
    for (; j >= 0 && j != root(); j = joints[size_t(j)].parent)
        if (j == ancestor) return true;
    return ancestor == root();
}

std::vector<uint8_t> Rig::subtree(int ancestor) const {
    std::vector<uint8_t> in(joints.size(), 0);
    for (size_t j = 0; j < in.size(); ++j) {
        int parent = joints[j].parent;
        in[j] = int(j) == ancestor || (parent >= 0 && in[size_t(parent)]);
    }
    return in;
}

Rig make_rig(const std::vector<RigJoint>& joints, Vec3 low, Vec3 high) {
    Rig rig{joints, {}, {}, {}, {}, {}, low, high, std::max(length(high - low), 1e-6f)};
    size_t count = joints.size();
    rig.children.resize(count + 1);
    rig.reach.assign(count, 0);
    rig.size.assign(count, 1);
    for (size_t j = 0; j < count; ++j) {
        rig.kind.push_back(bone_kind(joints[j].name));
        rig.mass.push_back(joints[j].mass);
        rig.children[joints[j].parent < 0 ? count : size_t(joints[j].parent)].push_back(int(j));
    }
    for (size_t j = count; j-- > 0;) {
        int p = joints[j].parent;
        if (p < 0) continue;
        float step = length(joints[j].place - joints[size_t(p)].place);
        rig.reach[size_t(p)] = std::max(rig.reach[size_t(p)], step + rig.reach[j]);
        rig.size[size_t(p)] += rig.size[j];
        rig.mass[size_t(p)] += rig.mass[j];
    }
    return rig;
}

std::vector<int> longest_path(const Rig& rig, int start) {
    std::vector<int> path = {start};
    for (;;) {
        int at = path.back(), best = k_not_found;
        float best_length = -1;
        for (int child : rig.children[size_t(at)]) {
            float l = length(rig.place(child) - rig.place(at)) + rig.reach[size_t(child)];
            // Twist bones lie inside a limb; what carries the limb on has more below it.
            if (l > best_length) best_length = l, best = child;
        }
        if (best == k_not_found) return path;
        path.push_back(best);
    }
}

Vec3 middle(const Rig& rig, const LimbPair& p) { return (rig.place(p.a) + rig.place(p.b)) * 0.5f; }

Vec3 end_of(const Rig& rig, const LimbPair& p) {
    return (rig.place(longest_path(rig, p.a).back()) + rig.place(longest_path(rig, p.b).back())) * 0.5f;
}

std::string side_of(const Rig& rig, int start) {
    int side = chain_side(rig, start).value_or(0);
    return side > 0 ? "left " : side < 0 ? "right " : "";
}

Result<std::vector<Limbs>> find_limbs(const Rig& rig) {
    std::vector<LimbPair> pairs = find_pairs(rig);
    std::vector<Vec3> middles, ends, sides;
    for (const LimbPair& pair : pairs) {
        middles.push_back(middle(rig, pair));
        ends.push_back(end_of(rig, pair));
        sides.push_back(across(rig, pair));
    }
    std::vector<Limbs> choices;
    float best = -1e9f, best_cosine = 1;
    for (size_t l = 0; l < pairs.size(); ++l)
        for (size_t a = 0; a < pairs.size(); ++a) {
            const LimbPair &legs = pairs[l], &arms = pairs[a];
            if (l == a || rig.below(arms.a, legs.a) || rig.below(arms.a, legs.b) ||
                rig.below(legs.a, arms.a) || rig.below(legs.a, arms.b) || arms.b == legs.b)
                continue;
            if (arms.length < 0.3f * legs.length || legs.length < 0.2f * arms.length) continue;  // fingers
            if (arms.hints < -0.5f) continue;  // legs by name, of more than two
            Vec3 down = normalize_or(ends[l] - middles[l], {}),
                 trunk = normalize_or(middles[a] - middles[l], {});
            float cosine = dot(down, trunk);
            bool above = legs.from == rig.root() || rig.below(arms.from, legs.from);
            float arm = std::min(arms.length, 1.2f * legs.length);  // what is longer is a wing
            float score = -2 * cosine + (above ? 1.0f : 0.0f) + 1.5f * (arms.hints - legs.hints) +
                          2 * (legs.length + arm) / rig.extent;
            score -= std::fabs(dot(sides[a], trunk));  // one arm is no higher than the other
            if (score > best) best = score, best_cosine = cosine;
            if (cosine <= k_upright) choices.push_back({legs, arms, score});
        }
    if (best < -1e8f) return missing_limbs(rig, pairs);
    if (best_cosine > k_upright)
        return Error{
            "no arms, left or right, were found above its legs: the limbs do not belong to an upright body, "
            "which a character needs"};
    std::erase_if(choices, [&](const Limbs& limbs) { return limbs.score < best - k_much_less_likely; });
    std::stable_sort(choices.begin(), choices.end(),
                     [](const Limbs& x, const Limbs& y) { return x.score > y.score; });
    if (choices.size() > k_most_choices) choices.resize(k_most_choices, choices.front());
    return choices;
}

Result<LimbPair> find_legs(const Rig& rig) {
    std::vector<LimbPair> pairs = find_pairs(rig);
    std::erase_if(pairs, [&](const LimbPair& pair) { return !look_like_legs(rig, pair); });
    if (pairs.empty()) return Error{"its skeleton has no two legs to walk on"};
    return *std::max_element(pairs.begin(), pairs.end(),
                             [](const LimbPair& a, const LimbPair& b) { return a.length < b.length; });
}

}  // namespace flaneur
