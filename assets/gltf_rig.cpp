#include "assets/gltf_rig.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "assets/gltf_rig_names.h"

namespace flaneur {

namespace {

struct Rig {
    const std::vector<RigJoint>& joints;
    std::vector<std::vector<int>> children;  // by joint; the last entry holds the roots
    std::vector<float> reach;                // length of the longest chain below
    std::vector<int> size;                   // joints below, itself included
    std::vector<float> mass;                 // of it and all below
    std::vector<BoneKind> kind;
    float extent = 0;  // diagonal of the mesh

    int root() const { return int(joints.size()); }
    Vec3 place(int j) const { return joints[size_t(j)].place; }
    bool below(int j, int ancestor) const {
        for (; j >= 0 && j != root(); j = joints[size_t(j)].parent)
            if (j == ancestor) return true;
        return ancestor == root();
    }
    // By joint: whether it is `ancestor` or below it.
    std::vector<uint8_t> subtree(int ancestor) const {
        std::vector<uint8_t> in(joints.size(), 0);
        for (size_t j = 0; j < in.size(); ++j) {
            int parent = joints[j].parent;
            in[j] = int(j) == ancestor || (parent >= 0 && in[size_t(parent)]);
        }
        return in;
    }
};

// A skeleton may be made to have any number of limbs; people have few, and long ones.
constexpr size_t k_most_children = 12, k_most_pairs = 128, k_longest_chain = 32;

Rig make_rig(const std::vector<RigJoint>& joints, float extent) {
    Rig rig{joints, {}, {}, {}, {}, {}, extent};
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

// The longest chain from `start` down.
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

// Two limbs that spring from one joint and mirror each other.
struct Pair {
    int from, a, b;  // `from` may be the root
    float length;    // of the shorter, from the start of a or b
    float hints;     // names: positive for arms, negative for legs
};

float limb_hints(const Rig& rig, int start) {
    float hints = 0;
    std::vector<uint8_t> in = rig.subtree(start);
    for (size_t j = 0; j < in.size(); ++j) {
        if (!in[j]) continue;
        BoneKind k = rig.kind[j];
        if (k == BoneKind::upper_arm || k == BoneKind::lower_arm || k == BoneKind::hand) hints += 1;
        if (k == BoneKind::upper_leg || k == BoneKind::foot || k == BoneKind::toes) hints -= 1;
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

std::vector<Pair> find_pairs(const Rig& rig) {
    std::vector<Pair> pairs;
    for (int from = 0; from <= rig.root(); ++from) {
        std::vector<int> below;
        for (int child : rig.children[size_t(from)])
            if (rig.reach[size_t(child)] > 0.03f * rig.extent) below.push_back(child);
        keep_longest(below, k_most_children, [&](int child) { return rig.reach[size_t(child)]; });
        for (size_t i = 0; i < below.size(); ++i)
            for (size_t k = i + 1; k < below.size(); ++k) {
                int a = below[i], b = below[k];
                float la = rig.reach[size_t(a)], lb = rig.reach[size_t(b)], longer = std::max(la, lb);
                int sizes = std::abs(rig.size[size_t(a)] - rig.size[size_t(b)]);
                bool alike = std::min(la, lb) > 0.65f * longer && sizes <= 2 + rig.size[size_t(a)] / 3;
                Vec3 gap = rig.place(longest_path(rig, a).back()) - rig.place(longest_path(rig, b).back());
                bool apart = length(gap) > 0.01f * rig.extent;
                if (!alike || !apart || longer < 0.05f * rig.extent) continue;
                pairs.push_back({from, a, b, std::min(la, lb), 0});
            }
    }
    keep_longest(pairs, k_most_pairs, [](const Pair& p) { return p.length; });
    for (Pair& pair : pairs) pair.hints = limb_hints(rig, pair.a);
    return pairs;
}

Vec3 middle(const Rig& rig, const Pair& p) { return (rig.place(p.a) + rig.place(p.b)) * 0.5f; }

Vec3 end_of(const Rig& rig, const Pair& p) {
    return (rig.place(longest_path(rig, p.a).back()) + rig.place(longest_path(rig, p.b).back())) * 0.5f;
}

struct Limbs {
    Pair legs, arms;
};

Result<Limbs> find_limbs(const Rig& rig) {
    std::vector<Pair> pairs = find_pairs(rig);
    const Pair *best_legs = nullptr, *best_arms = nullptr;
    float best = -1e9f, best_cosine = 1;
    for (const Pair& legs : pairs)
        for (const Pair& arms : pairs) {
            if (&legs == &arms || rig.below(arms.a, legs.a) || rig.below(arms.a, legs.b) ||
                rig.below(legs.a, arms.a) || rig.below(legs.a, arms.b))
                continue;
            Vec3 down = end_of(rig, legs) - middle(rig, legs), trunk = middle(rig, arms) - middle(rig, legs);
            float cosine = dot(normalize_or(down, {}), normalize_or(trunk, {}));
            bool above = legs.from == rig.root() || rig.below(arms.from, legs.from);
            float score = -2 * cosine + (above ? 1.0f : 0.0f) + 1.5f * (arms.hints - legs.hints) +
                          2 * (legs.length + arms.length) / rig.extent;
            if (score > best) best = score, best_legs = &legs, best_arms = &arms, best_cosine = cosine;
        }
    if (pairs.empty())
        return Error{
            "its skeleton has no pair of limbs: neither legs nor arms were found; a character needs both, "
            "and a head"};
    if (!best_legs)
        return Error{
            "its skeleton has one pair of limbs only: legs or arms are missing; a character needs both, and "
            "a head"};
    if (best_cosine > -0.5f)
        return Error{
            "no arms were found above its legs: the limbs do not belong to an upright body, which a "
            "character needs"};
    return Limbs{*best_legs, *best_arms};
}

float hint(const Rig& rig, int joint, BoneKind wanted) {
    BoneKind k = rig.kind[size_t(joint)];
    return k == wanted ? 0.8f : (k == BoneKind::none ? 0.0f : -0.8f);
}

// How unlike two lengths in the proportion `a / b = ratio` are: 0 for exactly so.
float misfit(float a, float b, float ratio) {
    float r = a / std::max(b * ratio, 1e-6f);
    return r > 1 ? r - 1 : 1 / std::max(r, 1e-3f) - 1;
}

struct Frame {
    Vec3 up;
    float floor, height;
    float level(Vec3 p) const { return (dot(p, up) - floor) / height; }
};

struct Chain {
    int joints[4] = {k_not_found, k_not_found, k_not_found, k_not_found};
    float score = -1e9f;
};

// Hip, knee, ankle and, if there is one, the ball of the foot, along `path`.
Chain find_leg(const Rig& rig, const Frame& frame, const std::vector<int>& path) {
    Chain best;
    for (size_t i = 0; i < path.size(); ++i)
        for (size_t k = i + 1; k < path.size(); ++k)
            for (size_t n = k + 1; n < path.size(); ++n) {
                Vec3 hip = rig.place(path[i]), knee = rig.place(path[k]), ankle = rig.place(path[n]);
                float thigh = length(knee - hip), shank = length(ankle - knee);
                if (thigh < 0.05f * frame.height || shank < 0.05f * frame.height) continue;
                float level = frame.level(ankle) - 0.06f;
                float score = -misfit(thigh, shank, 1) - 5 * std::fabs(level) -
                              2 * std::fabs(frame.level(hip) - 0.5f) +
                              hint(rig, path[i], BoneKind::upper_leg) +
                              hint(rig, path[k], BoneKind::lower_leg) + hint(rig, path[n], BoneKind::foot);
                if (score <= best.score) continue;
                best = {{path[i], path[k], path[n], k_not_found}, score};
                for (size_t t = n + 1; t < path.size(); ++t)
                    if (length(rig.place(path[t]) - ankle) > 0.02f * frame.height) {
                        best.joints[3] = path[t];
                        break;
                    }
            }
    return best;
}

// Clavicle, if there is one, shoulder, elbow and wrist along `path`.
Chain find_arm(const Rig& rig, const Frame& frame, const std::vector<int>& path, Vec3 centre, Vec3 side) {
    Chain best;
    for (size_t i = 0; i < path.size(); ++i)
        for (size_t k = i + 1; k < path.size(); ++k)
            for (size_t n = k + 1; n < path.size(); ++n) {
                Vec3 shoulder = rig.place(path[i]), elbow = rig.place(path[k]), wrist = rig.place(path[n]);
                float upper = length(elbow - shoulder), fore = length(wrist - elbow);
                if (upper < 0.03f * frame.height || fore < 0.03f * frame.height) continue;
                float out = std::fabs(dot(shoulder - centre, side)) / frame.height;
                float fingers = rig.children[size_t(path[n])].size() > 1 ? 0.4f : 0.0f;
                float score = -misfit(upper, fore, 1.15f) -
                              4 * std::fabs((upper + fore) / frame.height - 0.32f) -
                              4 * std::fabs(out - 0.10f) + fingers + hint(rig, path[i], BoneKind::upper_arm) +
                              hint(rig, path[k], BoneKind::lower_arm) + hint(rig, path[n], BoneKind::hand);
                if (score > best.score)
                    best = {{i > 0 ? path[i - 1] : k_not_found, path[i], path[k], path[n]}, score};
            }
    return best;
}

// Where a leg's chain stops at the shin, the foot may stand elsewhere in the tree: the nearest low joint
// carries on.
std::vector<int> leg_path(const Rig& rig, const Frame& frame, const Pair& legs, int start) {
    std::vector<int> path = longest_path(rig, start);
    if (path.size() > k_longest_chain) path.resize(k_longest_chain);
    size_t real = path.size();  // without an end that only the flesh tells of
    while (real > 1 && rig.joints[size_t(path[real - 1])].mass <= 0) --real;
    if (frame.level(rig.place(path[real - 1])) < 0.12f) return path;
    int best = k_not_found;
    float best_distance = 0.25f * frame.height;
    for (int j = 0; j < rig.root(); ++j) {
        float level = frame.level(rig.place(j));
        bool foot = rig.joints[size_t(j)].mass > 0 || rig.kind[size_t(j)] == BoneKind::foot;
        if (rig.below(j, legs.a) || rig.below(j, legs.b) || level > 0.2f || !foot) continue;
        Vec3 away = rig.place(j) - rig.place(path.back());
        away = away - frame.up * dot(away, frame.up);
        float distance = length(away) - 0.2f * frame.height * level;  // the ankle rather than the toes
        if (distance < best_distance) best = j, best_distance = distance;
    }
    if (best == k_not_found) return path;
    path.resize(real);
    for (int j : longest_path(rig, best)) path.push_back(j);
    if (path.size() > k_longest_chain) path.resize(k_longest_chain);
    return path;
}

// The chain of joints from just above `from` to `to`, `to` included.
std::vector<int> path_up(const Rig& rig, int from, int to) {
    std::vector<int> path;
    for (int j = to; j >= 0 && j != from && j != rig.root(); j = rig.joints[size_t(j)].parent)
        path.push_back(j);
    std::reverse(path.begin(), path.end());
    return path;
}

// `more` are joints that stand between the arms' parent and the shoulders.
void map_trunk(const Rig& rig, const Frame& frame, const Limbs& limbs, const std::vector<int>& more,
               RigMap& map) {
    int trunk_base = limbs.legs.from, trunk_top = limbs.arms.from;
    // Where the legs spring from the root, the trunk's own first joint is the hips.
    std::vector<int> trunk = path_up(rig, trunk_base, trunk_top);
    trunk.insert(trunk.end(), more.begin(), more.end());
    float hip_level = frame.level(middle(rig, limbs.legs)), top_level = frame.level(middle(rig, limbs.arms));
    bool base_is_hips = trunk_base != rig.root() && frame.level(rig.place(trunk_base)) > 0.6f * hip_level;
    if (base_is_hips) {
        map.joints[hips] = trunk_base;
    } else {
        while (!trunk.empty() && frame.level(rig.place(trunk.front())) < 0.6f * hip_level)
            trunk.erase(trunk.begin());
        if (trunk.size() > 1) {
            map.joints[hips] = trunk.front();
            trunk.erase(trunk.begin());
        }
    }
    // The trunk's joints take the slots whose usual height they are nearest to, in order.
    constexpr std::array<float, 3> k_usual = {0.15f, 0.38f, 0.66f};  // from the hips to the shoulders
    size_t count = std::min<size_t>(trunk.size(), 3);
    if (trunk.size() > 3)  // the first, one in the middle, and the last
        trunk = {trunk.front(), trunk[trunk.size() / 2], trunk.back()};
    std::array<size_t, 3> slots = {0, 1, 2};
    if (count == 1 || count == 2) {
        float best = 1e9f;
        for (size_t a = 0; a < 3; ++a)
            for (size_t b = count == 2 ? a + 1 : a; b < (count == 2 ? 3 : a + 1); ++b) {
                auto off = [&](size_t n, size_t slot) {
                    float t = (frame.level(rig.place(trunk[n])) - hip_level) /
                              std::max(top_level - hip_level, 0.01f);
                    return std::fabs(t - k_usual[slot]);
                };
                float cost = off(0, a) + (count == 2 ? off(1, b) : 0);
                if (cost < best) best = cost, slots[0] = a, slots[1] = b;
            }
    }
    for (size_t n = 0; n < count; ++n) map.joints[size_t(spine) + slots[n]] = trunk[n];
}

// The head is the heaviest joint of the chain that rises from between the arms. Joints of that chain below
// the shoulders belong to the trunk.
bool map_head(const Rig& rig, const Frame& frame, const Limbs& limbs, std::vector<int>& trunk, RigMap& map) {
    int best_child = k_not_found;
    float best_level = -1e9f;
    for (int child : rig.children[size_t(limbs.arms.from)]) {
        if (child == limbs.arms.a || child == limbs.arms.b || rig.below(limbs.legs.a, child)) continue;
        float level = -1e9f;
        std::vector<uint8_t> in = rig.subtree(child);
        for (size_t j = 0; j < in.size(); ++j)
            if (in[j] && rig.joints[j].mass > 0) level = std::max(level, frame.level(rig.joints[j].flesh));
        if (level > best_level) best_level = level, best_child = child;
    }
    if (best_child == k_not_found || best_level < frame.level(middle(rig, limbs.arms))) return false;
    int best = k_not_found;
    float best_score = -1e9f;
    std::vector<uint8_t> in = rig.subtree(best_child);
    for (int j = best_child; j < rig.root(); ++j) {
        if (!in[size_t(j)] || rig.joints[size_t(j)].mass <= 0) continue;
        float below = rig.mass[size_t(j)];  // hair, eyes and jaw count for the head that carries them
        float own = rig.joints[size_t(j)].mass;
        float score = own + 0.5f * below + (rig.kind[size_t(j)] == BoneKind::head ? 1e6f : 0.0f);
        if (score > best_score) best_score = score, best = j;
    }
    map.joints[head] = best;
    std::vector<int> path = path_up(rig, limbs.arms.from, best);
    path.pop_back();
    float shoulders = frame.level(middle(rig, limbs.arms)) - 0.03f;
    for (int j : path) {
        if (frame.level(rig.place(j)) < shoulders)
            trunk.push_back(j);
        else if (map.joints[neck] == k_not_found)
            map.joints[neck] = j;
    }
    return true;
}

// Flesh of the foot and all below it, seen from the ankle.
Vec3 foot_lead(const Rig& rig, int ankle) {
    Vec3 sum;
    float mass = 0;
    for (int j = ankle; j < rig.root(); ++j) {
        if (!rig.below(j, ankle)) continue;
        const RigJoint& joint = rig.joints[size_t(j)];
        sum += joint.flesh * joint.mass;
        mass += joint.mass;
    }
    return mass > 0 ? sum / mass - rig.place(ankle) : Vec3{};
}

// The coordinate axis within 20 degrees of v, else v.
Vec3 nearest_axis(Vec3 v) {
    for (Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        if (dot(v, axis) > 0.94f) return axis;
        if (dot(v, axis) < -0.94f) return -axis;
    }
    return v;
}

Frame upright_frame(Vec3 up, Vec3 low, Vec3 high) {
    Frame frame{up, 1e9f, 0};
    float top = -1e9f;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 p{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z};
        frame.floor = std::min(frame.floor, dot(p, up));
        top = std::max(top, dot(p, up));
    }
    frame.height = std::max(top - frame.floor, 1e-6f);
    return frame;
}

}  // namespace

Result<RigMap> map_rig(const std::vector<RigJoint>& joints, Vec3 low, Vec3 high) {
    Rig rig = make_rig(joints, std::max(length(high - low), 1e-6f));
    auto limbs = find_limbs(rig);
    if (!limbs) return limbs.error();
    RigMap map;
    map.joints.fill(k_not_found);
    Vec3 trunk = middle(rig, limbs->arms) - end_of(rig, limbs->legs);
    map.up = nearest_axis(normalize_or(trunk, {0, 1, 0}));
    Frame frame = upright_frame(map.up, low, high);

    std::array<Chain, 2> legs, arms;
    Vec3 centre = middle(rig, limbs->arms);
    Vec3 across = rig.place(limbs->legs.a) - rig.place(limbs->legs.b);
    Vec3 side = nearest_axis(normalize_or(across - map.up * dot(across, map.up), {1, 0, 0}));
    side = normalize_or(side - map.up * dot(side, map.up), {1, 0, 0});
    for (size_t s = 0; s < 2; ++s) {
        int leg_start = s == 0 ? limbs->legs.a : limbs->legs.b,
            arm_start = s == 0 ? limbs->arms.a : limbs->arms.b;
        legs[s] = find_leg(rig, frame, leg_path(rig, frame, limbs->legs, leg_start));
        std::vector<int> arm = longest_path(rig, arm_start);
        if (arm.size() > k_longest_chain) arm.resize(k_longest_chain);
        arms[s] = find_arm(rig, frame, arm, centre, side);
        if (legs[s].joints[0] == k_not_found)
            return Error{"a leg with hip, knee and ankle was not found below joint '" +
                         joints[size_t(leg_start)].name + "'"};
        if (arms[s].joints[1] == k_not_found)
            return Error{"an arm with shoulder, elbow and wrist was not found below joint '" +
                         joints[size_t(arm_start)].name + "'"};
    }
    if (legs[0].joints[2] == legs[1].joints[2]) return Error{"its two legs end in one foot"};

    Vec3 ahead = cross(side, map.up);
    float lead = 0;
    for (const Chain& leg : legs) {
        lead += dot(foot_lead(rig, leg.joints[2]), ahead);
        if (leg.joints[3] != k_not_found)
            lead += 0.3f * dot(rig.place(leg.joints[3]) - rig.place(leg.joints[2]), ahead);
    }
    if (std::fabs(lead) < 0.01f * frame.height) {
        map.note =
            "Its feet point nowhere; its facing follows the names of its joints, if they tell left from "
            "right.";
        int side_of_a = bone_side(joints[size_t(limbs->legs.a)].name);
        if (side_of_a != 0) lead = float(side_of_a) * dot(cross(map.up, ahead), across);
    }
    if (lead < 0) ahead = -ahead;
    map.ahead = ahead;
    map.left = cross(map.up, ahead);
    auto sided = [&](std::array<Chain, 2>& pair, int joint) {
        bool swap = dot(rig.place(pair[0].joints[joint]) - rig.place(pair[1].joints[joint]), map.left) < 0;
        if (swap) std::swap(pair[0], pair[1]);
    };
    sided(legs, 0);
    sided(arms, 1);
    for (size_t n = 0; n < 4; ++n) {
        map.joints[size_t(left_upper_leg) + n] = legs[0].joints[n];
        map.joints[size_t(right_upper_leg) + n] = legs[1].joints[n];
        map.joints[size_t(left_shoulder) + n] = arms[0].joints[n];
        map.joints[size_t(right_shoulder) + n] = arms[1].joints[n];
    }
    for (int toes : {left_toes, right_toes}) {
        int& joint = map.joints[size_t(toes)];
        if (joint != k_not_found && rig.mass[size_t(joint)] <= 0) joint = k_not_found;  // they move nothing
    }
    std::vector<int> below_shoulders;
    if (!map_head(rig, frame, *limbs, below_shoulders, map))
        return Error{"no head was found above its shoulders"};
    map_trunk(rig, frame, *limbs, below_shoulders, map);
    return map;
}

}  // namespace flaneur
