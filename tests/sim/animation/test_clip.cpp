#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/math.h"
#include "sim/world.h"
#include "tests/sim/random_poses.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

const Skeleton k_person = humanoid(standard_body(1.7f));

Clip clip_of(const std::vector<LocalPose>& keys, bool loops, Curve curve) {
    auto clip = make_clip(k_person, keys, 30, loops, curve);
    EXPECT_TRUE(clip) << (clip ? "" : clip.error().message);
    return std::move(clip).value();
}

float widest_angle(const LocalPose& a, const LocalPose& b) {
    float widest = 0;
    for (size_t j = 0; j < a.rotations.size(); ++j)
        widest = std::max(widest, angle_between(a.rotations[j], b.rotations[j]));
    return widest;
}

TEST(Clip, PassesThroughItsKeysAlmostExactly) {
    auto keys = random_poses(RandomKey{1}, k_joint_count, 3, 50);
    for (Curve curve : {Curve::linear, Curve::cubic})
        for (bool loops : {false, true}) {
            Clip clip = clip_of(keys, loops, curve);
            float worst = 0;
            for (size_t k = 0; k < keys.size(); ++k) {
                LocalPose pose = sample(clip, float(k) / float(loops ? 50 : 49));
                // Rounding the phase moves along the clip; neighbours are two radians apart.
                worst = std::max(worst, widest_angle(pose, keys[k]));
                ASSERT_LT(length(pose.offset - keys[k].offset), 4e-4f);
            }
            EXPECT_LT(worst, 0.01f * k_radians);
        }
}

TEST(Clip, QuantisesWithinItsBound) {
    float worst = 0, worst_way = 0;
    for (uint32_t n = 0; n < 2000; ++n) {
        LocalPose key = random_pose(RandomKey{2}, k_joint_count, 6, n);
        LocalPose pose = sample(clip_of({key}, false, Curve::linear), 0.3f);
        worst = std::max(worst, widest_angle(pose, key));
        worst_way = std::max(worst_way, std::fabs(pose.offset.x - key.offset.x));
    }
    EXPECT_LT(worst, 0.0035f * k_radians);
    EXPECT_GT(worst, 0.0005f * k_radians);
    EXPECT_LE(worst_way, 0.5f * k_offset_unit * 1.001f);
}

// A step of time is a small step of pose, over the seam as well, and forwards as backwards.
TEST(Clip, LoopsWithoutAJump) {
    auto keys = random_poses(RandomKey{3}, k_joint_count, 0.5f, 12);
    for (Curve curve : {Curve::linear, Curve::cubic}) {
        Clip clip = clip_of(keys, true, curve);
        EXPECT_FLOAT_EQ(clip.duration, 12 / 30.0f);
        LocalPose last = sample(clip, -1);
        for (int i = -1999; i <= 4000; ++i) {
            LocalPose now = sample(clip, float(i) / 2000);
            ASSERT_LT(widest_angle(last, now), 0.02f) << i;
            last = now;
        }
        EXPECT_LT(widest_angle(sample(clip, 0), sample(clip, 1)), 1e-6f);
    }
}

// A joint that turns all the way round comes back as the opposite quaternion.
TEST(Clip, TurnsRoundAndRoundThroughTheSeam) {
    std::vector<LocalPose> keys(10);
    for (size_t k = 0; k < keys.size(); ++k) {
        keys[k].rotations.assign(k_joint_count, {});
        keys[k].rotations[head] = rotation_y(2 * k_pi * float(k) / 10);
    }
    for (Curve curve : {Curve::linear, Curve::cubic}) {
        Clip clip = clip_of(keys, true, curve);
        for (int i = 0; i < 1000; ++i) {
            float phase = float(i) / 1000;
            Quat q = sample(clip, phase).rotations[head];
            ASSERT_LT(angle_between(q, rotation_y(2 * k_pi * phase)), 0.01f) << phase;
        }
    }
}

TEST(Clip, CubicIsSmoothAtItsKeysAndStaysAtItsEnds) {
    std::vector<LocalPose> keys(8);
    for (size_t k = 0; k < keys.size(); ++k) {
        keys[k].rotations.assign(k_joint_count, {});
        keys[k].rotations[chest] = rotation_x(0.4f * sin_cos(2 * k_pi * float(k) / 8).sine);
    }
    // Eight keys describe one sine: the curve follows it closer than the straight way does.
    float off[2] = {0, 0};
    for (Curve curve : {Curve::linear, Curve::cubic}) {
        Clip clip = clip_of(keys, true, curve);
        for (int i = 0; i < 400; ++i) {
            float phase = float(i) / 400;
            Quat wanted = rotation_x(0.4f * sin_cos(2 * k_pi * phase).sine);
            float& worst = off[int(curve)];
            worst = std::max(worst, angle_between(sample(clip, phase).rotations[chest], wanted));
        }
    }
    EXPECT_LT(off[1], 0.25f * off[0]);

    Clip once = clip_of(keys, false, Curve::cubic);
    for (float beyond : {-3.0f, 1.0f, 7.5f}) {
        size_t end = beyond < 0 ? 0 : 7;
        EXPECT_LT(angle_between(sample(once, beyond).rotations[chest], keys[end].rotations[chest]), 1e-4f);
    }
}

TEST(Clip, TakesAnyPhase) {
    for (bool loops : {false, true}) {
        Clip clip = clip_of(random_poses(RandomKey{4}, k_joint_count, 1, 5), loops, Curve::cubic);
        for (float phase : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 1e30f, -1e30f, 1 - 1e-8f, -1e-9f}) {
            for (Quat q : sample(clip, phase).rotations) ASSERT_NEAR(dot(q, q), 1, 1e-5f) << phase;
        }
    }
}

TEST(Clip, RefusesWhatItCannotKeep) {
    auto keys = random_poses(RandomKey{5}, k_joint_count, 1, 3);
    auto refusal = [](const Result<Clip>& clip) { return clip ? "" : clip.error().message; };
    EXPECT_NE(refusal(make_clip(k_person, {}, 30, true, Curve::linear)), "");
    EXPECT_NE(refusal(make_clip(k_person, keys, 0, true, Curve::linear)), "");
    auto bad = keys;
    bad[1].rotations.pop_back();
    EXPECT_NE(refusal(make_clip(k_person, bad, 30, true, Curve::linear)), "");
    bad = keys;
    bad[1].rotations[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(refusal(make_clip(k_person, bad, 30, true, Curve::linear)), "");
    bad = keys;
    bad[2].offset.z = -9;
    EXPECT_NE(refusal(make_clip(k_person, bad, 30, true, Curve::linear)).find("8 m"), std::string::npos);
    Skeleton broken = k_person;
    broken.parents[3] = 7;
    EXPECT_NE(refusal(make_clip(broken, keys, 30, true, Curve::linear)).find("joint 3"), std::string::npos);
}

// The procedural walk, taken apart into local rotations and put together again.
TEST(Skeleton, LocalAndWorldPosesAgree) {
    WorldOptions options;
    options.walkers = 40;
    options.threads = 1;
    auto world = make_world(std::make_shared<Ground>(square(40)), options);
    ASSERT_TRUE(world);
    for (int i = 0; i < 200; ++i) step(**world);
    const World& w = **world;
    std::vector<LaneRow> local(local_rows(k_joint_count));
    std::vector<PoseBlock> again(w.poses.size());
    for (size_t b = 0; b < w.poses.size(); ++b) {
        local_pose(w.gait.people[b], w.poses[b], local.data());
        world_pose(w.gait.people[b], local.data(), again[b]);
    }
    for (size_t i = 0; i < w.crowd.count; ++i)
        for (int j = 0; j < k_joint_count; ++j) {
            JointPose a = joint_pose(w.poses, i, Joint(j)), b = joint_pose(again, i, Joint(j));
            ASSERT_LT(length(a.position - b.position), 2e-3f) << k_joint_names[size_t(j)];
            ASSERT_LT(angle_between(a.rotation, b.rotation), 1e-4f) << k_joint_names[size_t(j)];
        }
}

// A tree that is no humanoid: a tail of five joints and two wings from its second.
TEST(Skeleton, AnyHierarchyMovesAsItsJointsSay) {
    Skeleton s;
    s.parents = {-1, 0, 1, 2, 3, 1, 5, 1, 7};
    for (size_t j = 0; j < s.parents.size(); ++j) {
        float f = float(j);
        s.places.push_back({0.1f * f, 0.3f, 0.05f * f * f});
        s.rotations.push_back(rotation_x(0.2f * f));
    }
    ASSERT_TRUE(check_skeleton(s));
    RandomKey key{6};
    std::vector<LaneRow> local(local_rows(9)), model(model_rows(9));
    std::vector<LocalPose> poses = random_poses(key, 9, 3, k_block);
    for (size_t i = 0; i < k_block; ++i) {
        for (size_t j = 0; j < 9; ++j) {
            Quat q = poses[i].rotations[j];
            size_t row = 4 * j;
            for (float f : {q.x, q.y, q.z, q.w}) local[row++].lanes[i] = f;
        }
        local[36].lanes[i] = poses[i].offset.x, local[37].lanes[i] = poses[i].offset.y;
        local[38].lanes[i] = poses[i].offset.z;
    }
    model_pose(s, local.data(), model.data());
    for (size_t i = 0; i < k_block; ++i) {
        std::vector<Vec3> place(9);
        std::vector<Quat> turn(9);
        for (size_t j = 0; j < 9; ++j) {
            Quat q = poses[i].rotations[j];
            auto p = size_t(s.parents[j]);
            place[j] = j == 0 ? s.places[0] + poses[i].offset : place[p] + rotate(turn[p], s.places[j]);
            turn[j] = j == 0 ? q : turn[p] * q;
            auto row = [&](size_t r) { return model[7 * j + r].lanes[i]; };
            ASSERT_LT(length(Vec3{row(0), row(1), row(2)} - place[j]), 1e-5f);
            ASSERT_LT(angle_between({row(3), row(4), row(5), row(6)}, turn[j]), 1e-5f);
        }
    }
}

}  // namespace
}  // namespace flaneur
