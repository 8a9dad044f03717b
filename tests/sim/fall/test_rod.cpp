// Canes of those who fall: on the ground and not in it, and taken up again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/pose/cane.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

TEST(Rods, FallLieAndAreTakenUpAgain) {
    float deepest = 0, jumps = 0, off_length = 0, off_hand = 0, off_turn = 0;
    uint32_t lay = 0, falls = 0;
    for (const uint64_t seed : {1u, 2u, 3u, 4u}) {
        Ground ground = square(12);
        index_ground(ground);
        WorldOptions options{.capacity = 1, .seed = seed, .threads = 1};
        options.kinds[0].body.cane = standard_cane(options.kinds[0].body.height);
        options.kinds[0].age = 74;
        auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
        ASSERT_TRUE(world) << world.error().message;
        World& w = **world;
        const auto id = add_walker(w, {.place = Vec3{}});
        ASSERT_TRUE(id);
        for (int tick = 0; tick < 30; ++tick) step(w);
        ASSERT_TRUE(push(w, *id, heading_direction(static_cast<float>(seed) * 1.5f) * 170));
        bool has_lain = false, has_fallen_once = false;
        Vec3 tip_before = posed_tip(w.poses, w.gait.canes[0]);
        for (int tick = 0; tick < 1500; ++tick) {
            step(w);
            const LooseRod* rod = own_of(w.falls.rods, 0);
            const Vec3 tip = rod ? rod->tip : posed_tip(w.poses, w.gait.canes[0]);
            jumps = std::max(jumps, length(tip - tip_before));
            tip_before = tip;
            if (!rod) continue;
            has_fallen_once = true;
            deepest = std::max({deepest, -rod->grip.y, -rod->tip.y});
            off_length = std::max(off_length, std::fabs(length(rod->tip - rod->grip) - rod->length));
            has_lain |= rod->grip.y < 0.04f && rod->tip.y < 0.04f;
            const JointPose hand = joint_pose(w.poses, 0, right_hand);
            off_hand = std::max(off_hand, std::fabs(length(rod->grip - hand.position) - 0.088f));
            // What is drawn is where the tip is.
            const Vec3 drawn = rotate(rod->turn, w.gait.canes[0].tip_hs), lies = rod->tip - rod->grip;
            off_turn = std::max(off_turn, length(drawn / length(drawn) - lies / length(lies)));
        }
        falls += has_fallen_once;
        lay += has_lain;
        EXPECT_TRUE(w.falls.rods.empty()) << "still on the ground, seed " << seed;
        EXPECT_FALSE(has_fallen(w, *id));
    }
    std::printf(
        "%u fell, %u canes lay; %.1f mm in the ground, tips move %.3f m a tick, %.1f mm off their length, "
        "hands %.1f mm off, turned %.3f off\n",
        falls, lay, wide(1000 * deepest), wide(jumps), wide(1000 * off_length), wide(1000 * off_hand),
        wide(off_turn));
    EXPECT_EQ(falls, 4u);
    EXPECT_GE(lay, 3u);
    EXPECT_LT(deepest, 0.001f);
    EXPECT_LT(off_length, 0.02f);
    EXPECT_LT(jumps, 0.25f);
    EXPECT_LT(off_hand, 0.012f);
    EXPECT_LT(off_turn, 0.15f);
}

// Whichever way it is turned when a hand stops holding it tight, even all but upright.
TEST(Rods, HangAndLie) {
    Ground ground = square(12);
    index_ground(ground);
    const Surroundings around = surroundings_of(ground);
    for (const float degrees : {0.5f, 2.0f, 8.0f, 20.0f, 60.0f, 88.0f}) {
        for (const float height : {0.02f, 0.3f, 1.2f}) {
            LooseRod rod{.length = 0.8f, .grip = {0, height, 0}};
            rod.tip = rod.tip_before =
                rotate(rotation_x(degrees * k_radians), Vec3{0, rod.length, 0}) + rod.grip;
            for (int ticks = 0; ticks < 600; ++ticks)
                carry_rod(rod, around, {0, height, 0}, {0, -1, 0}, {}, 0);
            const float lowest = std::max(height - rod.length, k_rod_thick);
            EXPECT_NEAR(rod.tip.y, lowest, 0.03) << degrees << " degrees off upright, grip at " << height;
            EXPECT_LT(length(rod.tip - rod.tip_before), 0.002f);
        }
    }
}

}  // namespace
}  // namespace flaneur
