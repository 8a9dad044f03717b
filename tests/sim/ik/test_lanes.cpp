// Every solver on one lane and on many, with every instruction set that the CPU has: the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/sim/ik/test_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstring>

#include "sim/ik/aim-inl.h"
#include "sim/ik/fabrik_tree-inl.h"
#include "sim/ik/foot-inl.h"
#include "sim/ik/two_bone-inl.h"

#ifndef FLANEUR_TESTS_SIM_TEST_IK_LANES
#define FLANEUR_TESTS_SIM_TEST_IK_LANES
namespace flaneur {
struct alignas(64) Samples {
    float in[24][k_chain_block];
    float out[40][k_chain_block];
};
}  // namespace flaneur
#endif

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE void closed_forms(Samples& s, size_t lane) {
    T v[24];
    for (int k = 0; k < 24; ++k) load(v[k], s.in[k] + lane);
    int n = 0;
    auto put = [&](T value) { store(value, s.out[n++] + lane); };
    auto put_point = [&](V3<T> p) { put(p.x), put(p.y), put(p.z); };
    auto put_turn = [&](Q4<T> q) { put(q.x), put(q.y), put(q.z), put(q.w); };
    PosedLimb<T> limb = two_bone(V3<T>{v[3], v[4], v[5]}, half_yaw_to(v[6], v[7]),
                                 limb_sizes(abs(v[9]) + T(0.1f), abs(v[10]) + T(0.1f)), 1.0f, 0.05f);
    put_point(limb.middle);
    put_point(limb.end);
    put_turn(limb.upper_rot);
    put_turn(limb.lower_rot);
    constexpr AimJoint chain[2] = {{0.4f, 0.6f, 0.4f, 0.3f}, {0.6f, 0.9f, 0.5f, 0.5f}};
    Q4<T> turns[2];
    aim(chain, V3<T>{v[14], v[15], v[16]}, turns);
    put_turn(turns[0]);
    put_turn(turns[1]);
    put_turn(flat_on_ground(v[21] * T(0.6f), v[22] * T(0.6f), sin_cos(v[8] * T(3.0f))));
    V3<T> p[4] = {
        {T(0.0f), T(0.0f), T(0.0f)}, {v[9], v[10], v[11]}, {v[12], v[13], v[14]}, {v[15], v[16], v[17]}};
    T bones[3] = {T(0.3f), T(0.4f), abs(v[18]) + T(0.1f)};
    HingeLimit<T> limits[3] = {hinge_limit(T(-1.0f), T(1.0f)), hinge_limit(T(0.0f), T(2.0f)),
                               hinge_limit(v[19] - T(1.0f), v[19])};
    fabrik_hinged(p, bones, limits, V3<T>{T(1.0f), T(0.0f), T(0.0f)}, V3<T>{T(0.0f), T(-1.0f), T(0.0f)}, 4,
                  V3<T>{v[20], v[21], v[22]}, T(0.02f), 4);
    put_point(p[1]);
    put_point(p[3]);
}

void closed_forms_on_lanes(Samples& s) {
    for (size_t lane = 0; lane < k_chain_block; lane += lane_count()) closed_forms<Lanes>(s, lane);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include "sim/base/rng.h"

namespace flaneur {

HWY_EXPORT(closed_forms_on_lanes);

namespace {

using namespace HWY_NAMESPACE;
using Vector = V3<float>;

// Calls work(name) once with each instruction set.
template <class Work>
void on_every_instruction_set(Work work) {
    int tried = 0;
    for (auto target : {HWY_SCALAR, HWY_EMU128, HWY_SSSE3, HWY_SSE4, HWY_AVX2, HWY_AVX3, HWY_NEON}) {
        if (!(hwy::SupportedTargets() & target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        work(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(0);
        ++tried;
    }
    EXPECT_GE(tried, 1);
}

Vector point_from(RandomKey key, uint32_t k) {
    return {random_between(key, -1, 1, k), random_between(key, -1, 1, k + 1),
            random_between(key, -1, 1, k + 2)};
}
Vector get(const PointBlock& from, size_t lane) { return {from.x[lane], from.y[lane], from.z[lane]}; }
void set(PointBlock& to, size_t lane, Vector p) { set_point(to, lane, {p.x, p.y, p.z}); }
bool same(Vector a, Vector b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

TEST(IkLanes, ClosedFormsGiveTheSameBits) {
    for (uint32_t round = 0; round < 100; ++round) {
        Samples s{};
        for (uint32_t k = 0; k < 24; ++k) {
            for (uint32_t i = 0; i < k_chain_block; ++i)
                s.in[k][i] = random_between({51, i, round}, -1, 1, k);
        }
        for (size_t i = 0; i < k_chain_block; ++i) closed_forms<float>(s, i);
        on_every_instruction_set([&](const char* name) {
            Samples many = s;
            std::memset(many.out, 0, sizeof many.out);
            HWY_DYNAMIC_DISPATCH(closed_forms_on_lanes)(many);
            ASSERT_EQ(0, std::memcmp(many.out, s.out, sizeof s.out)) << name;
        });
    }
}

TEST(IkLanes, ChainsGiveTheSameBits) {
    for (bool limited : {false, true}) {
        constexpr int k_joints = 6;
        constexpr size_t k_chains = 1000;
        Chains chains = make_chains(k_joints, k_chains, limited);
        chains.soft = 0.02f;
        for (uint32_t i = 0; i < k_chains; ++i) {
            RandomKey key{52, i};
            size_t b = i / k_chain_block, lane = i % k_chain_block;
            for (uint32_t j = 0; j < k_joints; ++j)
                set(chains.places[b * k_joints + j], lane, point_from(key, j * 3));
            // A tenth of the chains lie straight on the line to their targets, a third cannot reach them.
            for (uint32_t j = 1; j < k_joints && i % 10 == 0; ++j) {
                set(chains.places[b * k_joints + j], lane,
                    get(chains.places[b * k_joints], lane) + Vector{0, -0.3f * static_cast<float>(j), 0});
            }
            set(chains.targets[b], lane,
                i % 10 == 0 ? get(chains.places[b * k_joints], lane) + Vector{0, -1, 0}
                            : point_from(key, 50) * 2.0f);
            for (uint32_t j = 0; j + 1 < k_joints; ++j) {
                chains.bones[b * (k_joints - 1) + j].v[lane] = random_between(key, 0.2f, 0.4f, 60 + j);
                if (limited)
                    chains.limits[b * (k_joints - 1) + j].v[lane] = random_between(key, 0, 0.9f, 70 + j);
            }
        }
        on_every_instruction_set([&](const char* name) {
            Chains many = chains;
            solve_chains(many, 5);
            for (size_t i = 0; i < k_chains; ++i) {
                size_t b = i / k_chain_block, lane = i % k_chain_block;
                Vector p[k_joints];
                float bones[k_joints], limits[k_joints];
                for (size_t j = 0; j < k_joints; ++j) p[j] = get(chains.places[b * k_joints + j], lane);
                for (size_t j = 0; j + 1 < k_joints; ++j) {
                    bones[j] = chains.bones[b * (k_joints - 1) + j].v[lane];
                    if (limited) limits[j] = chains.limits[b * (k_joints - 1) + j].v[lane];
                }
                Vector target = get(chains.targets[b], lane);
                if (limited) {
                    fabrik_limited(p, bones, limits, Vector{0, 1, 0}, k_joints, target, 0.02f, 5);
                } else {
                    fabrik(p, bones, k_joints, target, 0.02f, 5);
                }
                for (size_t j = 0; j < k_joints; ++j) {
                    ASSERT_TRUE(same(p[j], get(many.places[b * k_joints + j], lane))) << name << " " << i;
                }
            }
        });
    }
}

TEST(IkLanes, TreesGiveTheSameBits) {
    auto shape = make_tree_shape({-1, 0, 1, 2, 2, 4, 1, 6}, {3, 5});
    ASSERT_TRUE(shape);
    size_t joints = shape->parents.size();
    constexpr size_t k_trees = 500;
    Trees trees = make_trees(*shape, k_trees);
    for (uint32_t i = 0; i < k_trees; ++i) {
        RandomKey key{53, i};
        size_t b = i / k_chain_block, lane = i % k_chain_block;
        for (uint32_t j = 0; j < joints; ++j) {
            set(trees.places[b * joints + j], lane, point_from(key, j * 4));
            trees.bones[b * joints + j].v[lane] = random_between(key, 0.1f, 0.4f, j * 4 + 3);
        }
        for (uint32_t e = 0; e < 2; ++e) set(trees.targets[b * 2 + e], lane, point_from(key, 100 + 3 * e));
    }
    on_every_instruction_set([&](const char* name) {
        Trees many = trees;
        solve_trees(many, 5);
        for (size_t i = 0; i < k_trees; ++i) {
            size_t b = i / k_chain_block, lane = i % k_chain_block;
            std::vector<Vector> p(joints), offsets(joints), proposed(joints);
            std::vector<float> bones(joints);
            for (size_t j = 0; j < joints; ++j) {
                p[j] = get(trees.places[b * joints + j], lane);
                bones[j] = trees.bones[b * joints + j].v[lane];
            }
            Vector targets[2] = {get(trees.targets[b * 2], lane), get(trees.targets[b * 2 + 1], lane)};
            fabrik_tree(*shape, p.data(), bones.data(), targets, 5, offsets.data(), proposed.data());
            for (size_t j = 0; j < joints; ++j) {
                ASSERT_TRUE(same(p[j], get(many.places[b * joints + j], lane))) << name << " " << i;
            }
        }
    });
}

}  // namespace
}  // namespace flaneur
#endif
