#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstring>

#include "sim/base/math.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pose.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

std::unique_ptr<World> world_of(uint32_t walkers, int threads, uint64_t seed = 5) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = threads;
    options.seed = seed;
    options.kinds = {{standard_body(1.62f)}, {standard_body(1.78f)}};
    auto world = make_world(std::make_shared<Ground>(square(40)), options);
    EXPECT_TRUE(world) << (world ? "" : world.error().message);
    return std::move(world).value();
}

TEST(Pose, SameBitsOnEveryInstructionSet) {
    auto world = world_of(100, 1);
    for (int i = 0; i < 150; ++i) step(*world);
    std::vector<PoseBlock> poses(world->gait.blocks.size());
    int tried = 0;
    for (auto target : {HWY_SCALAR, HWY_SSSE3, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
        if (!(hwy::SupportedTargets() & target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        pose_blocks(world->gait, 0, poses.size(), k_tick, world->previous_poses, poses);
        restrain_legs(world->gait, 0, poses.size(), k_tick, world->previous_poses, poses);
        EXPECT_EQ(0, std::memcmp(poses.data(), world->poses.data(), poses.size() * sizeof(PoseBlock)))
            << hwy::TargetName(target);
        hwy::SetSupportedTargetsForTest(0);
        ++tried;
    }
    EXPECT_GE(tried, 1);
}

// The ground gives way below everybody, and comes up again.
TEST(Pose, BodiesFallAndAreCaughtAsTheyCan) {
    auto world = world_of(32, 1);
    for (int i = 0; i < 20; ++i) step(*world);
    Gait& gait = world->gait;
    std::vector<PoseBlock> poses = world->poses, there = poses;
    for (float by : {-0.2f, 0.15f}) {
        for (GaitBlock& g : gait.blocks) {
            for (int lane = 0; lane < k_block; ++lane) {
                g.base[lane] += by;
                for (FootBlock& foot : g.feet)
                    for (FootPlaces* places : {&foot.from, &foot.to}) places->y[lane] += by;
            }
        }
        pose_blocks(gait, 0, poses.size(), there);
        std::vector<float> was(32), before(32);
        for (size_t i = 0; i < 32; ++i) was[i] = before[i] = joint_pose(poses, i, hips).position.y;
        for (int tick = 0; tick < 60; ++tick) {
            pose_blocks(gait, 0, poses.size(), k_tick, poses, poses);
            for (size_t i = 0; i < 32; ++i) {
                float y = joint_pose(poses, i, hips).position.y;
                float faster = (y - 2 * was[i] + before[i]) / (k_tick * k_tick);
                if (tick > 0) {
                    EXPECT_GT(faster, -k_gravity) << i << " " << tick;
                    EXPECT_LT(faster, 21) << i << " " << tick;
                }
                if (by > 0) {
                    EXPECT_LT(y, joint_pose(there, i, hips).position.y + 1e-3f) << i << " " << tick;
                }
                before[i] = was[i];
                was[i] = y;
            }
        }
        for (size_t i = 0; i < 32; ++i)
            EXPECT_NEAR(was[i], joint_pose(there, i, hips).position.y, 1e-3f) << i;
    }
}

TEST(Pose, StandingIsUpright) {
    auto world = world_of(8, 1);
    for (size_t i = 0; i < 8; ++i) {
        Vec3 root = world->crowd.motion.position[i];
        const Body& body = world->kinds[world->crowd.identity.body[i]].body;
        float size = body.height * world->crowd.identity.scale[i];
        EXPECT_NEAR(joint_pose(world->poses, i, head).position.y - root.y, 0.885f * size, 0.03f * size);
        EXPECT_NEAR(joint_pose(world->poses, i, left_foot).position.y - root.y, 0.039f * size, 1e-3f);
        Vec2 facing = heading_direction(world->crowd.motion.heading[i]);
        Vec3 toes =
            joint_pose(world->poses, i, left_toes).position - joint_pose(world->poses, i, left_foot).position;
        EXPECT_GT(dot(on_ground(toes), facing), 0.05f);
        // Hands hang beside the thighs.
        Vec3 hand = joint_pose(world->poses, i, left_hand).position;
        EXPECT_NEAR(hand.y - root.y, 0.49f * size, 0.06f * size);
    }
}

TEST(World, SameHashForEveryThreadCountAndAnotherForAnotherSeed) {
    uint64_t hashes[3];
    int threads[3] = {1, 2, 7};
    for (int k = 0; k < 3; ++k) {
        auto world = world_of(150, threads[k]);
        for (int i = 0; i < 240; ++i) step(*world);
        hashes[k] = hash_world(*world);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
    auto other = world_of(150, 2, 6);
    for (int i = 0; i < 240; ++i) step(*other);
    EXPECT_NE(hashes[0], hash_world(*other));
}

TEST(World, KindsHaveTheirShareSpeedAndManner) {
    WorldOptions options;
    options.walkers = 400;
    options.threads = 2;
    Kind old_women{standard_body(1.58f), 3, 85, true}, boys{standard_body(1.15f), 1, 6};
    options.kinds = {old_women, boys};
    auto made = make_world(std::make_shared<Ground>(square(60)), options);
    ASSERT_TRUE(made) << made.error().message;
    const World& world = **made;
    float count[2] = {}, speed[2] = {}, stride[2] = {};
    for (uint32_t i = 0; i < world.crowd.count; ++i) {
        uint32_t kind = world.crowd.identity.body[i];
        count[kind] += 1;
        speed[kind] += world.crowd.identity.preferred_speed[i];
        stride[kind] += world.gait.people[i / k_block].stride[i % k_block];
    }
    EXPECT_NEAR(count[1], 100, 40);
    EXPECT_NEAR(speed[0] / count[0], 0.96f, 0.06f);  // few are slower than the crowd's least
    EXPECT_NEAR(speed[1] / count[1], 1.17f, 0.06f);
    EXPECT_NEAR(stride[0] / count[0], manner_at_age(85).stride, 0.02f);
    EXPECT_NEAR(stride[1] / count[1], manner_at_age(6).stride, 0.02f);
}

TEST(World, CrowdWalksOnItsFeet) {
    auto world = world_of(120, 2);
    float drift = 0, below = 0, overreach = 0;
    int stood = 0, late = 0;  // ticks of planted feet; those in which a leg could not follow its plan
    std::vector<Sole> last(world->crowd.count * 2);
    std::vector<int> planted(world->crowd.count * 2, 0);
    for (int t = 0; t < 900; ++t) {
        step(*world);
        for (size_t i = 0; i < world->crowd.count; ++i) {
            for (Side side : {k_left, k_right}) {
                size_t k = 2 * i + side;
                Sole now = sole(world->poses, world->gait, i, side);
                bool stands = world->gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0;
                if (stands && planted[k]) {
                    float moved = std::min(length(now.heel - last[k].heel), length(now.ball - last[k].ball));
                    float sunk = -std::min({now.heel.y, now.ball.y, now.tip.y});
                    ++stood;
                    late += moved > 0.005f || sunk > 0.003f;
                    drift = std::max(drift, moved);
                    below = std::max(below, sunk);
                }
                planted[k] = stands;
                last[k] = now;
                float scale = world->crowd.identity.scale[i];
                const Body& body = world->kinds[world->crowd.identity.body[i]].body;
                Joint hip = side == k_left ? left_upper_leg : right_upper_leg;
                Joint ankle = side == k_left ? left_foot : right_foot;
                float leg = (thigh_length(body) + shank_length(body)) * scale;
                overreach = std::max(overreach, length(joint_pose(world->poses, i, hip).position -
                                                       joint_pose(world->poses, i, ankle).position) -
                                                    leg);
            }
        }
    }
    RecordProperty("drift_mm", std::to_string(drift * 1000));
    EXPECT_LT(late, stood / 4000);
    EXPECT_LT(drift, 0.1f);
    EXPECT_LT(below, 0.05f);
    EXPECT_LT(overreach, 1e-3f);
}

}  // namespace
}  // namespace flaneur
