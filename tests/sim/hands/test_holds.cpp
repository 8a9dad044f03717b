// What hands do that have nothing to reach for.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstring>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/hands/holds.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pose.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr uint64_t k_seed = 7;
constexpr int k_steps = 60;  // ticks that a hand takes, in these tests

// People from 4 to 87 years, sixteen of them, who all do the same on level ground.
struct Group {
    Ground ground = square(200);
    std::vector<Body> bodies;
    std::vector<Vec3> position = std::vector<Vec3>(k_block);
    std::vector<Vec2> velocity = std::vector<Vec2>(k_block);
    std::vector<float> heading = std::vector<float>(k_block), turn_rate = std::vector<float>(k_block);
    RootMotion root{position.data(), velocity.data(), heading.data(), turn_rate.data()};
    Gait gait;
    std::vector<PoseBlock> poses = std::vector<PoseBlock>(1), before = std::vector<PoseBlock>(1);
    uint32_t tick = 0;

    explicit Group(Wear wear = {}, bool has_postures = false) {
        std::vector<uint32_t> body(k_block);
        std::vector<float> scale(k_block, 1);
        std::vector<Manner> manners;
        for (uint32_t i = 0; i < k_block; ++i) {
            float years = 4 + 83.0f * static_cast<float>(i) / (k_block - 1);
            bodies.push_back(standard_body(lerp(1.02f, 1.8f, smoothstep(3, 19, years))));
            // Some stout, some thin.
            bodies.back().girth = girth_of(bodies.back());
            float thick = 0.85f + 0.15f * static_cast<float>(i % 4);
            for (float Girth::*size : {&Girth::hip, &Girth::belly, &Girth::back, &Girth::chest})
                bodies.back().girth.*size *= thick;
            bodies.back().wear = wear;
            body[i] = i;
            Manner middle = manner_at_age(years);
            if (has_postures) middle.postures = postures_at_age(years, i % 2 == 0);
            manners.push_back(draw_manner(middle, {k_seed, i, 0, Purpose::style}));
        }
        start_gait(gait, k_block, bodies, body.data(), scale.data(), root, surroundings_of(ground), k_seed,
                   manners.data());
        pose_blocks(gait, 0, 1, poses);
    }
    // A tick of all at `speed` along +z.
    void advance(float speed) {
        for (uint32_t i = 0; i < k_block; ++i) {
            velocity[i] = {0, speed};
            position[i].z += speed * k_tick;
        }
        advance_gait(gait, 0, k_block, root, surroundings_of(ground), k_seed, tick, k_tick);
    }
    void pose() {
        poses.swap(before);
        pose_blocks(gait, 0, 1, k_tick, before, poses);
        restrain_legs(gait, 0, 1, k_tick, before, poses);
        ++tick;
    }
    void hold(Hold kind, Side side) {
        for (int lane = 0; lane < k_block; ++lane)
            set_hold(gait.blocks[0], gait.people[0], lane, side, kind, k_steps * k_tick, k_tick);
    }
    float weight(size_t i, Side side) const { return gait.blocks[0].holds[side].weight[i]; }
    JointPose joint(size_t i, int j) const { return joint_pose(poses, i, static_cast<Joint>(j)); }

    // Where a hold wants the wrist.
    Vec3 place(size_t i, Side side) const {
        const HoldBlock& h = gait.blocks[0].holds[side];
        Vec3 p{h.x[i], h.y[i], h.z[i]};
        switch (static_cast<HoldAnchor>(static_cast<int>(h.anchor[i]))) {
            case HoldAnchor::chest:
                return joint(i, side == k_left ? left_upper_arm : right_upper_arm).position +
                       rotate(joint(i, upper_chest).rotation, p);
            case HoldAnchor::pelvis:
                return joint(i, hips).position + rotate(joint(i, hips).rotation, p);
            default:
                return position[i] + p;
        }
    }
};

constexpr int shoulder_of(Side side) { return side == k_left ? left_upper_arm : right_upper_arm; }

float beyond(DegreeSpan span, float angle) {
    return std::max({0.0f, span.low - angle / k_radians, angle / k_radians - span.high});
}

// Degrees by which a joint of an arm is beyond what it can.
float beyond_limits(const Group& people, size_t i, Side side) {
    float worst = 0;
    for (auto [offset, limits] : {std::pair{0, joint_limits::k_shoulder}, {2, joint_limits::k_wrist}}) {
        int j = shoulder_of(side) + offset;
        Quat turn = conjugate(people.joint(i, k_joint_parents[static_cast<size_t>(j)]).rotation) *
                    people.joint(i, j).rotation;
        Vec3 along = rotate(turn, Vec3{0, -1, 0});
        float mirror = side == k_left ? 1.0f : -1.0f;
        worst = std::max({worst, beyond(limits.bend, arctan2(along.z, -along.y)),
                          beyond(limits.side, mirror * (k_pi / 2 - arccos(along.x))),
                          beyond(limits.twist, wrap_angle(2 * arctan2(turn.y, turn.w)))});
    }
    int elbow = shoulder_of(side) + 1;
    Quat turn = conjugate(people.joint(i, elbow - 1).rotation) * people.joint(i, elbow).rotation;
    Vec3 along = rotate(turn, Vec3{0, -1, 0});
    float bend = arccos(clamp(-along.y, -1, 1)) * (along.z < 0 ? -1 : 1);
    return std::max({worst, beyond(joint_limits::k_elbow.bend, bend),
                     beyond(joint_limits::k_elbow.twist, wrap_angle(2 * arctan2(turn.y, turn.w)))});
}

// Degrees that the fastest joint of an arm turns in a second.
float fastest_joint(const Group& people, size_t i, Side side) {
    float most = 0;
    for (int j = shoulder_of(side); j <= shoulder_of(side) + 2; ++j) {
        auto turn = [&](const std::vector<PoseBlock>& poses) {
            Quat parent = joint_pose(poses, i, Joint(k_joint_parents[static_cast<size_t>(j)])).rotation;
            return conjugate(parent) * joint_pose(poses, i, Joint(j)).rotation;
        };
        float same = std::min(std::fabs(dot(turn(people.before), turn(people.poses))), 1.0f);
        most = std::max(most, 2 * arccos(same) / k_radians / k_tick);
    }
    return most;
}

TEST(Holds, EveryHandGetsToItsPlaceAndBackWithinWhatArmsCan) {
    for (float speed : {0.0f, 0.9f})
        for (int kind = 1; kind < k_hold_count; ++kind) {
            Group people;
            for (int t = 0; t < 90; ++t) people.advance(speed), people.pose();
            for (int t = 0; t < 4 * k_steps; ++t) {
                Hold wanted = t < 2 * k_steps ? static_cast<Hold>(kind) : Hold::none;
                for (Side side : {k_left, k_right}) people.hold(wanted, side);
                people.advance(speed);
                people.pose();
                for (Side side : {k_left, k_right})
                    for (size_t i = 0; i < k_block; ++i) {
                        auto said = [&] {
                            return "hold " + std::to_string(kind) + ", walker " + std::to_string(i) +
                                   ", weight " + std::to_string(people.weight(i, side));
                        };
                        ASSERT_LE(beyond_limits(people, i, side), 0) << said();
                        ASSERT_LT(fastest_joint(people, i, side), 900) << said();
                        if (people.weight(i, side) < 1) continue;
                        Vec3 wrist = people.joint(i, shoulder_of(side) + 2).position;
                        ASSERT_LT(length(wrist - people.place(i, side)), 0.03f) << said();
                    }
            }
            for (size_t i = 0; i < k_block; ++i) ASSERT_EQ(people.weight(i, k_left), 0);
        }
}

TEST(Holds, PlacesLieOnTheBodyWhateverItsGirth) {
    struct Case {
        Hold left, right;
        float Girth::*size;     // by which the wrist goes
        int joint;              // from which
        Vec3 way;               // along this axis,
        float nearest, beyond;  // so far beyond its surface, of the body's height
    };
    const Case cases[] = {
        {Hold::pocket, Hold::pocket, &Girth::hip, hips, {1, 0, 0}, -0.03f, 0.01f},
        {Hold::hip, Hold::hip, &Girth::hip, hips, {1, 0, 0}, 0.005f, 0.04f},
        {Hold::clasp_over, Hold::clasp_under, &Girth::belly, hips, {0, 0, 1}, 0.005f, 0.04f},
        {Hold::behind_over, Hold::behind_under, &Girth::back, hips, {0, 0, -1}, -0.005f, 0.03f},
        {Hold::fold_over, Hold::fold_under, &Girth::chest, upper_chest, {0, 0, 1}, 0.005f, 0.04f},
        {Hold::bag_strap, Hold::pack_strap, &Girth::chest, upper_chest, {0, 0, 1}, 0.005f, 0.04f},
    };
    for (const Case& c : cases) {
        Group people;
        for (int t = 0; t < k_steps + 1; ++t) people.hold(c.left, k_left), people.hold(c.right, k_right);
        people.pose();
        for (size_t i = 0; i < k_block; ++i) {
            const Body& body = people.bodies[i];
            Quat turn = conjugate(people.joint(i, c.joint).rotation);
            auto local = [&](int j) {
                return rotate(turn, people.joint(i, j).position - people.joint(i, c.joint).position);
            };
            Vec3 left = local(left_hand), right = local(right_hand);
            for (Vec3 wrist : {left, Vec3{-right.x, right.y, right.z}}) {
                float out = (dot(wrist, c.way) - body.girth.*c.size) / body.height;
                EXPECT_GT(out, c.nearest) << static_cast<int>(c.left) << " of " << i;
                EXPECT_LT(out, c.beyond) << static_cast<int>(c.left) << " of " << i;
            }
            // Hands that meet have their wrists less than a hand apart.
            bool meet = c.left == Hold::clasp_over || c.left == Hold::behind_over;
            EXPECT_TRUE(!meet || std::fabs(left.x - right.x) < 0.11f * body.height) << i;
        }
    }
}

TEST(Holds, HandsGoRoundTheBodyNotThroughIt) {
    for (Hold kind : {Hold::hip, Hold::clasp_over, Hold::clasp_under, Hold::behind_over, Hold::behind_under,
                      Hold::fold_over, Hold::fold_under, Hold::across, Hold::bag_strap, Hold::pack_strap}) {
        Group people;
        for (int t = 0; t < k_steps; ++t) {
            people.hold(kind, k_left);
            people.pose();
            for (size_t i = 0; i < k_block; ++i) {
                JointPose hip = people.joint(i, hips);
                Vec3 wrist =
                    rotate(conjugate(hip.rotation), people.joint(i, left_hand).position - hip.position);
                Girth girth = people.bodies[i].girth;
                // The trunk as an ellipse, a little thinner than it is.
                float depth = wrist.z < 0 ? girth.back : girth.belly;
                float x = wrist.x / (0.95f * girth.hip), z = wrist.z / (0.95f * depth);
                EXPECT_GT(x * x + z * z, 1) << static_cast<int>(kind) << " of " << i << " at " << t;
            }
        }
    }
}

TEST(Holds, HandsGoSlowlyAtBothEnds) {
    Group people;
    float last = 0, most = 0, first = 0, end = 0;
    for (int t = 0; t < k_steps; ++t) {
        people.hold(Hold::hip, k_left);
        float gone = people.weight(0, k_left) - last;
        ASSERT_GE(gone, 0);
        if (t == 1) first = gone;
        end = gone;
        most = std::max(most, gone);
        last += gone;
    }
    EXPECT_FLOAT_EQ(last, 1);
    EXPECT_LT(first, most / 5);
    EXPECT_LT(end, most / 5);
}

TEST(Holds, ArmsWithoutAnyAreAsTheyWere) {
    Group free, some;
    for (int t = 0; t < 100; ++t) {
        for (int lane = 0; lane < k_block; lane += 3)
            set_hold(some.gait.blocks[0], some.gait.people[0], lane, k_left, Hold::fold_over, 1, k_tick);
        for (Group* people : {&free, &some}) people->advance(1.2f), people->pose();
    }
    bool differ = false;
    for (int j = 0; j < k_joint_count; ++j)
        for (int lane = 0; lane < k_block; ++lane)
            for (int c = 0; c < 4; ++c) {
                const auto &a = free.poses[0].rotation[j][c][lane], &b = some.poses[0].rotation[j][c][lane];
                bool same = std::memcmp(&a, &b, sizeof a) == 0;
                bool holds = lane % 3 == 0 && j >= left_upper_arm && j <= left_hand;
                ASSERT_TRUE(same || holds) << k_joint_names[size_t(j)] << " of " << lane;
                differ = differ || !same;
            }
    EXPECT_TRUE(differ);
}

TEST(Holds, SameBitsOnEveryInstructionSet) {
    Group people({}, true);
    int half_way = 0;
    for (int t = 0; t < 600; ++t) {
        people.advance(0);
        advance_holds(people.gait, 0, k_block, people.root, k_seed, people.tick, k_tick);
        people.pose();
        int here = 0;
        for (size_t i = 0; i < k_block; ++i)
            here += people.weight(i, k_left) > 0.1f && people.weight(i, k_left) < 0.9f;
        if (here == 0 || t % 4 != 0) continue;
        ++half_way;
        std::vector<PoseBlock> best(1), other(1);
        pose_blocks(people.gait, 0, 1, best);
        for (auto target : {HWY_SCALAR, HWY_SSSE3, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
            if (!(hwy::SupportedTargets() & target)) continue;
            hwy::SetSupportedTargetsForTest(target);
            pose_blocks(people.gait, 0, 1, other);
            hwy::SetSupportedTargetsForTest(0);
            ASSERT_EQ(0, std::memcmp(best.data(), other.data(), sizeof(PoseBlock)))
                << hwy::TargetName(target);
        }
    }
    EXPECT_GT(half_way, 10);
}

TEST(Holds, WhoStandsTakesSomePosturesAndLetsGoBeforeWalkingOff) {
    Group people({.pockets = true}, true);
    int held[k_posture_count] = {}, all = 0;
    uint32_t changes = 0;
    std::vector<int32_t> last(k_block);
    auto step = [&](float speed) {
        people.advance(speed);
        advance_holds(people.gait, 0, k_block, people.root, k_seed, people.tick, k_tick);
        ++people.tick;
    };
    constexpr int k_seconds = 300;
    for (int t = 0; t < k_seconds * 60; ++t) {
        step(0);
        for (size_t i = 0; i < k_block; ++i) {
            int32_t posture = people.gait.blocks[0].posture[i];
            changes += posture != last[i];
            last[i] = posture;
            ++held[posture];
            ++all;
        }
    }
    float hanging = static_cast<float>(held[0]) / static_cast<float>(all);
    EXPECT_GT(hanging, 0.3f);
    EXPECT_LT(hanging, 0.8f);
    int kinds = 0;
    for (int count : held) kinds += count > 0;
    EXPECT_GE(kinds, 7);
    EXPECT_EQ(held[static_cast<int>(Posture::strap)], 0);  // without a bag
    float each = static_cast<float>(changes) / static_cast<float>(k_block);
    EXPECT_GT(each, k_seconds / 60.0f);
    EXPECT_LT(each, k_seconds / 10.0f);
    for (int t = 0; t < 120; ++t) step(1.8f);
    for (size_t i = 0; i < k_block; ++i)
        for (Side side : {k_left, k_right}) EXPECT_EQ(people.weight(i, side), 0);
}

TEST(Holds, PocketsBagsAndFullHandsSayWhichPosturesThereAre) {
    auto likes = [](Wear wear, Posture posture) {
        return Group(wear, true).gait.people[0].postures[static_cast<int>(posture)][8];
    };
    EXPECT_EQ(likes({}, Posture::pockets), 0);
    EXPECT_GT(likes({.pockets = true}, Posture::pockets), 0);
    EXPECT_EQ(likes({.pockets = true, .phone = true}, Posture::pockets), 0);
    EXPECT_GT(likes({.pockets = true, .phone = true}, Posture::pocket), 0);
    EXPECT_EQ(likes({}, Posture::strap), 0);
    EXPECT_GT(likes({.bag = Bag::backpack}, Posture::strap), 0);
    EXPECT_EQ(likes({.bag = Bag::backpack}, Posture::behind), 0);
    EXPECT_EQ(likes({.bag = Bag::handbag}, Posture::fold), 0);
    EXPECT_GT(likes({.bag = Bag::handbag}, Posture::clasp), 0);
    Group people({}, true);
    Body with_cane = standard_body(1.7f);
    with_cane.cane = standard_cane(1.7f);
    Manner manner;
    manner.postures.fill(1);
    start_walker(people.gait, 3, with_cane, 1, {}, 0, surroundings_of(people.ground), k_seed, manner);
    for (const auto& posture : people.gait.people[0].postures) EXPECT_EQ(posture[3], 0);
}

TEST(Holds, FullHandsTakeNothing) {
    for (Wear wear : {Wear{.pockets = true, .phone = true}, Wear{Bag::handbag, true}}) {
        Group people(wear, true);
        Side full = wear.phone ? k_right : k_left;
        int taken = 0;
        for (int t = 0; t < 200 * 60; ++t) {
            people.advance(0);
            advance_holds(people.gait, 0, k_block, people.root, k_seed, people.tick++, k_tick);
            for (size_t i = 0; i < k_block; ++i) {
                int32_t kind = people.gait.blocks[0].holds[full].kind[i];
                bool clasps = kind == static_cast<int32_t>(Hold::clasp_over) ||
                              kind == static_cast<int32_t>(Hold::clasp_under);
                ASSERT_TRUE(kind == 0 || (wear.bag == Bag::handbag && clasps)) << kind;
                taken += people.weight(i, full == k_left ? k_right : k_left) > 0;
            }
        }
        EXPECT_GT(taken, 1000);
    }
}

// Between the foremost and the hindmost direction of an upper arm, degrees.
float swing_of(Group& people, size_t i, Side side) {
    float low = 1e9f, high = -1e9f;
    for (int t = 0; t < 300; ++t) {
        people.advance(1.2f);
        people.pose();
        if (t < 120) continue;
        Vec3 arm =
            people.joint(i, shoulder_of(side) + 1).position - people.joint(i, shoulder_of(side)).position;
        float angle = arctan2(arm.z, -arm.y) / k_radians;
        low = std::min(low, angle), high = std::max(high, angle);
    }
    return high - low;
}

TEST(Holds, ABagStillsItsArm) {
    auto swing = [](Bag bag, Side side) {
        Group people({.bag = bag});
        return swing_of(people, 8, side);
    };
    float left = swing(Bag::none, k_left), right = swing(Bag::none, k_right);
    EXPECT_GT(left, 15);
    EXPECT_GT(right, 15);
    EXPECT_LT(swing(Bag::shoulder_bag, k_right), right / 2);
    EXPECT_LT(swing(Bag::handbag, k_left), left / 2);
    EXPECT_GT(swing(Bag::shoulder_bag, k_left), 0.9f * left);
    EXPECT_LT(swing(Bag::backpack, k_left), 0.95f * left);
}

}  // namespace
}  // namespace flaneur
