#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstring>

#include "sim/animation/layer.h"
#include "sim/base/math.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/random_poses.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

const Skeleton k_person = humanoid(standard_body(1.7f));

// A gesture that bends every joint by up to 30 degrees, slowly.
Clip gesture(uint32_t seed, bool loops) {
    auto keys = random_poses(RandomKey{seed}, k_joint_count, 0.3f, 5);
    return *make_additive_clip(k_person, keys, keys[0], 2, loops, Curve::cubic);
}

struct Standing {
    std::unique_ptr<World> world;
    std::vector<PoseBlock> poses;  // a copy to play on
};

Standing standing(uint32_t walkers) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = 1;
    Standing s{std::move(make_world(std::make_shared<Ground>(square(40)), options)).value(), {}};
    for (int i = 0; i < 100; ++i) step(*s.world);
    s.poses = s.world->poses;
    return s;
}

void play(Standing& s, ClipLayer& layer) {
    advance_plays(layer, k_tick);
    s.poses = s.world->poses;
    apply_plays(layer, 0, layer.plays.size(), s.poses);
}

TEST(Layer, NobodyMovesWhoPlaysNothing) {
    Standing s = standing(50);
    ClipLayer layer = make_layer({gesture(1, true)}, 50);
    layer.wanted[7] = layer.wanted[33] = 0;
    for (int t = 0; t < 60; ++t) play(s, layer);
    EXPECT_EQ(layer.plays.size(), 2u);
    for (size_t i = 0; i < 50; ++i) {
        bool moved = false;
        for (int j = 0; j < k_joint_count; ++j) {
            JointPose a = joint_pose(s.poses, i, Joint(j)), b = joint_pose(s.world->poses, i, Joint(j));
            bool same = std::memcmp(&a, &b, sizeof a) == 0;
            // Pelvis and legs keep every bit in any case.
            bool grounded = j == hips || j >= left_upper_leg;
            ASSERT_TRUE(same || !grounded) << i << " " << k_joint_names[size_t(j)];
            moved = moved || !same;
        }
        EXPECT_EQ(moved, i == 7 || i == 33) << i;
    }
}

TEST(Layer, BonesKeepTheirLengthsAndTheFullWeightTurnsByTheClip) {
    Standing s = standing(20);
    ClipLayer layer = make_layer({gesture(2, true)}, 20);
    std::fill(layer.wanted.begin(), layer.wanted.end(), uint16_t{0});
    for (int t = 0; t < 40; ++t) play(s, layer);
    for (size_t i = 0; i < 20; ++i) {
        LocalPose delta = sample(layer.clips[0], layer.plays[i].phase);
        ASSERT_EQ(layer.plays[i].walker, i);
        for (size_t j = spine; j <= right_hand; ++j) {
            auto parent = Joint(k_joint_parents[j]);
            JointPose now = joint_pose(s.poses, i, Joint(j)), old = joint_pose(s.world->poses, i, Joint(j));
            JointPose now_above = joint_pose(s.poses, i, parent);
            JointPose old_above = joint_pose(s.world->poses, i, parent);
            ASSERT_NEAR(length(now.position - now_above.position), length(old.position - old_above.position),
                        1e-5f);
            Quat local = conjugate(now_above.rotation) * now.rotation;
            Quat wanted = conjugate(old_above.rotation) * old.rotation * delta.rotations[j];
            ASSERT_LT(angle_between(local, wanted), 1e-4f) << k_joint_names[j];
        }
    }
}

// Switched on and off at any time, also while it fades, no joint turns quicker than fade and clip allow.
TEST(Layer, SwitchesWithoutAJump) {
    Standing s = standing(32);
    ClipLayer layer = make_layer({gesture(3, true), gesture(4, false)}, 32);
    auto last = s.poses;
    float fastest = 0;
    uint32_t n = 0;
    size_t ended = 0;
    bool was_there = false;
    for (int t = 0; t < 1500; ++t) {
        for (size_t i = 0; i < 32; ++i)
            if (random_between(RandomKey{5}, 0, 1, n++) < 0.04f)
                layer.wanted[i] = std::array<uint16_t, 3>{
                    0, 1, k_no_clip}[size_t(random_between(RandomKey{6}, 0, 2.99f, n))];
        size_t before = layer.plays.size();
        play(s, layer);
        ended += layer.plays.size() < before;
        for (const ClipPlay& p : layer.plays) was_there = was_there || p.fade == 1;
        for (size_t i = 0; i < 32; ++i)
            for (int j = spine; j <= right_hand; ++j)
                fastest = std::max(fastest, angle_between(joint_pose(last, i, Joint(j)).rotation,
                                                          joint_pose(s.poses, i, Joint(j)).rotation));
        last = s.poses;
    }
    EXPECT_GT(ended, 20u);
    EXPECT_TRUE(was_there);
    EXPECT_LT(fastest, 900 * k_radians / 60 * 0.5f) << "half of what counts as a pop";
}

TEST(Layer, AnotherClipWaitsUntilTheFirstIsSilent) {
    ClipLayer layer = make_layer({gesture(3, true), gesture(4, false)}, 4);
    layer.wanted[2] = 0;
    for (int t = 0; t < 20; ++t) advance_plays(layer, k_tick);
    layer.wanted[2] = 1;
    float fade = layer.plays[0].fade;
    for (int t = 0; t < 100; ++t) {
        advance_plays(layer, k_tick);
        ASSERT_EQ(layer.plays.size(), 1u);
        ASSERT_LE(std::fabs(layer.plays[0].fade - fade), k_tick / layer.fade_time * 1.001f);
        fade = layer.plays[0].fade;
    }
    EXPECT_EQ(layer.plays[0].clip, 1);
    EXPECT_FLOAT_EQ(fade, 1);
}

TEST(Layer, SameBitsOnEveryInstructionSetAndNoAllocation) {
    Standing s = standing(77);
    ClipLayer layer = make_layer({gesture(3, true), gesture(4, false)}, 77);
    for (size_t i = 0; i < 77; i += 2) layer.wanted[i] = uint16_t(i % 4 / 2);
    uint64_t before = allocations();
    for (int t = 0; t < 9; ++t) advance_plays(layer, k_tick);
    apply_plays(layer, 0, layer.plays.size(), s.poses);
    EXPECT_EQ(allocations(), before);
    ASSERT_EQ(layer.plays.size(), 39u);
    int tried = 0;
    for (auto target : {HWY_SCALAR, HWY_SSSE3, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
        if (!(hwy::SupportedTargets() & target)) continue;
        auto poses = s.world->poses;
        hwy::SetSupportedTargetsForTest(target);
        // In parts that fill no block.
        apply_plays(layer, 0, 5, poses);
        apply_plays(layer, 5, layer.plays.size(), poses);
        hwy::SetSupportedTargetsForTest(0);
        EXPECT_EQ(0, std::memcmp(poses.data(), s.poses.data(), poses.size() * sizeof(PoseBlock)))
            << hwy::TargetName(target);
        ++tried;
    }
    EXPECT_GE(tried, 1);
}

TEST(Layer, IdlesComeAfterASecondOfStanding) {
    Gait gait;
    gait.count = 2;
    gait.blocks.resize(1);
    std::memset(gait.blocks.data(), 0, sizeof(GaitBlock));
    gait.people.resize(1);
    std::memset(gait.people.data(), 0, sizeof(PersonBlock));
    gait.people[0].free_hands[1] = 3;
    ClipLayer layer = make_layer({gesture(3, true)}, 2);
    gait.blocks[0].standing[1] = 1;
    for (int t = 0; t < 59; ++t) want_idles(layer, gait);
    EXPECT_EQ(layer.wanted[1], k_no_clip);
    want_idles(layer, gait);
    EXPECT_EQ(layer.wanted[1], 0);
    EXPECT_EQ(layer.wanted[0], k_no_clip);
    gait.blocks[0].hands[k_left].reach[1] = 0.1f;
    want_idles(layer, gait);
    EXPECT_EQ(layer.wanted[1], k_no_clip);
    gait.blocks[0].hands[k_left].reach[1] = 0;
    gait.people[0].free_hands[1] = 2;  // a bag hangs from the other
    for (int t = 0; t < 120; ++t) want_idles(layer, gait);
    EXPECT_EQ(layer.wanted[1], k_no_clip);
}

#ifdef FLANEUR_SANITIZED  // a tenth of the speed, and the same code
constexpr uint32_t k_crowd = 40;
#else
constexpr uint32_t k_crowd = 150;
#endif

// The same crowd with and without: whoever stands long plays, and nothing below the spine knows of it.
TEST(Layer, CrowdsStandAsBefore) {
    auto crowd = [](std::vector<Clip> idles, int threads) {
        WorldOptions options;
        options.walkers = k_crowd;
        options.threads = threads;
        options.idles = std::move(idles);
        return std::move(make_world(std::make_shared<Ground>(square(40)), options)).value();
    };
    auto plain = crowd({}, 2), idle = crowd({gesture(3, true), gesture(4, true)}, 1),
         again = crowd({gesture(3, true), gesture(4, true)}, 3);
    size_t played = 0;
    for (int t = 0; t < 1200; ++t) {
        for (World* w : {plain.get(), idle.get(), again.get()}) step(*w);
        for (const ClipPlay& p : idle->idles.plays) played += p.fade == 1;
        for (size_t b = 0; b < plain->poses.size(); ++b) {
            const PoseBlock &x = plain->poses[b], &y = idle->poses[b];
            for (Joint j : {hips, left_upper_leg, left_foot, right_foot, right_toes}) {
                ASSERT_EQ(0, std::memcmp(x.position[j], y.position[j], sizeof x.position[j]));
                ASSERT_EQ(0, std::memcmp(x.rotation[j], y.rotation[j], sizeof x.rotation[j]));
            }
        }
    }
    EXPECT_GT(played, 100u) << "walker-ticks";
    EXPECT_EQ(hash_world(*idle), hash_world(*again));
    EXPECT_NE(hash_world(*idle), hash_world(*plain));
}

}  // namespace
}  // namespace flaneur
