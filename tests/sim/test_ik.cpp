#include <gtest/gtest.h>

#include "sim/base/math.h"
#include "sim/base/rng.h"
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

TEST(TwoBone, KeepsLengthsAndReachesOrPointsAt) {
    RandomKey key{3};
    int rotations = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        TwoBoneInput<float> in;
        in.root = direction_from(key, i * 20) * random_between(key, 0, 3, i * 20 + 3);
        in.upper = random_between(key, 0.1f, 0.6f, i * 20 + 4);
        in.lower = random_between(key, 0.1f, 0.6f, i * 20 + 5);
        Vector direction = direction_from(key, i * 20 + 6);
        float distance = random_between(key, 0, 1.6f, i * 20 + 9);
        in.target = in.root + direction * distance;
        in.front = direction_from(key, i * 20 + 10);
        in.front.z = std::fabs(in.front.z) + 0.2f;
        in.bend = i % 2 ? 1.0f : -1.0f;
        in.reference = {0, 0, 0, 1};
        if (length(cross(in.front, direction)) < 0.05f || direction.y > 0.7f) continue;
        TwoBoneOutput<float> out = two_bone(in);

        ASSERT_NEAR(length(out.middle - in.root), in.upper, 2e-5f);
        ASSERT_NEAR(length(out.end - out.middle), in.lower, 2e-5f);
        float reach = (in.upper + in.lower) * 0.9995f, fold = std::fabs(in.upper - in.lower) + 1e-3f;
        if (distance > fold && distance < reach) {
            ASSERT_LT(length(out.end - in.target), 1e-4f);
        } else if (distance > 0.01f) {
            ASSERT_GT(dot(unit(out.end - in.root), direction), 0.9999f);
        }
        // The middle joint lies on the side of `front` (knee) or away from it (elbow).
        Vector beside = in.front - direction * dot(in.front, direction);
        ASSERT_GE(dot(out.middle - in.root, beside) * in.bend, -1e-4f);
        // Rotations carry the canonical bones onto the solved ones, unless they are half a turn from the
        // reference.
        float fold_cosine = dot(unit(out.middle - in.root), unit(out.end - out.middle));
        if (fold_cosine < -0.99f || std::fabs(out.upper_rot.w) < 0.2f) continue;
        ++rotations;
        Vector upper = rotate(out.upper_rot, Vector{0, -in.upper, 0});
        Vector lower = rotate(out.lower_rot, Vector{0, -in.lower, 0});
        ASSERT_LT(length(upper - (out.middle - in.root)), 3e-3f);
        ASSERT_LT(length(lower - (out.end - out.middle)), 3e-3f);
    }
    EXPECT_GT(rotations, 30000);
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

TEST(TwoBone, MovesWithoutAJumpThroughFullExtension) {
    TwoBoneOutput<float> before = two_bone(leg_to({0.1f, -0.70f, 0.05f}));
    for (int i = 1; i <= 4000; ++i) {
        TwoBoneOutput<float> now = two_bone(leg_to({0.1f, -0.70f - static_cast<float>(i) * 1e-4f, 0.05f}));
        ASSERT_LT(length(now.middle - before.middle), 0.01f) << i;
        ASSERT_LT(length(now.end - before.end), 2e-4f) << i;
        before = now;
    }
}

TEST(TwoBone, MirrorsLeftAndRight) {
    RandomKey key{9};
    for (uint32_t i = 0; i < 1000; ++i) {
        Vector t{random_between(key, -0.5f, 0.5f, i * 3), random_between(key, -0.8f, -0.2f, i * 3 + 1),
                 random_between(key, -0.3f, 0.5f, i * 3 + 2)};
        auto a = two_bone(leg_to(t)), b = two_bone(leg_to({-t.x, t.y, t.z}));
        ASSERT_NEAR(a.middle.x, -b.middle.x, 1e-6f);
        ASSERT_NEAR(a.middle.y, b.middle.y, 1e-6f);
        ASSERT_NEAR(a.middle.z, b.middle.z, 1e-6f);
    }
}

}  // namespace
}  // namespace flaneur
