#include <gtest/gtest.h>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/vec.h"
#include "sim/ik/limb-inl.h"
#include "sim/ik/two_bone-inl.h"

namespace flaneur {
namespace {

using namespace HWY_NAMESPACE;
using Vector = V3<float>;

float length(Vector v) { return std::sqrt(dot(v, v)); }
Vector direction_from(RandomKey key, uint32_t k) {
    return unit(Vector{random_between(key, -1, 1, k), random_between(key, -1, 1, k + 1),
                       random_between(key, -1, 1, k + 2)});
}

TwoBoneInput<float> leg_to(Vector target) {
    return {{0, 0, 0}, target, 0.43f, 0.41f, {0, 0, 1}, 1, {0, 0, 0, 1}};
}

// The angle of the rotation that takes a to b.
float angle_between(Q4<float> a, Q4<float> b) {
    float w = std::fabs(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w);
    return 2 * arccos(w > 1 ? 1 : w);
}
Q4<float> rotation_from(RandomKey key, uint32_t k) {
    return unit(Q4<float>{random_normal(key, k), random_normal(key, k + 1), random_normal(key, k + 2),
                          random_normal(key, k + 3)});
}
// The shortest arc from unit vector a to unit vector b, applied to v; by another road than the solver's.
Vector carried(Vector a, Vector b, Vector v) {
    Vec3 r = rotate(rotation_between({a.x, a.y, a.z}, {b.x, b.y, b.z}), Vec3{v.x, v.y, v.z});
    return {r.x, r.y, r.z};
}

TEST(TwoBone, KeepsLengthsAndReachesOrPointsAt) {
    int rotations = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{3, i};
        TwoBoneInput<float> in;
        in.reference = rotation_from(key, 0);
        in.root = direction_from(key, 4) * random_between(key, 0, 3, 7);
        in.upper = random_between(key, 0.1f, 0.6f, 8);
        in.lower = random_between(key, 0.1f, 0.6f, 9);
        Vector direction = direction_from(key, 10);
        float distance = random_between(key, 0, 1.6f, 13);
        in.target = in.root + direction * distance;
        in.front = direction_from(key, 14);
        in.bend = i % 2 ? 1.0f : -1.0f;
        in.soft = i % 3 ? 0.0f : random_between(key, 0, 0.05f, 17);
        TwoBoneOutput<float> out = two_bone(in);

        ASSERT_NEAR(length(out.middle - in.root), in.upper, 1e-5f);
        ASSERT_NEAR(length(out.end - out.middle), in.lower, 1e-5f);
        float reach = (in.upper + in.lower) * 0.9995f, fold = std::fabs(in.upper - in.lower) + 1e-3f;
        if (distance > fold && distance < reach - in.soft) {
            ASSERT_LT(length(out.end - in.target), 1e-4f);
        } else if (distance > 0.01f) {
            ASSERT_GT(dot(unit(out.end - in.root), direction), 0.9999f);
        }
        for (Q4<float> q : {out.upper_rot, out.lower_rot}) {
            ASSERT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6f);
        }

        Vector down = rotate(in.reference, Vector{0, -1, 0});
        if (distance < 0.01f || length(cross(in.front, down)) < 0.05f || dot(direction, down) < -0.99f)
            continue;
        // The middle joint lies in the carried plane, towards `front` (knee) or away from it (elbow).
        Vector hinge = carried(down, direction, unit(cross(in.front, down)));
        Vector ahead = carried(down, direction, unit(in.front - down * dot(in.front, down)));
        ASSERT_NEAR(dot(out.middle - in.root, hinge), 0, 1e-4f);
        ASSERT_GE(dot(out.middle - in.root, ahead) * in.bend, -1e-4f);
        // Rotations carry the canonical bones onto the solved ones and canonical +x onto the hinge, unless
        // they are half a turn from the reference.
        Q4<float> r = in.reference;
        Vector x = rotate(Q4<float>{-r.x, -r.y, -r.z, r.w}, hinge),
               d = rotate(Q4<float>{-r.x, -r.y, -r.z, r.w}, direction);
        if (1 + x.x - d.y + cross(d, x).z < 0.01f) continue;  // 4 cos^2 of half the angle
        ++rotations;
        ASSERT_LT(length(rotate(out.upper_rot, Vector{0, -in.upper, 0}) - (out.middle - in.root)), 3e-4f);
        ASSERT_LT(length(rotate(out.lower_rot, Vector{0, -in.lower, 0}) - (out.end - out.middle)), 3e-4f);
        ASSERT_LT(length(rotate(out.upper_rot, Vector{1, 0, 0}) - hinge), 1e-3f);
        ASSERT_LT(length(rotate(out.lower_rot, Vector{1, 0, 0}) - hinge), 1e-3f);
    }
    EXPECT_GT(rotations, 80000);
}

TEST(TwoBone, StandingStraightIsTheCanonicalPose) {
    TwoBoneOutput<float> out = two_bone(leg_to({0, -0.84f, 0}));
    EXPECT_GT(out.upper_rot.w, 0.999f);
    EXPECT_GT(out.lower_rot.w, 0.999f);
}

TEST(TwoBone, BentKneeLooksAhead) {
    TwoBoneOutput<float> out = two_bone(leg_to({0, -0.6f, 0}));
    EXPECT_GT(out.middle.z, 0.2f);
    // The shank's back stays back: its canonical +z still looks ahead.
    EXPECT_GT(rotate(out.lower_rot, Vector{0, 0, 1}).z, 0.3f);
}

struct Turns {
    float upper = 0, lower = 0, knee = 0;  // most in a step of 1 mm, degrees
};
// Leads the target from `from` to `to`, 1 mm at a time.
Turns most_turns(TwoBoneInput<float> in, Vector from, Vector to) {
    Turns most;
    int steps = static_cast<int>(length(to - from) * 1000);
    TwoBoneOutput<float> before{};
    for (int i = 0; i <= steps; ++i) {
        in.target = from + unit(to - from) * (static_cast<float>(i) * 1e-3f);
        TwoBoneOutput<float> now = two_bone(in);
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
    TwoBoneInput<float> in = leg_to({});
    Turns hard = most_turns(in, {0.1f, -0.7f, 0.05f}, {0.1f, -1.0f, 0.05f});
    EXPECT_LT(hard.knee, 5);
    in.soft = 0.01f;
    Turns soft = most_turns(in, {0.1f, -0.7f, 0.05f}, {0.1f, -1.0f, 0.05f});
    EXPECT_LT(soft.knee, 1);
    // No knock at the end either: how much the knee's speed changes from one millimetre to the next.
    auto knock = [](TwoBoneInput<float> limb) {
        float most = 0, angle[3] = {};
        for (int i = 0; i <= 200; ++i) {
            limb.target = {0, -0.7f - static_cast<float>(i) * 1e-3f, 0};
            TwoBoneOutput<float> out = two_bone(limb);
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
        TwoBoneInput<float> in = leg_to({});
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
        TwoBoneInput<float> in = leg_to(direction_from(key, 0) * random_between(key, 0.1f, 1, 3));
        in.front = {random_between(key, -0.5f, 0.5f, 4), random_between(key, -0.5f, 0.5f, 5), 1};
        in.reference =
            unit(Q4<float>{random_between(key, -0.3f, 0.3f, 6), random_between(key, -0.3f, 0.3f, 7),
                           random_between(key, -0.3f, 0.3f, 8), 1});
        in.soft = 0.01f;
        if (dot(in.target, rotate(in.reference, Vector{0, 1, 0})) > 0.99f * length(in.target)) continue;
        TwoBoneInput<float> other = in;
        other.target.x = -in.target.x;
        other.front.x = -in.front.x;
        other.reference.y = -in.reference.y;
        other.reference.z = -in.reference.z;
        TwoBoneOutput<float> a = two_bone(in), b = two_bone(other);
        ASSERT_NEAR(a.middle.x, -b.middle.x, 1e-4f);
        ASSERT_NEAR(a.middle.y, b.middle.y, 1e-4f);
        ASSERT_NEAR(a.middle.z, b.middle.z, 1e-4f);
        ASSERT_NEAR(a.upper_rot.w, b.upper_rot.w, 1e-4f);
        ASSERT_NEAR(a.upper_rot.x, b.upper_rot.x, 1e-4f);
        ASSERT_NEAR(a.upper_rot.y, -b.upper_rot.y, 1e-4f);
        ASSERT_NEAR(a.upper_rot.z, -b.upper_rot.z, 1e-4f);
    }
}

// The form for the pose kernel: the same limb, near the canonical pose.
TEST(Limb, AgreesWithTwoBoneWhereThePoleIsSquare) {
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{10, i};
        float upper = random_between(key, 0.1f, 0.6f), lower = random_between(key, 0.1f, 0.6f, 1);
        Vector direction = unit(Vector{0, -1, random_between(key, -1.5f, 1.5f, 2)});
        Vector target = direction * random_between(key, 0.01f, 1.6f, 3);
        float bend = i % 2 ? 1.0f : -1.0f;
        Limb<float> limb = solve_limb(target, Vector{0, 0, 1}, limb_sizes(upper, lower), bend);
        auto out =
            two_bone(TwoBoneInput<float>{{0, 0, 0}, target, upper, lower, {0, 0, 1}, bend, {0, 0, 0, 1}});
        ASSERT_NEAR(length(limb.middle), upper, 1e-5f);
        ASSERT_NEAR(length(limb.end - limb.middle), lower, 1e-5f);
        ASSERT_LT(length(limb.end - out.end), 1e-5f);
        ASSERT_LT(length(limb.middle - out.middle), 2e-4f);
        ASSERT_LT(length(rotate(limb.upper_rot, Vector{0, -upper, 0}) - limb.middle), 1e-4f);
        ASSERT_LT(length(rotate(limb.lower_rot, Vector{0, -lower, 0}) - (limb.end - limb.middle)), 1e-4f);
    }
}

}  // namespace
}  // namespace flaneur
