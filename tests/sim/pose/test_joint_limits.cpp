#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "sim/base/math.h"
#include "sim/pose/joint_limits.h"
#include "sim/world.h"
#include "tests/sim/random_poses.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr size_t k_people = 48;

Quat against_parent(const std::vector<PoseBlock>& poses, size_t i, size_t joint) {
    Quat parent = joint_pose(poses, i, static_cast<Joint>(k_joint_parents[joint])).rotation;
    return conjugate(parent) * joint_pose(poses, i, static_cast<Joint>(joint)).rotation;
}

void set_rotation(PoseBlock& block, size_t joint, size_t lane, Quat q) {
    const float parts[4] = {q.x, q.y, q.z, q.w};
    for (size_t c = 0; c < 4; ++c) block.rotation[joint][c][lane] = parts[c];
}

// A crowd under way, and its poses of two ticks.
struct Crowded {
    std::unique_ptr<World> world;
    std::vector<PoseBlock> before, now;
};
Crowded crowded() {
    WorldOptions options;
    options.walkers = k_people;
    options.threads = 1;
    auto made = make_world(std::make_shared<Ground>(square(30)), options);
    EXPECT_TRUE(made);
    Crowded c;
    c.world = std::move(made).value();
    for (int t = 0; t < 120; ++t) step(*c.world);
    c.before = c.world->previous_poses;
    c.now = c.world->poses;
    return c;
}

TEST(JointLimits, LeavesTheSteadyWalkAlone) {
    Crowded c = crowded();
    std::vector<PoseBlock> poses = c.now;
    restrain_legs(c.world->gait, 0, poses.size(), k_tick, c.before, poses);
    EXPECT_EQ(0, std::memcmp(poses.data(), c.now.data(), poses.size() * sizeof(PoseBlock)));
}

TEST(JointLimits, SlowsLegsThatJumpAndKeepsTheirBones) {
    Crowded c = crowded();
    std::vector<PoseBlock> poses = c.now;
    RandomKey key{3, 0, 0, Purpose::style};
    // Every third leg is thrown anywhere.
    uint32_t n = 0;
    auto thrown = [](size_t i) { return i % 3 == 0; };
    for (size_t i = 0; i < k_people; i += 3) {
        for (size_t joint = left_upper_leg; joint <= left_toes; ++joint) {
            Vec3 axis{random_between(key, -1, 1, n), random_between(key, -1, 1, n + 1),
                      random_between(key, -1, 1, n + 2)};
            n += 3;
            set_rotation(poses[i / k_block], joint, i % k_block,
                         normalize(Quat{axis.x, axis.y, axis.z, 0.3f}));
        }
    }
    restrain_legs(c.world->gait, 0, poses.size(), k_tick, c.before, poses);
    int at_the_limit = 0;
    for (size_t i = 0; i < k_people; ++i) {
        const PersonBlock& person = c.world->gait.people[i / k_block];
        size_t lane = i % k_block;
        for (size_t joint = left_upper_leg; joint <= left_toes; ++joint) {
            float turned = angle_between(against_parent(c.before, i, joint), against_parent(poses, i, joint));
            EXPECT_LT(turned, k_fastest_walking * k_tick + 1e-4f) << i << " " << k_joint_names[joint];
            at_the_limit += turned > k_fastest_walking * k_tick - 1e-4f;
            auto parent = static_cast<size_t>(k_joint_parents[joint]);
            Vec3 rest, is;
            float* r[] = {&rest.x, &rest.y, &rest.z};
            float* p[] = {&is.x, &is.y, &is.z};
            for (size_t k = 0; k < 3; ++k) {
                *r[k] = person.joints[joint][k][lane] - person.joints[parent][k][lane];
                *p[k] = poses[i / k_block].position[joint][k][lane] -
                        poses[i / k_block].position[parent][k][lane];
            }
            EXPECT_NEAR(length(is), length(rest), 1e-6f);
            // A leg that did not jump is not touched, whoever stands beside it in the block.
            if (!thrown(i)) {
                for (size_t k = 0; k < 4; ++k)
                    EXPECT_EQ(poses[i / k_block].rotation[joint][k][lane],
                              c.now[i / k_block].rotation[joint][k][lane]);
            }
        }
    }
    EXPECT_GT(at_the_limit, 30);
}

TEST(JointLimits, HoldsHipsAndAnklesWithinTheirRanges) {
    Crowded c = crowded();
    // The same extreme pose twice, so that nothing is too fast: a leg swung far back, its foot bent far up
    // and rolled.
    std::vector<PoseBlock> poses = c.now;
    auto bend = [](Quat q) {  // of a part that hangs, degrees
        Vec3 d = rotate(q, Vec3{0, -1, 0});
        return arctan2(d.z, -d.y) / k_radians;
    };
    auto lift = [](Quat q) {  // of a foot
        Vec3 d = rotate(q, Vec3{0, 0, 1});
        return arctan2(d.y, d.z) / k_radians;
    };
    for (size_t i = 0; i < k_people; ++i) {
        size_t b = i / k_block, lane = i % k_block;
        for (size_t leg : {left_upper_leg, right_upper_leg}) {
            Quat pelvis = joint_pose(poses, i, hips).rotation;
            Quat thigh = pelvis * rotation_x(50 * k_radians), foot = thigh * rotation_x(-70 * k_radians);
            set_rotation(poses[b], leg, lane, thigh);
            set_rotation(poses[b], leg + 1, lane, thigh);
            set_rotation(poses[b], leg + 2, lane, foot * rotation_z(50 * k_radians));
            set_rotation(poses[b], leg + 3, lane, foot);
        }
    }
    EXPECT_NEAR(bend(against_parent(poses, 5, left_upper_leg)), -50, 0.1f);
    EXPECT_NEAR(lift(against_parent(poses, 5, left_foot)), 70, 0.1f);
    std::vector<PoseBlock> before = poses;
    for (int tick = 0; tick < 10; ++tick) {
        std::vector<PoseBlock> asked = poses;
        restrain_legs(c.world->gait, 0, poses.size(), k_tick, before, asked);
        before = asked;
    }
    for (size_t i = 0; i < k_people; ++i) {
        for (size_t leg : {left_upper_leg, right_upper_leg}) {
            float hip = bend(against_parent(before, i, leg)),
                  ankle = lift(against_parent(before, i, leg + 2));
            EXPECT_GE(hip, joint_limits::k_hip.bend.low);
            EXPECT_LT(hip, joint_limits::k_hip.bend.low + 2);
            EXPECT_LE(ankle, joint_limits::k_ankle.bend.high);
            EXPECT_GT(ankle, joint_limits::k_ankle.bend.high - 2);
            Quat q = against_parent(before, i, leg + 2);
            EXPECT_LE(std::fabs(2 * arctan2(q.z, q.w)) / k_radians, joint_limits::k_ankle.twist.high);
        }
    }
}

}  // namespace
}  // namespace flaneur
