#include "assets/gltf/character/rig.h"

#include <algorithm>
#include <cmath>

#include "assets/gltf/character/facing.h"
#include "assets/gltf/character/limbs.h"
#include "assets/gltf/character/rig_carry.h"
#include "assets/gltf/character/rig_tree.h"

namespace flaneur {

namespace {

constexpr size_t k_longest_chain = 32;
// Of all flesh: so much may hang from none of the joints that were found before the rig is called in pieces.
constexpr float k_most_adrift = 0.002f;

float hint(const Rig& rig, int joint, BoneKind wanted) {
    BoneKind k = rig.kind[size_t(joint)];
    return k == wanted ? 0.8f : (k == BoneKind::none ? 0.0f : -0.8f);
}

// How unlike two lengths in the proportion `a / b = ratio` are: 0 for exactly so.
float misfit(float a, float b, float ratio) {
    float r = a / std::max(b * ratio, 1e-6f);
    return r > 1 ? r - 1 : 1 / std::max(r, 1e-3f) - 1;
}

struct RigFrame {
    Vec3 up;
    float floor, height;
    float level(Vec3 p) const { return (dot(p, up) - floor) / height; }
};

struct Chain {
    std::array<int, 4> joints = {k_not_found, k_not_found, k_not_found, k_not_found};
    float score = -1e9f;
};

// Hip, knee, ankle and, if there is one, the ball of the foot, along `path`.
Chain find_leg(const Rig& rig, const RigFrame& frame, const std::vector<int>& path) {
    Chain best;
    for (size_t i = 0; i < path.size(); ++i)
        for (size_t k = i + 1; k < path.size(); ++k)
            for (size_t n = k + 1; n < path.size(); ++n) {
                Vec3 hip = rig.place(path[i]), knee = rig.place(path[k]), ankle = rig.place(path[n]);
                float thigh = length(knee - hip), shank = length(ankle - knee);
                if (thigh < 0.05f * frame.height || shank < 0.05f * frame.height) continue;
                if (frame.level(ankle) >= frame.level(knee)) continue;
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
Chain find_arm(const Rig& rig, const RigFrame& frame, const std::vector<int>& path, Vec3 centre, Vec3 side) {
    Chain best;
    for (size_t i = 0; i < path.size(); ++i)
        for (size_t k = i + 1; k < path.size(); ++k)
            for (size_t n = k + 1; n < path.size(); ++n) {
                Vec3 shoulder = rig.place(path[i]), elbow = rig.place(path[k]), wrist = rig.place(path[n]);
                float upper = length(elbow - shoulder), fore = length(wrist - elbow);
                if (upper < 0.03f * frame.height || fore < 0.03f * frame.height) continue;
                float out = std::fabs(dot(shoulder - centre, side)) / frame.height;
                if (out < 0.03f) continue;                            // where clavicles spring
                float left_out = i > 1 ? 0.3f * float(i - 1) : 0.0f;  // between trunk and shoulder
                float fingers = rig.children[size_t(path[n])].size() > 1 ? 0.4f : 0.0f;
                float score = -misfit(upper, fore, 1.15f) -
                              4 * std::fabs((upper + fore) / frame.height - 0.32f) -
                              4 * std::fabs(out - 0.10f) - left_out + fingers +
                              hint(rig, path[i], BoneKind::upper_arm) +
                              hint(rig, path[k], BoneKind::lower_arm) + hint(rig, path[n], BoneKind::hand);
                if (score > best.score)
                    best = {{i > 0 ? path[i - 1] : k_not_found, path[i], path[k], path[n]}, score};
            }
    return best;
}

// The chain of joints from `from` down to `to`, without `from`; `from` may be the root.
std::vector<int> path_down(const Rig& rig, int from, int to) {
    std::vector<int> path;
    for (int j = to; j >= 0 && j != from && j != rig.root(); j = rig.joints[size_t(j)].parent)
        path.push_back(j);
    std::reverse(path.begin(), path.end());
    return path;
}

// The chains below a joint, itself included, the longest first: a strap or a sleeve may reach farther than a
// foot or a hand.
std::vector<std::vector<int>> paths_from(const Rig& rig, int start) {
    constexpr size_t k_most_paths = 8;
    std::vector<std::pair<float, std::vector<int>>> all;
    std::vector<uint8_t> in = rig.subtree(start);
    for (int leaf = start; leaf < rig.root(); ++leaf) {
        if (!in[size_t(leaf)] || !rig.children[size_t(leaf)].empty()) continue;
        std::vector<int> path = path_down(rig, rig.joints[size_t(start)].parent, leaf);
        float reach = 0;
        for (size_t n = 1; n < path.size(); ++n) reach += length(rig.place(path[n]) - rig.place(path[n - 1]));
        all.push_back({reach, std::move(path)});
    }
    std::stable_sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.first > b.first; });
    if (all.size() > k_most_paths) all.resize(k_most_paths);
    std::vector<std::vector<int>> paths;
    for (auto& [reach, path] : all) {
        if (path.size() > k_longest_chain) path.resize(k_longest_chain);
        paths.push_back(std::move(path));
    }
    return paths;
}

// The best of those that `find` finds along the chains below a joint; a longer one is given up for a much
// better one.
template <class Find>
Chain best_chain(const Rig& rig, int start, Find&& find) {
    constexpr float k_much_better = 0.3f;
    Chain best;
    for (const std::vector<int>& path : paths_from(rig, start)) {
        Chain chain = find(path);
        if (chain.score > best.score + k_much_better) best = chain;
    }
    return best;
}

// Where a leg's chain stops at the shin, the foot may stand elsewhere in the tree: the nearest low joint with
// flesh carries on.
std::vector<int> leg_path(const Rig& rig, const RigFrame& frame, const LimbPair& legs,
                          std::vector<int> path) {
    size_t real = path.size();  // without an end that only the flesh tells of
    while (real > 1 && rig.joints[size_t(path[real - 1])].mass <= 0) --real;
    float shin = frame.level(rig.place(path[real - 1]));
    if (shin < 0.12f) return path;
    int best = k_not_found;
    float best_distance = 0.25f * frame.height;
    for (int j = 0; j < rig.root(); ++j) {
        float level = frame.level(rig.place(j));
        bool foot = rig.joints[size_t(j)].mass > 0 && level < std::min(shin, 0.2f);
        if (rig.below(j, legs.a) || rig.below(j, legs.b) || !foot) continue;
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

// The joints from `from`, without it, to `to`, by the joint that is above both.
std::vector<int> path_between(const Rig& rig, int from, int to) {
    std::vector<int> path;
    for (int j = from; j >= 0 && j != rig.root(); j = rig.joints[size_t(j)].parent) {
        if (j != from) path.push_back(j);
        if (!rig.below(to, j)) continue;
        std::vector<int> rest = path_down(rig, j, to);
        path.insert(path.end(), rest.begin(), rest.end());
        return path;
    }
    return path_down(rig, rig.root(), to);
}

// `more` are joints that stand between the arms' parent and the shoulders.
void map_trunk(const Rig& rig, const RigFrame& frame, const Limbs& limbs, const std::vector<int>& more,
               RigMap& map) {
    int trunk_base = limbs.legs.from, trunk_top = limbs.arms.from;
    // Where the legs spring from the root, the trunk's own first joint is the hips.
    std::vector<int> trunk = path_between(rig, trunk_base, trunk_top);
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

// The head is the heaviest joint of the chain that rises from between the arms; what a name puts on one side
// is none. Joints of that chain below the shoulders belong to the trunk.
bool map_head(const Rig& rig, const RigFrame& frame, const Limbs& limbs, std::vector<int>& trunk,
              RigMap& map) {
    int best_child = k_not_found;
    float best_level = -1e9f;
    for (int child : rig.children[size_t(limbs.arms.from)]) {
        if (child == limbs.arms.a || child == limbs.arms.b || rig.below(limbs.legs.a, child) ||
            bone_side(rig.joints[size_t(child)].name) != 0)
            continue;
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
    std::vector<int> path = path_down(rig, limbs.arms.from, best);
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

// The coordinate axis within 20 degrees of v, else v.
Vec3 nearest_axis(Vec3 v) {
    for (Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        if (dot(v, axis) > 0.94f) return axis;
        if (dot(v, axis) < -0.94f) return -axis;
    }
    return v;
}

RigFrame upright_frame(Vec3 up, Vec3 low, Vec3 high) {
    RigFrame frame{up, 1e9f, 0};
    float top = -1e9f;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 p{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z};
        frame.floor = std::min(frame.floor, dot(p, up));
        top = std::max(top, dot(p, up));
    }
    frame.height = std::max(top - frame.floor, 1e-6f);
    return frame;
}

// The chains below a joint have one bone with flesh, and none has more.
bool is_one_bone(const Rig& rig, int start) {
    std::ptrdiff_t most = 0;
    for (const std::vector<int>& path : paths_from(rig, start))
        most = std::max(most, std::count_if(path.begin(), path.end(),
                                            [&](int j) { return rig.joints[size_t(j)].mass > 0; }));
    return most == 1;
}

std::string along(const Rig& rig, const std::string& limb, int start) {
    return "along its " + limb + (is_one_bone(rig, start) ? ", of one bone," : "") + " below joint '" +
           rig.joints[size_t(start)].name + "'";
}

// What a limb lacks that was not found whole; `where` names it and is empty for one that was.
Error not_whole(const char* joints, const std::array<std::string, 2>& where) {
    bool both = !where[0].empty() && !where[1].empty();
    return Error{std::string("no ") + joints + " were found " + where[0] + (both ? " nor " : "") + where[1]};
}

// A wrist that only the flesh tells of, or that lies beyond the other by a fifth of the forearm, as a
// knuckle does.
void drop_strange_wrist(const Rig& rig, std::array<Chain, 2>& arms) {
    auto forearm = [&](size_t s) {
        return length(rig.place(arms[s].joints[3]) - rig.place(arms[s].joints[2]));
    };
    auto made_up = [&](size_t s) { return rig.joints[size_t(arms[s].joints[3])].made_up; };
    std::array<bool, 2> strange{};
    for (size_t s : {0u, 1u})
        strange[s] = !made_up(1 - s) && (made_up(s) || forearm(s) > 1.2f * forearm(1 - s));
    for (size_t s : {0u, 1u})
        if (strange[s]) arms[s].joints[3] = k_not_found;
}

// Puts the one on the left first, by a joint and the next: limbs may spring from one place.
void put_left_first(const Rig& rig, Vec3 left, size_t joint, std::array<Chain, 2>& pair) {
    auto place = [&](const Chain& limb) {
        return rig.place(limb.joints[joint]) + rig.place(limb.joints[joint + 1]);
    };
    if (dot(place(pair[0]) - place(pair[1]), left) < 0) std::swap(pair[0], pair[1]);
}

// From one limb to the other, where they first are so far from each other: they may spring from one place.
Vec3 apart(const Rig& rig, const LimbPair& pair, float least) {
    std::vector<int> a = longest_path(rig, pair.a), b = longest_path(rig, pair.b);
    for (size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
        Vec3 gap = rig.place(a[n]) - rig.place(b[n]);
        if (length(gap) > least) return gap;
    }
    return rig.place(pair.a) - rig.place(pair.b);
}

struct Stance {
    RigFrame frame;
    Vec3 side;        // to one side or the other
    float score = 0;  // of both legs
};

// Maps the legs, and by them the way ahead. Indices are the tree's.
Result<Stance> map_legs(const Rig& rig, const LimbPair& pair, Vec3 up, RigMap& map) {
    map.joints.fill(k_not_found);
    map.up = up;
    Stance stance{upright_frame(up, rig.low, rig.high), {}};
    Vec3 across = apart(rig, pair, 0.01f * stance.frame.height);
    Vec3 side = nearest_axis(normalize_or(across - up * dot(across, up), {1, 0, 0}));
    stance.side = normalize_or(side - up * dot(side, up), {1, 0, 0});
    std::array<Chain, 2> legs;
    std::array<std::string, 2> lacks, whole;
    for (size_t s = 0; s < 2; ++s) {
        int start = s == 0 ? pair.a : pair.b;
        legs[s] = best_chain(rig, start, [&](const std::vector<int>& path) {
            return find_leg(rig, stance.frame, leg_path(rig, stance.frame, pair, path));
        });
        stance.score += legs[s].score;
        bool bends = legs[s].joints[0] != k_not_found && !is_one_bone(rig, start);
        if (!bends) lacks[s] = along(rig, side_of(rig, start) + "leg", start);
    }
    if (lacks != whole) return not_whole("hip, knee and ankle", lacks);
    if (legs[0].joints[2] == legs[1].joints[2]) return Error{"its two legs end in one foot"};

    Vec3 ahead = cross(stance.side, up);
    Facing facing = weigh_facing(rig, {legs[0].joints, legs[1].joints}, up, ahead, stance.frame.height);
    if (!facing.feet_tell)
        map.notes.push_back(
            "Its feet point nowhere; its facing follows what names, thumbs, eyes and knees tell.");
    map.ahead = facing.sure < 0 ? -ahead : ahead;
    map.left = cross(up, map.ahead);
    put_left_first(rig, map.left, 0, legs);
    for (size_t n = 0; n < 4; ++n) {
        map.joints[size_t(left_upper_leg) + n] = legs[0].joints[n];
        map.joints[size_t(right_upper_leg) + n] = legs[1].joints[n];
    }
    for (int toes : {left_toes, right_toes}) {
        int& joint = map.joints[size_t(toes)];
        if (joint != k_not_found && rig.mass[size_t(joint)] <= 0) joint = k_not_found;  // they move nothing
    }
    return stance;
}

Result<RigMap> map_limbs(const Rig& rig, const Limbs& limbs, float& score) {
    RigMap map;
    Vec3 trunk = middle(rig, limbs.arms) - end_of(rig, limbs.legs);
    auto stance = map_legs(rig, limbs.legs, nearest_axis(normalize_or(trunk, {0, 1, 0})), map);
    if (!stance) return stance.error();
    score = limbs.score + 0.5f * stance->score;

    const std::array<int, 2> starts = {limbs.arms.a, limbs.arms.b};
    bool a_is_left =
        dot(rig.place(longest_path(rig, starts[0]).back()) - rig.place(longest_path(rig, starts[1]).back()),
            map.left) > 0;
    std::array<Chain, 2> arms;
    std::array<std::string, 2> lacks, whole;
    for (size_t s = 0; s < 2; ++s) {
        arms[s] = best_chain(rig, starts[s], [&](const std::vector<int>& path) {
            return find_arm(rig, stance->frame, path, middle(rig, limbs.arms), stance->side);
        });
        score += 0.5f * arms[s].score;
        if (arms[s].joints[1] == k_not_found)
            lacks[s] = along(rig, (s == 0) == a_is_left ? "left arm" : "right arm", starts[s]);
    }
    if (lacks != whole) return not_whole("shoulder, elbow and wrist", lacks);
    drop_strange_wrist(rig, arms);
    put_left_first(rig, map.left, 1, arms);
    for (size_t n = 0; n < 4; ++n) {
        map.joints[size_t(left_shoulder) + n] = arms[0].joints[n];
        map.joints[size_t(right_shoulder) + n] = arms[1].joints[n];
    }
    std::vector<int> below_shoulders;
    if (!map_head(rig, stance->frame, limbs, below_shoulders, map))
        return Error{"no head was found above its shoulders"};
    map_trunk(rig, stance->frame, limbs, below_shoulders, map);
    return map;
}

// Two legs, and all else as one piece upon them.
Result<RigMap> map_walker(const RigTree& tree, Vec3 low, Vec3 high) {
    Rig rig = make_rig(tree.joints, low, high);
    auto pair = find_legs(rig);
    if (!pair) return pair.error();
    Vec3 up = nearest_axis(normalize_or(middle(rig, *pair) - end_of(rig, *pair), {0, 1, 0}));
    RigMap map;
    auto stance = map_legs(rig, *pair, up, map);
    if (!stance) return stance.error();
    if (pair->from != rig.root()) map.joints[hips] = pair->from;
    map.notes.push_back("It lacks arms or a head and walks on its legs, as it was forced to.");
    return map;
}

// Of all ways to see limbs in it the one that makes the likeliest body.
Result<RigMap> map_tree(const RigTree& tree, Vec3 low, Vec3 high) {
    Rig rig = make_rig(tree.joints, low, high);
    auto choices = find_limbs(rig);
    if (!choices) return choices.error();
    float best_score = 0;
    Result<RigMap> best = map_limbs(rig, choices->front(), best_score);
    for (size_t n = 1; n < choices->size(); ++n) {
        float score = 0;
        auto map = map_limbs(rig, (*choices)[n], score);
        if (map && (!best || score > best_score)) best = std::move(map), best_score = score;
    }
    return best;
}

}  // namespace

Result<RigMap> map_rig(const std::vector<RigJoint>& joints, Vec3 low, Vec3 high, bool force) {
    RigTree own = living_tree(joints);
    auto map = map_tree(own, low, high);
    if (map && settle(joints, own, *map) <= k_most_adrift) return map;
    bool has_limbs = !map && find_limbs(make_rig(own.joints, low, high));
    for (const RigTree& joined : joined_trees(own, low, high)) {
        auto other = map_tree(joined, low, high);
        if (!map && !other && !has_limbs && joined.whole) map = other;
        if (!other) continue;
        settle(joints, joined, *other);
        other->notes.push_back("Its skeleton is in pieces; they were joined where its bones meet.");
        return other;
    }
    if (map || !force) return map;
    auto walker = map_walker(own, low, high);
    if (walker) settle(joints, own, *walker);
    return walker;
}

}  // namespace flaneur
