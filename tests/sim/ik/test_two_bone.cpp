#include <gtest/gtest.h>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/vec.h"
#include "sim/ik/two_bone-inl.h"

namespace flaneur {
namespace {

using namespace HWY_NAMESPACE;
using Vector = V3<float>;

float length(Vector v) { return std::sqrt(dot(v, v)); }
Vector direction_from(RandomKey key, uint32_t k) {
    return normalize(Vector{random_between(key, -1, 1, k), random_between(key, -1, 1, k + 1),
                            random_between(key, -1, 1, k + 2)});
}

struct Problem {
    Vector target;
    SinCosOf<float> front = {0, 1};
    LimbSizes<float> size = limb_sizes(0.43f, 0.41f);
    float bend = 1, soft = 0;
};
PosedLimb<float> solved(const Problem& p) { return two_bone(p.target, p.front, p.size, p.bend, p.soft); }

// The angle of the rotation that takes a to b.
float angle_between(Q4<float> a, Q4<float> b) {
    float w = std::fabs(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w);
    return 2 * arccos(w > 1 ? 1 : w);
}
// The shortest arc from -y to unit vector `to`, applied to v; by another road than the solver's.
Vector carried(Vector to, Vector v) {
    Vec3 r = rotate(rotation_between({0, -1, 0}, {to.x, to.y, to.z}), Vec3{v.x, v.y, v.z});
    return {r.x, r.y, r.z};
}

void check(const Problem& p) {
    PosedLimb<float> out = solved(p);
    float upper = p.size.upper, lower = p.size.lower, distance = length(p.target);
    ASSERT_NEAR(length(out.middle), upper, 1e-5f);
    ASSERT_NEAR(length(out.end - out.middle), lower, 1e-5f);
    float reach = (upper + lower) * 0.9995f, fold = std::fabs(upper - lower) + 1e-3f;
    ASSERT_LT(length(out.end), reach + 1e-5f);
    ASSERT_GT(length(out.end), fold - 1e-5f);
    if (distance > fold && distance < reach - p.soft) {
        ASSERT_LT(length(out.end - p.target), 1e-4f);
    } else if (distance > 1e-6f) {
        ASSERT_GT(dot(normalize(out.end), normalize(p.target)), 0.99999f);
    }
    // Rotations carry the canonical bones onto the solved ones.
    for (Q4<float> q : {out.upper_rot, out.lower_rot}) {
        ASSERT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 2e-6f);
    }
    ASSERT_LT(length(rotate(out.upper_rot, Vector{0, -upper, 0}) - out.middle), 1e-5f);
    ASSERT_LT(length(rotate(out.lower_rot, Vector{0, -lower, 0}) - (out.end - out.middle)), 1e-5f);
    if (distance < 1e-6f || p.target.y > 0.9999f * distance) return;  // any plane will do
    // The middle joint lies in the carried plane, towards the front (knee) or away from it (elbow), and
    // canonical +x goes to the hinge.
    Q4<float> yaw = normalize(Q4<float>{0, p.front.sine, 0, p.front.cosine});
    Vector direction = normalize(p.target);
    Vector hinge = carried(direction, rotate(yaw, Vector{1, 0, 0}));
    Vector ahead = carried(direction, rotate(yaw, Vector{0, 0, 1}));
    ASSERT_NEAR(dot(out.middle, hinge), 0, 1e-4f);
    ASSERT_GE(dot(out.middle, ahead) * p.bend, -1e-5f);
    ASSERT_LT(length(rotate(out.upper_rot, Vector{1, 0, 0}) - hinge), 1e-4f);
    ASSERT_LT(length(rotate(out.lower_rot, Vector{1, 0, 0}) - hinge), 1e-4f);
}

TEST(TwoBone, KeepsLengthsAndReachesOrPointsAt) {
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{3, i};
        Problem p;
        p.size = limb_sizes(random_between(key, 0.1f, 0.6f), random_between(key, 0.1f, 0.6f, 1));
        p.target = direction_from(key, 2) * random_between(key, 0.01f, 1.6f, 5);
        // Every tenth nearly straight up or down.
        if (i % 10 == 0) p.target = {1e-3f * p.target.x, p.target.y, 1e-3f * p.target.z};
        SinCos half = sin_cos(random_between(key, -1.57f, 1.57f, 6));
        float factor = random_between(key, 0.1f, 3, 7);
        p.front = {half.sine * factor, half.cosine * factor};
        p.bend = i % 2 ? 1.0f : -1.0f;
        p.soft = i % 3 ? 0.0f : random_between(key, 1e-3f, 0.05f, 8);
        check(p);
        if (HasFatalFailure()) FAIL() << i;
    }
}

TEST(TwoBone, KeepsLengthsOnEdges) {
    for (float y : {-1e3f, -0.84f, -0.5f, -1e-3f, -1e-12f, 0.0f, 1e-12f, 0.5f, 0.84f, 1e3f}) {
        for (float x : {0.0f, 1e-20f, 1e-7f, 1e-4f}) {
            check({{x, y, 0}});
            check({{0, y, x}});
        }
    }
}

TEST(TwoBone, LooksWhereItsFrontLooks) {
    for (int k = -31; k <= 31; ++k) {
        SinCos yaw = sin_cos(static_cast<float>(k) * 0.1f);
        PosedLimb<float> out = solved({{0, -0.6f, 0}, half_yaw_to(2 * yaw.sine, 2 * yaw.cosine)});
        ASSERT_NEAR(out.middle.x * yaw.cosine - out.middle.z * yaw.sine, 0, 1e-5f);
        ASSERT_GT(out.middle.x * yaw.sine + out.middle.z * yaw.cosine, 0.2f);
    }
}

TEST(TwoBone, StandingStraightIsTheCanonicalPose) {
    PosedLimb<float> out = solved({{0, -0.84f, 0}});
    EXPECT_GT(out.upper_rot.w, 0.999f);
    EXPECT_GT(out.lower_rot.w, 0.999f);
}

TEST(TwoBone, BentKneeLooksAhead) {
    PosedLimb<float> out = solved({{0, -0.6f, 0}});
    EXPECT_GT(out.middle.z, 0.2f);
    // The shank's back stays back: its canonical +z still looks ahead.
    EXPECT_GT(rotate(out.lower_rot, Vector{0, 0, 1}).z, 0.3f);
}

struct Turns {
    float upper = 0, lower = 0, knee = 0;  // most in a step of 1 mm, degrees
};
// Leads the target from `from` to `to`, 1 mm at a time.
Turns most_turns(Problem in, Vector from, Vector to) {
    Turns most;
    int steps = static_cast<int>(length(to - from) * 1000);
    PosedLimb<float> before{};
    for (int i = 0; i <= steps; ++i) {
        in.target = from + normalize(to - from) * (static_cast<float>(i) * 1e-3f);
        PosedLimb<float> now = solved(in);
        if (i > 0) {
            float knee_now = angle_between(now.upper_rot, now.lower_rot);
            float knee_before = angle_between(before.upper_rot, before.lower_rot);
            most.upper = std::max(most.upper, angle_between(now.upper_rot, before.upper_rot) / k_radians);
            most.lower = std::max(most.lower, angle_between(now.lower_rot, before.lower_rot) / k_radians);
            most.knee = std::max(most.knee, std::fabs(knee_now - knee_before) / k_radians);
        }
        before = now;
    }
    return most;
}

TEST(TwoBone, OpensTheKneeEvenlyThroughFullExtension) {
    Problem in;
    Turns hard = most_turns(in, {0.1f, -0.7f, 0.05f}, {0.1f, -1.0f, 0.05f});
    EXPECT_LT(hard.knee, 5);
    in.soft = 0.01f;
    Turns soft = most_turns(in, {0.1f, -0.7f, 0.05f}, {0.1f, -1.0f, 0.05f});
    EXPECT_LT(soft.knee, 1);
    // No knock at the end either: how much the knee's speed changes from one millimetre to the next.
    auto knock = [](Problem limb) {
        float most = 0, angle[3] = {};
        for (int i = 0; i <= 200; ++i) {
            limb.target = {0, -0.7f - static_cast<float>(i) * 1e-3f, 0};
            PosedLimb<float> out = solved(limb);
            angle[0] = angle[1];
            angle[1] = angle[2];
            angle[2] = angle_between(out.upper_rot, out.lower_rot) / k_radians;
            if (i >= 2) most = std::max(most, std::fabs(angle[2] - 2 * angle[1] + angle[0]));
        }
        return most;
    };
    EXPECT_LT(knock(in), 0.25f);
    in.soft = 0;
    EXPECT_GT(knock(in), 1);
}

TEST(TwoBone, MovesWithoutAJumpAnywhereBelowTheRoot) {
    Turns most;
    int walks = 0;
    for (uint32_t i = 0; i < 1000; ++i) {
        RandomKey key{5, i};
        Problem in;
        in.soft = 0.01f;
        in.bend = i % 2 ? 1.0f : -1.0f;
        // About every other walk passes within 5 mm of the pole, the ray from the root along `front`.
        Vector through =
            i % 4 < 2 ? Vector{random_between(key, -5e-3f, 5e-3f), random_between(key, -5e-3f, 5e-3f, 1),
                               random_between(key, 0.3f, 0.9f, 2)}
                      : direction_from(key, 3) * random_between(key, 0.3f, 0.9f, 6);
        Vector course = direction_from(key, 7) * 0.3f;
        Vector from = through - course, to = through + course;
        // Not overhead, where the plane's turn has its singular point, nor folded, where the knee's has.
        bool fair = true;
        for (int k = 0; k <= 60; ++k) {
            Vector p = from + (to - from) * (static_cast<float>(k) / 60);
            fair = fair && length(p) > 0.2f && p.y < 0.7f * length(p);
        }
        if (!fair) continue;
        ++walks;
        Turns t = most_turns(in, from, to);
        most = {std::max(most.upper, t.upper), std::max(most.lower, t.lower), std::max(most.knee, t.knee)};
    }
    EXPECT_GT(walks, 300);
    EXPECT_LT(most.upper, 1.5f);
    EXPECT_LT(most.lower, 1.5f);
    EXPECT_LT(most.knee, 1);
}

TEST(TwoBone, MirrorsLeftAndRight) {
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{9, i};
        Problem in{direction_from(key, 0) * random_between(key, 0.1f, 1, 3)};
        SinCos half = sin_cos(random_between(key, -1.5f, 1.5f, 4));
        in.front = {half.sine, half.cosine};
        in.soft = i % 2 ? 0.01f : 0.0f;
        if (in.target.y > 0.99f * length(in.target)) continue;
        Problem other = in;
        other.target.x = -in.target.x;
        other.front.sine = -in.front.sine;
        PosedLimb<float> a = solved(in), b = solved(other);
        ASSERT_NEAR(a.middle.x, -b.middle.x, 1e-4f);
        ASSERT_NEAR(a.middle.y, b.middle.y, 1e-4f);
        ASSERT_NEAR(a.middle.z, b.middle.z, 1e-4f);
        ASSERT_NEAR(a.upper_rot.w, b.upper_rot.w, 1e-4f);
        ASSERT_NEAR(a.upper_rot.x, b.upper_rot.x, 1e-4f);
        ASSERT_NEAR(a.upper_rot.y, -b.upper_rot.y, 1e-4f);
        ASSERT_NEAR(a.upper_rot.z, -b.upper_rot.z, 1e-4f);
    }
}

}  // namespace
}  // namespace flaneur
