#include <gtest/gtest.h>

#include <vector>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/linkages/linkages.h"

namespace flaneur {
namespace {

float worst_bone(const Linkage& f, std::span<const Vec3> places) {
    float worst = 0;
    for (size_t j = 1; j < places.size(); ++j)
        worst = std::max(
            worst,
            std::fabs(length(places[j] - places[static_cast<size_t>(f.shape.parents[j])]) - f.bones[j]));
    return worst;
}

// Each kind, its ends led about where they rest.
std::vector<Linkage> one_of_each() {
    std::vector<Linkage> all{chain_linkage(10, 0.2f, Solver::fabrik),
                             chain_linkage(3, 0.8f, Solver::two_bone),
                             cone_linkage(10, 0.2f, 0.5f),
                             finger_linkage(0.1f),
                             hand_linkage(0.2f),
                             body_linkage(1.75f),
                             octopus_linkage(6, 1),
                             random_tree_linkage(64, 0.2f, 7)};
    for (size_t i = 0; i < all.size(); ++i) {
        all[i].root.middle = {static_cast<float>(i) * 3, 1, 0};
        for (size_t e = 0; e < all[i].leads.size(); ++e) {
            Sway& lead = all[i].leads[e];
            const float reach = 0.03f * length(lead.middle);
            // A tree cannot shrink: its many tips go where it can.
            const bool is_dense = all[i].leads.size() > 8;
            lead.middle = lead.middle * (is_dense ? 0.98f : 0.8f) + all[i].root.middle;
            lead.reach = {reach, reach, reach};
            for (uint32_t axis = 0; axis < 3; ++axis) {
                lead.period[axis] = 100 + 17 * axis + 5 * static_cast<uint32_t>(e);
                lead.start[axis] = 31 * axis + 7 * static_cast<uint32_t>(e);
            }
        }
    }
    return all;
}

TEST(Linkages, KeepTheirBonesAndFollowTheirTargets) {
    Linkages linkages = make_linkages(one_of_each());
    WorkersPtr workers = make_workers(2);
    std::vector<int> missed(linkages.all.size());
    constexpr int k_ticks = 1200;
    for (uint32_t tick = 0; tick < k_ticks; ++tick) {
        step_linkages(linkages, *workers, tick);
        for (size_t i = 0; i < linkages.all.size(); ++i) {
            const Linkage& f = linkages.all[i];
            const std::span places = places_of(linkages, i);
            ASSERT_LT(worst_bone(f, places), 2e-5f) << f.name << " at " << tick;
            ASSERT_EQ(places[0], sway_at(f.root, tick + 1));
            missed[i] += linkages.solved[i].off > (f.leads.size() > 8 ? 0.15f : 0.005f);
        }
    }
    for (size_t i = 0; i < linkages.all.size(); ++i) {
        const bool is_limited =
            linkages.all[i].kind == Linkage::Kind::cones || linkages.all[i].kind == Linkage::Kind::hinges;
        EXPECT_LE(missed[i], is_limited ? k_ticks : 0) << linkages.all[i].name;
    }
}

TEST(Linkages, KeepWithinTheirLimits) {
    Linkages linkages = make_linkages(one_of_each());
    // As far as they are led.
    for (Linkage& f : linkages.all)
        for (Sway& lead : f.leads) lead.reach = lead.reach * 6;
    WorkersPtr workers = make_workers(1);
    float widest = 0, most_bent = -10, least_bent = 10, off_plane = 0;
    for (uint32_t tick = 0; tick < 1200; ++tick) {
        step_linkages(linkages, *workers, tick);
        for (size_t i = 0; i < linkages.all.size(); ++i) {
            const Linkage& f = linkages.all[i];
            const Vec3* p = linkages.places.data() + linkages.ranges[i].joints;
            Vec3 before = f.axis;
            for (size_t j = 1; j < f.rest.size(); ++j) {
                const Vec3 bone = normalize_or(p[j] - p[j - 1], {});
                if (f.kind == Linkage::Kind::cones) widest = std::max(widest, arccos(dot(before, bone)));
                if (f.kind == Linkage::Kind::hinges) {
                    const float bent = arctan2(dot(cross(before, bone), f.hinge), dot(before, bone));
                    most_bent = std::max(most_bent, bent - f.limits[2 * j - 1]);
                    least_bent = std::min(least_bent, bent - f.limits[2 * j - 2]);
                    off_plane = std::max(off_plane, std::fabs(dot(bone, f.hinge)));
                }
                before = bone;
            }
        }
    }
    EXPECT_LT(widest, 0.5f + 2e-3f);
    EXPECT_GT(widest, 0.45f);
    EXPECT_LT(most_bent, 2e-3f);
    EXPECT_GT(least_bent, -2e-3f);
    EXPECT_GT(most_bent, -0.1f);
    EXPECT_LT(off_plane, 1e-5f);
}

TEST(Linkages, AreTheSameOnEveryNumberOfThreads) {
    std::vector<Vec3> places[2];
    for (int threads : {1, 3}) {
        Linkages linkages = make_linkages(one_of_each());
        WorkersPtr workers = make_workers(threads);
        for (uint32_t tick = 0; tick < 300; ++tick) step_linkages(linkages, *workers, tick);
        places[threads > 1] = linkages.places;
    }
    EXPECT_EQ(places[0], places[1]);
}

// Whoever is held is there, to the bit; who was let go of is back where it sways, and never faster than it
// may.
TEST(Linkages, TargetsStayWhereTheyAreHeldAndGoBackWithoutAJump) {
    Linkages held = make_linkages(one_of_each()), free = make_linkages(one_of_each());
    WorkersPtr workers = make_workers(2);
    const float most = k_return_speed * k_tick * 1.0001f;
    for (uint32_t tick = 0; tick < 600; ++tick) {
        const bool is_held = tick >= 100 && tick < 300;
        for (size_t t = 0; t < held.held.size(); t += 2) {
            Vec3 place;
            uint32_t draw = 0;
            for (float* x : {&place.x, &place.y, &place.z})
                *x = random_between({tick / 50, static_cast<uint32_t>(t)}, -2, 2, draw++);
            held.held[t] = {free.targets[t] + place, is_held};
        }
        step_linkages(held, *workers, tick);
        step_linkages(free, *workers, tick);
        for (size_t t = 0; t < held.held.size(); ++t) {
            if (held.held[t].is_held) {
                ASSERT_EQ(held.targets[t], held.held[t].place);
            } else if (tick >= 300) {
                ASSERT_LE(length(held.targets[t] - held.previous_targets[t]), most) << t << " in " << tick;
            }
        }
    }
    EXPECT_EQ(held.targets, free.targets);
}

// Each chain follows by each method that it takes; what it does not take is refused.
TEST(Linkages, ChainsFollowByEveryMethodThatTheyTake) {
    WorkersPtr workers = make_workers(1);
    for (const int joints : {3, 10}) {
        int taken = 0;
        for (uint32_t s = 0; s < k_solver_count; ++s) {
            Linkage chain = chain_linkage(joints, 0.2f, Solver::fabrik);
            chain.leads[0].middle = chain.rest.back() * 0.7f;
            chain.leads[0].reach = {0.1f, 0.05f, 0.1f};
            for (uint32_t& period : chain.leads[0].period) period = 240;
            const Method method{static_cast<Solver>(s), {0.001f, 500}};
            if (!takes(chain, method)) continue;
            ++taken;
            Linkages linkages = make_linkages({chain});
            linkages.methods[0] = method;
            for (uint32_t tick = 0; tick < 480; ++tick) {
                step_linkages(linkages, *workers, tick);
                ASSERT_LE(linkages.solved[0].off, 0.001f) << k_solver_names[s] << " in " << tick;
            }
        }
        EXPECT_EQ(taken, joints == 3 ? 5 : 4);
    }
    const Linkage hand = hand_linkage(1);
    EXPECT_TRUE(takes(hand, {Solver::fabrik, {0.01f, 1}}));
    EXPECT_FALSE(takes(hand, {Solver::ccd, {0.01f, 1}}));
    EXPECT_FALSE(takes(hand, {Solver::fabrik, {0.0f, 1}}));
    EXPECT_FALSE(takes(hand, {Solver::fabrik, {0.01f, 0}}));
}

// Each tick a hundredth of the way to rest: what curled up opens again, and bones keep their lengths.
TEST(Linkages, WhatRecoilsDoesNotStayCurledUp) {
    WorkersPtr workers = make_workers(1);
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        Linkage chain = chain_linkage(10, 0.2f, Solver::fabrik);
        chain.recoil = 0.03f;
        Linkages linkages = make_linkages({chain});
        for (size_t j = 1; j < 10; ++j) {
            Vec3 by;
            uint32_t draw = 0;
            for (float* x : {&by.x, &by.y, &by.z})
                *x = random_between({seed, static_cast<uint32_t>(j)}, -1, 1, draw++);
            linkages.places[j] = linkages.places[j - 1] + normalize_or(by, {0, 1, 0}) * 0.2f;
        }
        for (uint32_t tick = 0; tick < 600; ++tick) {
            step_linkages(linkages, *workers, tick);
            ASSERT_LT(worst_bone(chain, places_of(linkages, 0)), 1e-5f);
        }
        for (size_t j = 0; j < 10; ++j)
            EXPECT_LT(length(linkages.places[j] - chain.rest[j]), 0.02f) << seed << ", " << j;
    }
}

// Trees of many sub-bases go where they have been turned to.
TEST(Linkages, TreesByChanceReachWhatTheyCan) {
    int reached = 0, tried = 0;
    for (int joints = 2; joints <= 64; ++joints)
        for (uint64_t seed = 1; seed <= 8; ++seed) {
            Linkage f = random_tree_linkage(joints, 0.2f, seed);
            f.method.patience = {0.001f, 5000};
            std::vector<Vec3> turned(f.rest.size()), targets(f.leads.size());
            for (size_t j = 1; j < turned.size(); ++j) {
                const auto parent = static_cast<size_t>(f.shape.parents[j]);
                Vec3 by;
                uint32_t draw = 0;
                for (float* x : {&by.x, &by.y, &by.z})
                    *x = random_between({seed, static_cast<uint32_t>(j), 7}, -0.5f, 0.5f, draw++);
                turned[j] =
                    turned[parent] +
                    normalize_or((f.rest[j] - f.rest[parent]) / f.bones[j] + by, {0, 1, 0}) * f.bones[j];
                if (const int e = f.shape.effectors[j]; e != k_no_effector)
                    targets[static_cast<size_t>(e)] = turned[j];
            }
            std::vector<Vec3> places = f.rest;
            reached += solve_linkage(f, f.method, places, targets).off <= 0.001f;
            ++tried;
            ASSERT_LT(worst_bone(f, places), 1e-5f);
        }
    EXPECT_GE(reached, tried * 99 / 100);
}

}  // namespace
}  // namespace flaneur
