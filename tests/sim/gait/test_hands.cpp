// People led along walls, their hands watched.
#include <gtest/gtest.h>

#include <functional>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/gait/hands.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr size_t k_people = 96;
constexpr uint64_t k_seed = 7;

struct Lead {
    Vec2 position, velocity;
    float heading = 0;
};

// People who all take one way, each alone in the ground.
struct Procession {
    Ground ground;
    std::vector<Vec3> position = std::vector<Vec3>(k_people);
    std::vector<Vec2> velocity = std::vector<Vec2>(k_people);
    std::vector<float> heading = std::vector<float>(k_people), turn_rate = std::vector<float>(k_people);
    RootMotion root{position.data(), velocity.data(), heading.data(), turn_rate.data()};
    Gait gait;
    uint32_t tick = 0;

    Procession(Ground where, Lead start) : ground(std::move(where)) {
        put(start);
        std::vector<uint32_t> body(k_people);
        std::vector<float> scale(k_people);
        for (size_t i = 0; i < k_people; ++i) scale[i] = 0.9f + 0.002f * static_cast<float>(i);
        start_gait(gait, k_people, {standard_body(1.72f)}, body.data(), scale.data(), root,
                   surroundings_of(ground), k_seed);
    }
    void put(Lead lead) {
        for (size_t i = 0; i < k_people; ++i) {
            position[i] = at_height(lead.position, 0);
            velocity[i] = lead.velocity;
            heading[i] = lead.heading;
        }
    }
    void advance(Lead lead) {
        put(lead);
        advance_gait(gait, 0, k_people, root, surroundings_of(ground), k_seed, tick, k_tick);
        reach_for_walls(gait, 0, k_people, root, surroundings_of(ground), k_seed, tick, k_tick);
        ++tick;
    }
    const HandBlock& hands(size_t i, Side side) const { return gait.blocks[i / k_block].hands[side]; }
    float reach(size_t i, Side side) const { return hands(i, side).reach[i % k_block]; }
    Vec3 palm(size_t i, Side side) const {
        const HandBlock& h = hands(i, side);
        return {h.x[i % k_block], h.y[i % k_block], h.z[i % k_block]};
    }
    int reaching(Side side) const {
        int n = 0;
        for (size_t i = 0; i < k_people; ++i) n += reach(i, side) > 0.99f;
        return n;
    }
    float shoulder(size_t i) const { return gait.people[i / k_block].joints[left_upper_arm][1][i % k_block]; }
    float arm(size_t i) const {
        const auto& j = gait.people[i / k_block].joints;
        return j[left_upper_arm][1][i % k_block] - j[left_hand][1][i % k_block];
    }
};

// East along a wall `distance` away, which lies on the left for side +1, on the right for -1. The square's
// walls stand at z = -10 and 10.
Lead along_wall(float t, float speed, float distance, float side = 1) {
    return {{-9 + speed * t, side * (distance - 10)}, {speed, 0}, k_pi / 2};
}

TEST(Hands, TrailAlongTheWallBesideASlowWalk) {
    Procession people(square(20), along_wall(0, 1, 0.45f));
    std::vector<bool> touched(k_people);
    std::vector<float> last_reach(k_people);
    std::vector<Vec3> last_palm(k_people);
    int resting = 0;
    for (int t = 0; t < 17 * 60; ++t) {
        Lead lead = along_wall(static_cast<float>(t) * k_tick, 1, 0.45f);
        people.advance(lead);
        for (size_t i = 0; i < k_people; ++i) {
            float reach = people.reach(i, k_left);
            Vec3 palm = people.palm(i, k_left);
            ASSERT_EQ(people.reach(i, k_right), 0);
            ASSERT_LE(std::fabs(reach - last_reach[i]), 2.61f * k_tick);
            if (last_reach[i] > 0 && reach > 0) {
                ASSERT_LE(length(palm - last_palm[i]), 1.61f * k_tick);
            }
            if (reach > 0.99f) {
                ASSERT_NEAR(palm.z, -10, 0.01f);
                ASSERT_NEAR(people.hands(i, k_left).normal_z[i % k_block], 1, 1e-4f);
                ASSERT_GT(palm.y, 0.6f * people.shoulder(i));
                ASSERT_LT(palm.y, 0.9f * people.shoulder(i));
                ASSERT_GT(palm.x, lead.position.x);
                ASSERT_LT(palm.x, lead.position.x + 0.5f);
                Vec2 shoulder =
                    lead.position + Vec2{0, -0.108f * 1.72f * (0.9f + 0.002f * static_cast<float>(i))};
                ASSERT_LE(length(palm - at_height(shoulder, people.shoulder(i))), people.arm(i) + 0.02f);
                touched[i] = true;
                ++resting;
            }
            last_reach[i] = reach;
            last_palm[i] = palm;
        }
    }
    auto who = std::count(touched.begin(), touched.end(), true);
    EXPECT_GT(who, 20);  // some people do
    EXPECT_LT(who, 60);  // and others never
    EXPECT_GT(resting, 5000);

    // Away from the wall they let go.
    for (int t = 0; t < 90; ++t) people.advance({{8, -9.55f + static_cast<float>(t) * k_tick}, {0, 1}, 0});
    for (size_t i = 0; i < k_people; ++i) EXPECT_EQ(people.reach(i, k_left), 0);
}

#ifdef FLANEUR_SANITIZED  // a tenth of the speed, and the same code
constexpr float k_away[] = {-0.45f};
#else
constexpr float k_away[] = {0.45f, -0.45f, 0.36f, -0.36f};
#endif

TEST(Hands, LieFlatOnTheWallFingersAheadAndUp) {
    for (float away : k_away) {
        float side = away > 0 ? 1.0f : -1.0f, distance = std::fabs(away);
        Procession people(square(20), along_wall(0, 1, distance, side));
        std::vector<PoseBlock> poses(block_count(k_people));
        std::vector<Quat> last(k_people);
        bool left = side > 0;
        float wall = -10 * side;
        int resting = 0;
        for (int t = 0; t < 600; ++t) {
            people.advance(along_wall(static_cast<float>(t) * k_tick, 1, distance, side));
            pose_blocks(people.gait, 0, poses.size(), poses);
            for (size_t i = 0; i < k_people; ++i) {
                Quat wrist = joint_pose(poses, i, left ? left_hand : right_hand).rotation;
                // No hand turns faster than people turn theirs.
                if (t > 60) {
                    float same = std::fabs(wrist.x * last[i].x + wrist.y * last[i].y + wrist.z * last[i].z +
                                           wrist.w * last[i].w);
                    ASSERT_LT(2 * arccos(std::min(same, 1.0f)), 15 * k_tick) << i << " at " << t;
                }
                last[i] = wrist;
                if (people.reach(i, left ? k_left : k_right) < 1) continue;
                Vec3 fingers = rotate(wrist, {0, -1, 0}), inside = rotate(wrist, {left ? -1.0f : 1.0f, 0, 0});
                ASSERT_NEAR(inside.z, -side, 1e-4f) << "the palm faces the wall";
                ASSERT_GT(fingers.x, 0.5f) << "ahead";
                ASSERT_GT(fingers.y, 0.2f) << "and up";
                for (Joint joint : {left ? left_lower_arm : right_lower_arm, left ? left_hand : right_hand}) {
                    float off = (joint_pose(poses, i, joint).position.z - wall) * side;
                    ASSERT_GT(off, joint == left_hand || joint == right_hand ? 0.015f : 0.045f)
                        << k_joint_names[joint] << " of " << i << " at " << t;
                }
                ++resting;
            }
        }
        EXPECT_GT(resting, 2000);
    }
}

TEST(Hands, MirrorLeftAndRight) {
    Procession left(square(20), along_wall(0, 0.9f, 0.4f)), right(square(20), along_wall(0, 0.9f, 0.4f, -1));
    int most = 0;
    for (int t = 0; t < 600; ++t) {
        float time = static_cast<float>(t) * k_tick;
        left.advance(along_wall(time, 0.9f, 0.4f));
        right.advance(along_wall(time, 0.9f, 0.4f, -1));
        most = std::max(most, left.reaching(k_left));
        for (size_t i = 0; i < k_people; ++i) {
            ASSERT_EQ(left.reach(i, k_right), 0);
            ASSERT_EQ(right.reach(i, k_left), 0);
            ASSERT_NEAR(left.reach(i, k_left), right.reach(i, k_right), 1e-5f);
            Vec3 a = left.palm(i, k_left), b = right.palm(i, k_right);
            ASSERT_NEAR(a.x, b.x, 1e-4f);
            ASSERT_NEAR(a.z, -b.z, 1e-4f);
        }
    }
    EXPECT_GT(most, 10);
}

TEST(Hands, RestHigherAndStillWhileStanding) {
    Procession people(square(20), along_wall(5, 0, 0.45f));
    Lead lead{{0, -9.55f}, {0, 0}, k_pi / 2};
    for (int t = 0; t < 240; ++t) people.advance(lead);
    EXPECT_GT(people.reaching(k_left), 10);
    for (size_t i = 0; i < k_people; ++i) {
        if (people.reach(i, k_left) < 1) continue;
        Vec3 before = people.palm(i, k_left);
        EXPECT_GT(before.y, 0.8f * people.shoulder(i));
        people.advance(lead);
        if (people.reach(i, k_left) == 1) {
            EXPECT_LT(length(people.palm(i, k_left) - before), 1e-5f);
        }
    }
}

TEST(Hands, LeaveFastWalkersAndFarWallsAlone) {
    for (auto [speed, distance] : {std::pair{1.8f, 0.45f}, std::pair{1.0f, 1.2f}}) {
        Procession people(square(20), along_wall(0, speed, distance));
        for (int t = 0; t < 480; ++t) {
            people.advance(along_wall(static_cast<float>(t) * k_tick, speed, distance));
            for (size_t i = 0; i < k_people; ++i) {
                ASSERT_EQ(people.reach(i, k_left), 0);
                ASSERT_EQ(people.reach(i, k_right), 0);
            }
        }
    }
}

TEST(Hands, UseOneHandBetweenTwoWalls) {
    Procession people(corridor(30, 0.9f), {{2, 0.02f}, {0.8f, 0}, k_pi / 2});
    int most = 0;
    for (int t = 0; t < 1200; ++t) {
        people.advance({{2 + static_cast<float>(t) * 0.8f * k_tick, 0.02f}, {0.8f, 0}, k_pi / 2});
        // The right wall is a little nearer.
        most = std::max(most, people.reaching(k_right));
        for (size_t i = 0; i < k_people; ++i)
            ASSERT_EQ(people.reach(i, k_left) * people.reach(i, k_right), 0);
    }
    EXPECT_GT(most, 10);
}

// From a wall round a corner onto another, and past the end of a wall.
TEST(Hands, LetGoWithoutAJumpWhereTheWallEnds) {
    Ground ground;
    add_floor(ground, {-10, -10}, {10, 10}, 0, Surface::plaza);
    add_wall(ground, {-10, 0, 0}, {0, 0, 0}, 3);
    add_wall(ground, {0, 0, 0}, {0, 0, -5}, 3);
    index_ground(ground);
    Procession people(std::move(ground), {{-9, 0.4f}, {1, 0}, k_pi / 2});
    std::vector<Vec3> last(k_people);
    std::vector<float> last_reach(k_people);
    int most = 0;
    float x = -9, z = 0.4f, yaw = k_pi / 2;
    for (int t = 0; t < 900; ++t) {
        if (x > -0.3f)
            yaw = std::min(yaw + 2 * k_tick, k_pi);  // a quarter turn to the left, round the corner
        Vec2 v = heading_direction(yaw);
        x += v.x * k_tick;
        z += v.z * k_tick;
        people.advance({{x, z}, v, yaw});
        most = std::max(most, people.reaching(k_left));
        for (size_t i = 0; i < k_people; ++i) {
            Vec3 palm = people.palm(i, k_left);
            if (last_reach[i] > 0 && people.reach(i, k_left) > 0) {
                ASSERT_LE(length(palm - last[i]), 1.75f * k_tick);
            }
            // Never behind a wall.
            ASSERT_FALSE(people.reach(i, k_left) > 0 && palm.x < -1e-3f && palm.z < -1e-3f);
            last[i] = palm;
            last_reach[i] = people.reach(i, k_left);
        }
    }
    EXPECT_GT(most, 10);
    for (size_t i = 0; i < k_people; ++i) EXPECT_EQ(people.reach(i, k_left), 0);  // 5 m of wall are over
}

// In a crowd, through the whole step: an alley so narrow that its walls are within reach.
TEST(Hands, TouchTheWallsOfAnAlley) {
    int resting = 0;
    for (const uint64_t seed : {1, 2, 3, 4}) {
        WorldOptions options;
        options.walkers = 12;
        options.threads = 1;
        options.seed = seed;
        auto made = make_world(std::make_shared<Ground>(corridor(30, 1.6f)), options);
        ASSERT_TRUE(made) << (made ? "" : made.error().message);
        World& w = **made;
        for (int t = 0; t < 5400; ++t) {
            step(w);
            for (size_t i = 0; i < w.gait.count; ++i) {
                for (Side side : {k_left, k_right}) {
                    const HandBlock& hand = w.gait.blocks[i / k_block].hands[side];
                    size_t lane = i % k_block;
                    if (hand.reach[lane] <= 0.99f) continue;
                    ++resting;
                    ASSERT_NEAR(std::fabs(hand.z[lane]), 0.8f, 0.02f);
                    ASSERT_LT(std::fabs(hand.x[lane] - w.crowd.motion.position[i].x), 0.6f);
                }
            }
        }
    }
    EXPECT_GT(resting, 800);
}

}  // namespace
}  // namespace flaneur
