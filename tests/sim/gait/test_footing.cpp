// Where a foot is set on kerbs, on steps and beside them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/gait/footing.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr FootSize k_foot{0.06f, 0.14f, 0.2f};
constexpr float k_half_sole = 0.045f;

// A pavement 0.12 m above a road, whose edge runs along z at x = 0.
Ground kerb() {
    Ground ground;
    add_floor(ground, {0, -10}, {10, 10}, 0.12f, Surface::plaza);
    add_floor(ground, {-10, -10}, {0, 10}, 0, Surface::road);
    index_ground(ground);
    return ground;
}

// Ten steps down along z, 0.16 m x 0.32 m, from z = 0 on.
Ground steps_down() {
    Ground ground;
    add_floor(ground, {-10, -10}, {10, 0}, 0, Surface::plaza);
    for (int i = 0; i < 10; ++i) {
        float z = static_cast<float>(i) * 0.32f;
        add_floor(ground, {-10, z}, {10, i < 9 ? z + 0.32f : 20}, -0.16f * static_cast<float>(i + 1),
                  Surface::steps);
    }
    index_ground(ground);
    return ground;
}

float edge_between(Vec3 at, float yaw, float along, float aside) {
    Vec2 ahead = heading_direction(yaw);
    return at.x + ahead.x * along + ahead.z * aside;
}

TEST(Footing, KeepsASolesWidthOffAnEdgeBesideIt) {
    Ground ground = kerb();
    for (float yaw : {0.0f, k_pi, 0.1f, -0.15f}) {
        for (float x = -0.12f; x < 0.12f; x += 0.01f) {
            for (float outward : {1.0f, -1.0f}) {
                Footing f = find_footing(surroundings_of(ground), {{x, x > 0 ? 0.12f : 0.0f, 0}, yaw}, k_foot,
                                         outward);
                ASSERT_TRUE(f.found && f.whole) << x << " " << yaw;
                const bool up = f.place.position.x > 0;
                EXPECT_NEAR(f.place.position.y, up ? 0.12f : 0.0f, 1e-4f);
                for (float along : {-k_foot.heel, k_foot.ball}) {
                    for (float side : {k_half_sole, -k_half_sole}) {
                        float at = edge_between(f.place.position, f.place.yaw, along, side);
                        EXPECT_TRUE(up ? at > -1e-3f : at < 1e-3f) << x << " " << yaw << " " << along;
                    }
                }
            }
        }
    }
}

TEST(Footing, StandsWhereItIsWishedOnOpenGround) {
    Ground ground = kerb();
    Footing f = find_footing(surroundings_of(ground), {{3, 0.12f, 2}, 0.7f}, k_foot, 1);
    EXPECT_TRUE(f.found && f.whole && !f.stepped);
    EXPECT_EQ(f.place.position.x, 3);
    EXPECT_EQ(f.place.position.z, 2);
}

TEST(Footing, StaysOffAnEdgeAcrossIt) {
    Ground ground = kerb();
    for (float x = -0.3f; x < 0.2f; x += 0.02f) {
        Footing f = find_footing(surroundings_of(ground), {{x, 0, 0}, k_pi / 2}, k_foot, 1);
        ASSERT_TRUE(f.found && f.whole) << x;
        float heel = f.place.position.x - k_foot.heel, tip = f.place.position.x + k_foot.tip;
        EXPECT_TRUE(heel > -1e-3f || tip < 1e-3f) << x;
    }
}

TEST(Footing, FindsTheNextTreadOfItsOwnLane) {
    Ground ground = steps_down();
    const Surroundings around = surroundings_of(ground);
    // A foot in the middle of the second step; straight ahead, and aslant.
    const Vec3 from{0, -0.32f, 0.48f};
    for (float turn : {0.0f, 0.4f, 0.7f, -0.7f}) {
        const Vec2 direction = heading_direction(turn);
        for (float aside : {0.0f, 0.1f, -0.1f, 0.16f, -0.16f}) {
            Tread next = next_tread(around, from, direction, aside, 1.2f);
            // The lane starts this far along z, whose edges lie at multiples of 0.32.
            const float z = from.z - direction.x * aside;
            EXPECT_NEAR(z + next.begin * direction.z, 0.64f, 0.01f) << turn << " " << aside;
            EXPECT_NEAR(z + next.end * direction.z, 0.96f, 0.01f) << turn << " " << aside;
            EXPECT_NEAR(next.height, -0.48f, 1e-3f);
            EXPECT_TRUE(next.down);
            // The step it stands on begins at 0.32; it is looked for a quarter of a metre back at most.
            EXPECT_LT(next.level, std::max((0.32f + 0.061f - z) / direction.z, -0.23f));
        }
    }
}

TEST(Footing, FindsNoTreadOnTheFlat) {
    Ground ground = kerb();
    Tread next = next_tread(surroundings_of(ground), {5, 0.12f, 0}, {0, 1}, 0, 1);
    EXPECT_EQ(next.end, next.begin);
    // Nor where only one edge lies ahead, though that is known.
    next = next_tread(surroundings_of(ground), {0.3f, 0.12f, 0}, {-1, 0}, 0, 1);
    EXPECT_EQ(next.end, next.begin);
    EXPECT_NEAR(next.begin, 0.3f, 0.01f);
}

}  // namespace
}  // namespace flaneur
