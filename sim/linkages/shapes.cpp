// The linkages there are.
#include <algorithm>
#include <cassert>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/linkages/linkages.h"

namespace flaneur {

namespace {

// Adds a bone from joint `parent` by so much; returns its joint.
int add_bone(Linkage& f, std::vector<int>& parents, int parent, Vec3 by, float girth) {
    const Vec3 from = parent < 0 ? Vec3{} : f.rest[static_cast<size_t>(parent)];
    parents.push_back(parent);
    f.rest.push_back(from + by);
    f.bones.push_back(parent < 0 ? 0 : length(by));
    f.girth.push_back(girth);
    return static_cast<int>(parents.size()) - 1;
}

// Bones one after the other, thinner and thinner; returns the last joint.
int add_limb(Linkage& f, std::vector<int>& parents, int parent, std::initializer_list<Vec3> bones,
             float girth) {
    for (const Vec3 by : bones) {
        parent = add_bone(f, parents, parent, by, girth);
        girth *= 0.85f;
    }
    return parent;
}

// Leads begin where the ends rest, and stay.
void lead(Linkage& f, const std::vector<int>& parents, const std::vector<int>& effectors) {
    f.shape = *make_tree_shape(parents, effectors);
    for (const int joint : effectors) f.leads.push_back({.middle = f.rest[static_cast<size_t>(joint)]});
}

}  // namespace

Linkage chain_linkage(int joints, float bone, Solver solver) {
    Linkage f;
    f.method.solver = solver;
    f.name = k_solver_names[static_cast<size_t>(solver)];
    f.method.patience.iterations = 2000;
    std::vector<int> parents;
    const float girth = 0.16f * bone;
    int last = add_bone(f, parents, -1, {}, girth);
    for (int j = 1; j < joints; ++j) {
        // Out and back by an angle that grows and shrinks, so that the row is bowed.
        const float share = (static_cast<float>(j) - 0.5f) / static_cast<float>(joints - 1);
        const SinCos lean = sin_cos(0.4f * (0.5f - share));
        last = add_bone(f, parents, last, Vec3{0, lean.cosine, lean.sine} * bone, girth);
    }
    lead(f, parents, {last});
    return f;
}

Linkage cone_linkage(int joints, float bone, float most) {
    Linkage f = chain_linkage(joints, bone, Solver::fabrik);
    f.kind = Linkage::Kind::cones;
    f.name = "joints within cones";
    f.method.patience.iterations = 200;
    f.limits.assign(f.bones.size() - 1, sin_cos(most).cosine);
    f.recoil = 1;
    return f;
}

// Shares of a finger's length, and how far its joints bend, after the ranges that hand surgeons measure:
// knuckle 90 degrees and 20 back, middle joint 100, last joint 70.
Linkage finger_linkage(float length) {
    Linkage f;
    f.kind = Linkage::Kind::hinges;
    f.name = "a finger of hinges";
    f.recoil = 1;
    std::vector<int> parents;
    const float shares[] = {0.48f, 0.30f, 0.22f}, bent[] = {0.4f, 0.5f, 0.3f};
    int last = add_bone(f, parents, -1, {}, 0.11f * length);
    float angle = 0;
    for (size_t i = 0; i < std::size(shares); ++i) {
        angle += bent[i];
        const SinCos at = sin_cos(angle);
        last = add_bone(f, parents, last, Vec3{0, at.cosine, at.sine} * (shares[i] * length),
                        (0.11f - 0.015f * static_cast<float>(i)) * length);
    }
    f.limits = {-20 * k_radians, 90 * k_radians, 0, 100 * k_radians, 0, 70 * k_radians};
    lead(f, parents, {last});
    return f;
}

Linkage hand_linkage(float length) {
    Linkage f;
    f.kind = Linkage::Kind::tree;
    f.name = "a hand";
    f.recoil = 1;
    std::vector<int> parents, tips;
    const int wrist = add_bone(f, parents, -1, {}, 0.09f * length);
    struct Finger {
        float spread, palm, size;  // radians to the side; shares of the hand's length
    };
    for (const Finger finger : {Finger{-0.9f, 0.28f, 0.36f},
                                {-0.24f, 0.50f, 0.42f},
                                {-0.05f, 0.50f, 0.47f},
                                {0.13f, 0.47f, 0.43f},
                                {0.33f, 0.44f, 0.34f}}) {
        const SinCos to = sin_cos(finger.spread);
        const Vec3 ahead = Vec3{to.sine, to.cosine, 0} * length;
        auto bent = [&](float share, float angle) {
            const SinCos at = sin_cos(angle);
            return (ahead * at.cosine + Vec3{0, 0, length} * at.sine) * (share * finger.size);
        };
        tips.push_back(
            add_limb(f, parents, wrist,
                     {ahead * finger.palm, bent(0.48f, 0.15f), bent(0.30f, 0.45f), bent(0.22f, 0.7f)},
                     0.055f * length));
    }
    lead(f, parents, tips);
    return f;
}

// Shares of the body's height after Drillis and Contini (1966), as body.h has them.
Linkage body_linkage(float height) {
    Linkage f;
    f.kind = Linkage::Kind::tree;
    f.name = "a body by six targets";
    f.recoil = 1;
    std::vector<int> parents, ends;
    auto at = [&](float x, float y, float z) { return Vec3{x, y, z} * height; };
    const int pelvis = add_bone(f, parents, -1, {}, 0.065f * height);
    const int chest =
        add_limb(f, parents, pelvis, {at(0, 0.10f, 0.008f), at(0, 0.10f, 0.0f)}, 0.075f * height);
    ends.push_back(add_limb(f, parents, chest, {at(0, 0.09f, 0), at(0, 0.13f, 0.01f)}, 0.05f * height));
    for (const float side : {1.0f, -1.0f}) {
        ends.push_back(add_limb(
            f, parents, chest,
            {at(side * 0.11f, 0.06f, 0), at(side * 0.03f, -0.18f, -0.03f), at(side * 0.01f, -0.14f, 0.06f)},
            0.03f * height));
        ends.push_back(
            add_limb(f, parents, pelvis,
                     {at(side * 0.05f, -0.03f, 0), at(side * 0.01f, -0.24f, 0.03f), at(0, -0.24f, -0.03f)},
                     0.045f * height));
    }
    lead(f, parents, ends);
    return f;
}

Linkage octopus_linkage(int arm_bones, float arm_length) {
    constexpr int k_arms = 8;
    Linkage f;
    f.kind = Linkage::Kind::tree;
    f.name = "an octopus";
    std::vector<int> parents, tips;
    const int middle = add_bone(f, parents, -1, {}, 0.2f * arm_length);
    const float bone = arm_length / static_cast<float>(arm_bones);
    for (int arm = 0; arm < k_arms; ++arm) {
        const SinCos to = sin_cos(2 * k_pi * (static_cast<float>(arm) + 0.5f) / k_arms);
        int last = add_bone(f, parents, middle, Vec3{to.sine, -0.35f, to.cosine} * (0.16f * arm_length),
                            0.07f * arm_length);
        for (int i = 0; i < arm_bones; ++i) {
            const float share = static_cast<float>(i) / static_cast<float>(arm_bones);
            const SinCos down = sin_cos(lerp(0.3f, -0.9f, share));
            last = add_bone(f, parents, last,
                            Vec3{to.sine * down.cosine, down.sine, to.cosine * down.cosine} * bone,
                            lerp(0.06f, 0.018f, share) * arm_length);
        }
        tips.push_back(last);
    }
    lead(f, parents, tips);
    return f;
}

Linkage random_tree_linkage(int joints, float bone, uint64_t seed) {
    assert(joints >= 2 && joints <= k_most_chain_joints);
    constexpr int k_most_children = 3;
    Linkage f;
    f.kind = Linkage::Kind::tree;
    f.name = "a tree of " + std::to_string(joints) + " joints";
    const RandomKey key{seed, 0, 0, Purpose::city};
    std::vector<int> parents, children(static_cast<size_t>(joints));
    add_bone(f, parents, -1, {}, 0.2f * bone);
    uint32_t draw = 0;
    while (parents.size() < static_cast<size_t>(joints)) {
        // From one of the last few, so that branches are long; from whichever has room.
        const auto now = static_cast<uint32_t>(parents.size());
        const uint32_t back = std::min(now, 1 + static_cast<uint32_t>(random_unit(key, draw++) * 6));
        uint32_t parent = now - back;
        while (children[parent] == k_most_children) parent = (parent + 1) % now;
        ++children[parent];
        const Vec3 on =
            parent == 0
                ? Vec3{0, 1, 0}
                : normalize_or(f.rest[parent] - f.rest[static_cast<size_t>(parents[parent])], {0, 1, 0});
        Vec3 aside;
        for (float* x : {&aside.x, &aside.y, &aside.z}) *x = random_between(key, -0.8f, 0.8f, draw++);
        add_bone(f, parents, static_cast<int>(parent), normalize_or(on + aside, on) * bone,
                 f.girth[parent] * (parent == 0 ? 0.9f : 0.93f));
    }
    std::vector<int> tips;
    for (size_t j = 1; j < parents.size(); ++j)
        if (children[j] == 0) tips.push_back(static_cast<int>(j));
    lead(f, parents, tips);
    return f;
}

}  // namespace flaneur
