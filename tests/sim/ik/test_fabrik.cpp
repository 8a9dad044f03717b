#include <gtest/gtest.h>

#include "sim/base/math.h"
#include "sim/ik/fabrik-inl.h"
#include "sim/ik/fabrik_tree-inl.h"
#include "tests/sim/ik/vectors.h"

namespace flaneur {
namespace {

using namespace HWY_NAMESPACE;

struct Chain {
    int joints = 0;
    Vector p[k_most_chain_joints];
    float bones[k_most_chain_joints], limits[k_most_chain_joints];
    float reach = 0, longest = 0;
};
// Bones of 5 to 30 cm in any directions.
Chain random_chain(RandomKey key, int joints) {
    Chain c;
    c.joints = joints;
    c.p[0] = direction_from(key, 1000);
    for (int i = 0; i + 1 < joints; ++i) {
        auto k = static_cast<uint32_t>(i) * 4;
        c.bones[i] = random_between(key, 0.05f, 0.3f, k);
        c.p[i + 1] = c.p[i] + direction_from(key, k + 1) * c.bones[i];
        c.reach += c.bones[i];
        c.longest = std::max(c.longest, c.bones[i]);
    }
    return c;
}
float worst_bone(const Chain& c) {
    float worst = 0;
    for (int i = 0; i + 1 < c.joints; ++i) {
        worst = std::max(worst, std::fabs(length(c.p[i + 1] - c.p[i]) - c.bones[i]));
    }
    return worst;
}
Vector tip(const Chain& c) { return c.p[c.joints - 1]; }

// Iterations, one at a time, until the tip is within `tolerance`; `most` if it never is.
int solve(Chain& c, Vector target, float tolerance, int most) {
    for (int k = 0; k < most; ++k) {
        if (length(tip(c) - target) <= tolerance) return k;
        fabrik(c.p, c.bones, c.joints, target, 0.0f, 1);
    }
    return most;
}

// From the hole that the longest bone leaves about the base to the whole reach: where `share` of the way is.
float distance_at(const Chain& c, float share) {
    float hole = std::max(0.0f, 2 * c.longest - c.reach);
    return hole + (c.reach - hole) * share;
}

TEST(Fabrik, KeepsLengthsAndReachesOrPointsAt) {
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{21, i};
        Chain c = random_chain(key, 3 + static_cast<int>(i % 10));
        Vector away = direction_from(key, 2000);
        if (i % 4 == 0) {
            Vector target = c.p[0] + away * (c.reach * random_between(key, 1, 3, 2003));
            fabrik(c.p, c.bones, c.joints, target, 0.0f, 1);
            ASSERT_LT(length(tip(c) - (c.p[0] + away * c.reach)), 1e-5f);
        } else {
            Vector target = c.p[0] + away * distance_at(c, random_between(key, 0.05f, 0.98f, 2003));
            solve(c, target, k_tolerance, 1000);
            ASSERT_LE(length(tip(c) - target), k_tolerance);
        }
        ASSERT_LT(worst_bone(c), 2e-6f);
    }
}

// Aristidou & Lasenby (2011) give 15.461 iterations for a chain of 10 joints and reachable targets, without
// the tolerance. Most are spent on targets near full extension, so it matters how these are drawn: here
// evenly from the ball of the chain's reach.
TEST(Fabrik, TakesAboutAsManyIterationsAsThePaper) {
    auto mean_iterations = [](float tolerance, float most_share) {
        double sum = 0;
        constexpr uint32_t k_chains = 20000;
        for (uint32_t i = 0; i < k_chains; ++i) {
            RandomKey key{22, i};
            Chain c = random_chain(key, 10);
            float share = most_share * std::cbrt(random_unit(key, 2003));
            sum += solve(c, c.p[0] + direction_from(key, 2000) * distance_at(c, share), tolerance, 1000);
        }
        return sum / k_chains;
    };
    double coarse = mean_iterations(1e-3f, 1), fine = mean_iterations(k_tolerance, 1);
    double inner = mean_iterations(k_tolerance, 0.9f);
    std::printf(
        "FABRIK, 10 joints: %.1f iterations to 1 mm, %.1f to 0.1 mm (%.1f within 90 %% of the reach); the "
        "paper: "
        "15.5\n",
        coarse, fine, inner);
    EXPECT_LT(coarse, 15.5);
    EXPECT_LT(fine, 25);
    EXPECT_LT(inner, 5);
}

TEST(Fabrik, BendsAStraightChainTowardsATargetOnItsLine) {
    for (float share : {0.1f, 0.3f, 0.5f, 0.9f, 0.99f, 0.999f}) {
        Chain c = random_chain({23}, 6);
        Vector axis = normalize(Vector{0.3f, -1, 0.2f});
        for (int i = 1; i < c.joints; ++i) c.p[i] = c.p[i - 1] + axis * c.bones[i - 1];
        Vector target = c.p[0] + axis * distance_at(c, share);
        solve(c, target, k_tolerance, 1000);
        EXPECT_LE(length(tip(c) - target), k_tolerance) << share;
    }
}

TEST(Fabrik, MirrorsLeftAndRight) {
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{24, i};
        Chain a = random_chain(key, 3 + static_cast<int>(i % 6));
        Chain b = a;
        for (Vector& p : b.p) p.x = -p.x;
        Vector target = a.p[0] + direction_from(key, 2000) * (1.2f * a.reach * random_unit(key, 2003));
        fabrik(a.p, a.bones, a.joints, target, 0.0f, 4);
        target.x = -target.x;
        fabrik(b.p, b.bones, b.joints, target, 0.0f, 4);
        for (int j = 0; j < a.joints; ++j) {
            ASSERT_EQ(a.p[j].x, -b.p[j].x);
            ASSERT_EQ(a.p[j].y, b.p[j].y);
            ASSERT_EQ(a.p[j].z, b.p[j].z);
        }
    }
}

// The largest angle, in degrees, that a bone turns while the target moves 1 mm.
float most_turn(Chain c, Vector from, Vector to, float soft) {
    float most = 0;
    int steps = static_cast<int>(length(to - from) * 1000);
    for (int k = 0; k < 100; ++k) fabrik(c.p, c.bones, c.joints, from, soft, 8);
    for (int s = 0; s <= steps; ++s) {
        Chain before = c;
        fabrik(c.p, c.bones, c.joints, from + normalize(to - from) * (static_cast<float>(s) * 1e-3f), soft,
               8);
        for (int i = 0; i + 1 < c.joints; ++i) {
            Vector was = normalize(before.p[i + 1] - before.p[i]), is = normalize(c.p[i + 1] - c.p[i]);
            most = std::max(most, 2 * std::asin(std::min(1.0f, length(is - was) / 2)) / k_radians);
        }
    }
    return most;
}

TEST(Fabrik, MovesWithoutAJumpThroughFullExtension) {
    float hard = 0, soft = 0;
    for (uint32_t i = 0; i < 300; ++i) {
        RandomKey key{25, i};
        Chain c = random_chain(key, 4 + static_cast<int>(i % 5));
        Vector away = direction_from(key, 2000);
        Vector side = direction_from(key, 2004) * 0.05f;
        Vector near = c.p[0] + away * distance_at(c, 0.8f) + side, far = c.p[0] + away * (1.1f * c.reach);
        hard = std::max({hard, most_turn(c, near, far, 0), most_turn(c, far, near, 0)});
        float s = 0.02f * c.reach;
        soft = std::max({soft, most_turn(c, near, far, s), most_turn(c, far, near, s)});
    }
    // Degrees for a millimetre. What is left of the soft limit's is the iteration lagging behind: it
    // converges slowest near full extension.
    EXPECT_LT(hard, 20);
    EXPECT_LT(soft, 10);
}

TEST(Fabrik, KeepsItsLimits) {
    int reached = 0, possible = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{26, i};
        Chain c = random_chain(key, 3 + static_cast<int>(i % 8));
        Vector axis = direction_from(key, 3000);
        // Limits of 20 to 80 degrees, and a pose within them.
        Chain goal = c;
        Vector bone = axis;
        for (int j = 0; j + 1 < c.joints; ++j) {
            auto k = static_cast<uint32_t>(j) * 4;
            c.limits[j] = sin_cos(random_between(key, 20 * k_radians, 80 * k_radians, 3004 + k)).cosine;
            bone = within_cone(direction_from(key, 3005 + k), bone, lerp(1.0f, c.limits[j], 0.5f));
            goal.p[j + 1] = goal.p[j] + bone * c.bones[j];
        }
        bool far = i % 4 == 0;
        Vector target = far ? c.p[0] + direction_from(key, 4000) * (2 * c.reach) : tip(goal);
        for (int k = 0; k < 50; ++k) {
            fabrik_limited(c.p, c.bones, c.limits, axis, c.joints, target, 0.0f, 1);
            if (!far && length(tip(c) - target) <= k_tolerance) break;
        }
        possible += !far;
        reached += !far && length(tip(c) - target) <= k_tolerance;
        ASSERT_LT(worst_bone(c), 2e-6f);
        Vector before = axis;
        for (int j = 0; j + 1 < c.joints; ++j) {
            Vector now = normalize(c.p[j + 1] - c.p[j]);
            ASSERT_GE(dot(now, before), c.limits[j] - 5e-5f);
            before = now;
        }
    }
    // Limits can trap the iteration short of a target that some pose within them reaches.
    std::printf("FABRIK with limits: %.1f %% of reachable targets reached\n", 100.0 * reached / possible);
    EXPECT_GT(reached, 0.9 * possible);
}

TEST(Fabrik, KeepsItsHinges) {
    int reached = 0, possible = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{27, i};
        Chain c = random_chain(key, 3 + static_cast<int>(i % 8));
        Vector hinge = direction_from(key, 3000), axis = normalize(cross(hinge, direction_from(key, 3003)));
        // Ranges as of fingers and knees, from a little back to far ahead, and a pose within them.
        HingeLimit<float> limits[k_most_chain_joints];
        float low[k_most_chain_joints], high[k_most_chain_joints];
        Chain goal = c;
        Vector resting = axis;
        float turn = 0;
        for (int j = 0; j + 1 < c.joints; ++j) {
            auto k = static_cast<uint32_t>(j) * 4;
            low[j] = random_between(key, -20 * k_radians, 0, 3006 + k);
            high[j] = random_between(key, 50 * k_radians, 120 * k_radians, 3007 + k);
            float middle = (low[j] + high[j]) / 2, half = (high[j] - low[j]) / 2;
            limits[j] = hinge_limit(low[j], high[j]);
            turn += middle + half * random_between(key, -0.5f, 0.5f, 3008 + k);
            SinCos s = sin_cos(turn);
            Vector bone = axis * s.cosine + cross(hinge, axis) * s.sine;
            goal.p[j + 1] = goal.p[j] + bone * c.bones[j];
            resting = within_hinge(resting, resting, hinge, hinge_limit(middle, middle), 1);
            c.p[j + 1] = c.p[j] + resting * c.bones[j];
        }
        bool far = i % 4 == 0;
        Vector target = far ? c.p[0] + direction_from(key, 4000) * (2 * c.reach) : tip(goal);
        for (int k = 0; k < 50; ++k) {
            fabrik_hinged(c.p, c.bones, limits, hinge, axis, c.joints, target, 0.0f, 1);
            if (!far && length(tip(c) - target) <= k_tolerance) break;
        }
        possible += !far;
        reached += !far && length(tip(c) - target) <= k_tolerance;
        ASSERT_LT(worst_bone(c), 3e-6f);
        Vector before = axis;
        for (int j = 0; j + 1 < c.joints; ++j) {
            Vector now = normalize(c.p[j + 1] - c.p[j]);
            ASSERT_NEAR(dot(now, hinge), 0, 2e-5f);
            // Against the middle of the range, which may be more than half a turn from -pi or pi.
            float middle = (low[j] + high[j]) / 2;
            SinCos s = sin_cos(middle);
            Vector straight = before * s.cosine + cross(hinge, before) * s.sine;
            float angle = arctan2(dot(cross(straight, now), hinge), dot(now, straight));
            ASSERT_LE(std::fabs(angle), (high[j] - low[j]) / 2 + 1e-4f);
            before = now;
        }
    }
    std::printf("FABRIK with hinges: %.1f %% of reachable targets reached\n", 100.0 * reached / possible);
    EXPECT_GT(reached, 0.9 * possible);
}

TEST(Fabrik, BendsAKneeOnlyItsWay) {
    // Joint 1 opens from 0 to 150 degrees about +x only.
    Vector p[3] = {{0, 0, 0}, {0, -0.4f, 0.1f}, {0, -0.8f, 0}};
    float bones[2] = {0.4f, 0.4f};
    HingeLimit<float> limits[2] = {hinge_limit(-2.0f, 0.8f), hinge_limit(0.0f, 150 * k_radians)};
    Vector target{0.3f, -0.5f, 0.1f};  // 0.3 m off the plane
    fabrik_hinged(p, bones, limits, Vector{1, 0, 0}, Vector{0, -1, 0}, 3, target, 0.0f, 100);
    EXPECT_LT(length(p[2] - Vector{0, -0.5f, 0.1f}), 1e-3f);
    EXPECT_GT(p[1].z, 0.1f);
    EXPECT_EQ(p[1].x, 0);
}

}  // namespace
}  // namespace flaneur
