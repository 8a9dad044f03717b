// Aiming, and feet flat on the ground.
#include <gtest/gtest.h>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/ik/aim-inl.h"
#include "sim/ik/foot-inl.h"

namespace flaneur {
namespace {

using namespace HWY_NAMESPACE;
using Vector = V3<float>;

float length(Vector v) { return std::sqrt(dot(v, v)); }
Vector direction_from(RandomKey key, uint32_t k) {
    return normalize(Vector{random_normal(key, k), random_normal(key, k + 1), random_normal(key, k + 2)});
}

// Chest, neck and head.
constexpr AimJoint k_chain[3] = {
    {0.2f, 0.5f, 0.25f, 0.3f}, {0.3f, 0.5f, 0.35f, 0.3f}, {0.5f, 0.8f, 0.5f, 0.5f}};
constexpr float k_most_yaw = 1.8f, k_most_up = 1.1f, k_most_down = 1.1f;  // of all three

struct Angles {
    float yaw, pitch;
};
Angles angles_of(Vector v) { return {arctan2(v.x, v.z), arctan2(v.y, std::sqrt(v.x * v.x + v.z * v.z))}; }
float length_of(Q4<float> q) { return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w); }
Vector looks(Q4<float> q) { return rotate(q, Vector{0, 0, 1}); }

TEST(Aim, PointsAtWhatItsLimitsAllowAndKeepsThem) {
    int exact = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{41, i};
        Vector direction = direction_from(key, 0);
        Q4<float> turns[3];
        aim(k_chain, direction * random_between(key, 0.2f, 20, 5), turns);
        Angles wanted = angles_of(direction), last{0, 0};
        for (int j = 0; j < 3; ++j) {
            Angles now = angles_of(looks(turns[j]));
            ASSERT_LE(std::fabs(now.yaw - last.yaw), k_chain[j].yaw + 1e-5f);
            ASSERT_LE(now.pitch - last.pitch, k_chain[j].up + 1e-5f);
            ASSERT_GE(now.pitch - last.pitch, -k_chain[j].down - 1e-5f);
            ASSERT_NEAR(rotate(turns[j], Vector{1, 0, 0}).y, 0, 1e-6f);  // the head stays level
            last = now;
        }
        if (std::fabs(wanted.yaw) < k_most_yaw - 0.1f && wanted.pitch < k_most_up - 0.15f &&
            wanted.pitch > 0.15f - k_most_down) {
            ASSERT_LT(length(looks(turns[2]) - direction), 1e-5f);
            ++exact;
        }
    }
    EXPECT_GT(exact, 30000);
}

TEST(Aim, TurnsWithoutAJumpWhereverTheTargetGoes) {
    float most = 0;
    for (uint32_t i = 0; i < 1000; ++i) {
        RandomKey key{42, i};
        // Great circles, every fourth one over the top and every fourth one about the body.
        Vector a = direction_from(key, 0), b = direction_from(key, 4);
        if (i % 4 == 0) a = {0, 1, 0};
        if (i % 4 == 1) a = {1, 0, 0}, b = {0, 0, 1};
        b = normalize(b - a * dot(a, b));
        Q4<float> before[3], now[3];
        for (int k = 0; k <= 6284; ++k) {
            SinCos s = sin_cos(static_cast<float>(k) * 1e-3f);
            aim(k_chain, a * s.cosine + b * s.sine, now);
            for (int j = 0; j < 3 && k > 0; ++j)
                most = std::max(most, length(looks(now[j]) - looks(before[j])));
            std::copy(now, now + 3, before);
        }
    }
    // A milliradian of the target at a time. Fastest where the turn is given up, behind and near the
    // vertical.
    EXPECT_LT(most, 0.02f);
}

TEST(Aim, MirrorsLeftAndRight) {
    for (uint32_t i = 0; i < 100000; ++i) {
        Vector d = direction_from({43, i}, 0);
        Q4<float> a[3], b[3];
        aim(k_chain, d, a);
        aim(k_chain, Vector{-d.x, d.y, d.z}, b);
        for (int j = 0; j < 3; ++j) {
            ASSERT_NEAR(looks(a[j]).x, -looks(b[j]).x, 1e-6f);
            ASSERT_NEAR(looks(a[j]).y, looks(b[j]).y, 1e-6f);
            ASSERT_NEAR(looks(a[j]).z, looks(b[j]).z, 1e-6f);
        }
    }
}

TEST(FlatOnGround, StandsOnTheNormalAndLooksAlongTheYaw) {
    for (uint32_t i = 0; i < 100000; ++i) {
        RandomKey key{44, i};
        Vector normal =
            normalize(Vector{random_between(key, -0.8f, 0.8f), 1, random_between(key, -0.8f, 0.8f, 1)});
        float yaw = random_between(key, -3, 3, 2);
        SinCosOf<float> half = sin_cos(yaw * 0.5f);
        Q4<float> q = flat_on_ground(normal.x, normal.z, half);
        ASSERT_NEAR(length_of(q), 1, 1e-6f);
        ASSERT_LT(length(rotate(q, Vector{0, 1, 0}) - normal), 1e-5f);
        Vector ahead = rotate(q, Vector{0, 0, 1});
        Vec3 level = rotate(rotation_between({normal.x, normal.y, normal.z}, {0, 1, 0}),
                            Vec3{ahead.x, ahead.y, ahead.z});
        ASSERT_NEAR(level.x, sin_cos(yaw).sine, 1e-5f);
        ASSERT_NEAR(level.z, sin_cos(yaw).cosine, 1e-5f);
        // A little more slope turns it by a little.
        Q4<float> next = flat_on_ground(normal.x + 1e-3f, normal.z, half);
        ASSERT_LT(length(rotate(next, Vector{0, 0, 1}) - rotate(q, Vector{0, 0, 1})), 2e-3f);
    }
    Q4<float> wall = flat_on_ground(2.0f, 3.0f, SinCosOf<float>{0, 1});  // not a normal
    EXPECT_NEAR(length_of(wall), 1, 1e-6f);
}

}  // namespace
}  // namespace flaneur
