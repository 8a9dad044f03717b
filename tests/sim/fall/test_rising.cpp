// Those who get up: on level ground, on slopes and on steps no part of them is in the ground at any time,
// hands are on it while one is on hands and knees, nobody hangs in the air, nothing jumps, and all are up
// within ten seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/debt.h"
#include "tests/sim/fall/pushed_world.h"

namespace flaneur {
namespace {

Ground slope(float rises) {
    Ground ground;
    const float y = 30 * rises;
    add_quad(ground, {15, y, 30}, {15, -y, -30}, {-15, -y, -30}, {-15, y, 30}, Surface::plaza);
    return ground;
}

// A square full of blocks, so that most who fall do so beside a wall or a corner.
Ground blocks() {
    Ground ground = square(20);
    for (float x = -8; x <= 8; x += 3.2f)
        for (float z = -8; z <= 8; z += 3.2f) add_solid_box(ground, {x, 0, z}, {x + 1.2f, 2, z + 1.2f});
    return ground;
}

struct Told {
    int risen = 0;
    float longest = 0;        // seconds from the push until all have
    float deepest = 0;        // metres of a ball in the ground
    float hands_over = 0;     // metres, mean, as one has come to hands and knees
    float air = 0;            // metres, under all but arms
    int hangs = 0;            // ticks in a row that this is more than 0.05
    float feet_turn = 0;      // rad/s that knees, feet and toes turn against what carries them, at most
    float farthest = 0;       // metres that a joint goes in a tick
    float place_jumps = 0;    // metres, of the place that trajectories tell
    float heading_jumps = 0;  // radians
};

float turned(Quat before, Quat now) {
    const Quat by = conjugate(before) * now;
    return 2 * std::asin(std::min(1.0f, std::sqrt(by.x * by.x + by.y * by.y + by.z * by.z)));
}

bool is_of_arm(size_t ball) { return (ball >= 7 && ball <= 9) || (ball >= 15 && ball <= 17); }

Told all_get_up(Ground (*ground)(), uint32_t people, int seeds) {
    Told told;
    double hands = 0;
    int hand_count = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        auto w = world_on(ground(), people, static_cast<uint64_t>(seed));
        std::vector<BodyPose> was(w->crowd.capacity);
        std::vector<Vec3> place(w->crowd.capacity);
        std::vector<float> heading(w->crowd.capacity);
        std::vector<int> hangs(w->crowd.capacity);
        for (uint32_t t = 0; t < 700; ++t) {
            if (t == 60) push_all(*w, 2.3f, static_cast<uint32_t>(seed));
            step(*w);
            for (const WalkerId id : walkers(*w)) {
                const uint32_t i = id.index;
                const PersonBlock& person = w->gait.people[i / k_block];
                const int lane = static_cast<int>(i % k_block);
                const BodyPose now = body_pose_of(w->poses, i), before = was[i];
                const CrowdMotion& m = w->crowd.motion;
                const Vec3 moved = m.position[i] - place[i];
                const float turns = std::fabs(wrap_angle(m.heading[i] - heading[i]));
                was[i] = now, place[i] = m.position[i], heading[i] = m.heading[i];
                if (has_fallen(*w, id)) told.longest = static_cast<float>(t - 60) * k_tick;
                const Fall* f = fall_of(*w, i);
                if (!f || f->phase < FallPhase::lies) continue;
                const auto balls = balls_of(*w, i, f->segments);
                std::array<float, k_ball_count> clear;
                bool is_over_ground = true;
                for (size_t k = 0; k < k_ball_count; ++k) {
                    const auto hit = ground_at(w->around, balls[k], 0.6f, 3);
                    is_over_ground = is_over_ground && hit;
                    if (hit) clear[k] = (balls[k].y - hit->height) * hit->normal.y - f->segments.radius[k];
                }
                if (!is_over_ground) continue;  // hangs over an edge of all there is
                told.place_jumps = std::max(told.place_jumps, length(on_ground(moved)));
                told.heading_jumps = std::max(told.heading_jumps, turns);
                for (const float over : clear) told.deepest = std::max(told.deepest, -over);
                if (f->phase != FallPhase::rises || f->stage == RiseStage::done) continue;
                float air = 1;
                for (size_t k = 0; k < k_ball_count; ++k)
                    if (!is_of_arm(k)) air = std::min(air, clear[k]);
                told.air = std::max(told.air, air);
                hangs[i] = air > 0.05f ? hangs[i] + 1 : 0;
                told.hangs = std::max(told.hangs, hangs[i]);
                told.risen += f->stage == RiseStage::stand;
                if (f->stage == RiseStage::fours && f->share > 0.9f)
                    for (const size_t k : {9, 17}) hands += clear[k], ++hand_count;
                const auto from = places_of(before, person, lane), to = places_of(now, person, lane);
                for (int j = 0; j < k_joint_count; ++j)
                    told.farthest = std::max(told.farthest, length(to[j] - from[j]));
                for (const int j : {15, 16, 17, 19, 20, 21}) {
                    const int parent = k_joint_parents[j];
                    told.feet_turn = std::max(told.feet_turn,
                                              turned(conjugate(before.rotation[parent]) * before.rotation[j],
                                                     conjugate(now.rotation[parent]) * now.rotation[j]) /
                                                  k_tick);
                }
            }
        }
        EXPECT_TRUE(w->crowd.downed.empty());
    }
    told.hands_over = hand_count ? static_cast<float>(hands / hand_count) : 1;
    std::printf(
        "%.1f s, %.1f mm in the ground, hands %.1f mm over it, %.0f mm of air, %d ticks of more than 50, "
        "knees and feet %.1f rad/s, joints go "
        "%.0f mm, places %.0f mm and %.1f degrees in a tick\n",
        wide(told.longest), 1e3 * wide(told.deepest), 1e3 * wide(told.hands_over), 1e3 * wide(told.air),
        told.hangs, wide(told.feet_turn), 1e3 * wide(told.farthest), 1e3 * wide(told.place_jumps),
        wide(told.heading_jumps) / wide(k_radians));
    return told;
}

TEST(Rising, OnLevelGround) {
    const Told told = all_get_up([] { return square(40); }, 40, 4);
    EXPECT_GT(told.risen, 0);
    EXPECT_LT(told.longest, 10);
    EXPECT_LT(told.deepest, 0.02f);
    EXPECT_LT(told.hands_over, 0.01f);
    EXPECT_LE(told.hangs, 2);
    EXPECT_LT(told.feet_turn, 17);
    EXPECT_LT(told.farthest, 0.12f);
    EXPECT_LT(told.place_jumps, 0.02f);
    EXPECT_LT(told.heading_jumps, 0.05f);
}

TEST(Rising, BesideWalls) {
    const Told told = all_get_up(blocks, 40, 4);
    EXPECT_GT(told.risen, 0);
    EXPECT_LT(told.longest, 10);
    EXPECT_LT(told.deepest, 0.02f);
    EXPECT_LT(told.hands_over, 0.01f);
    EXPECT_LE(told.hangs, 2);
    expect_at_most("joints of who gets up beside a wall, metres a tick", wide(told.farthest), 0.12, 0.25);
}

TEST(Rising, OnASlope) {
    const Told told = all_get_up([] { return slope(0.2f); }, 40, 4);
    EXPECT_LT(told.longest, 10);
    EXPECT_LT(told.deepest, 0.02f);
    EXPECT_LT(told.hands_over, 0.02f);
    EXPECT_LE(told.hangs, 2);
    expect_at_most("joints of who gets up on a slope, metres a tick", wide(told.farthest), 0.12, 0.16);
}

TEST(Rising, OnSteps) {
    const Told told = all_get_up(steps, 40, 5);
    EXPECT_LT(told.longest, 10);
    EXPECT_LT(told.deepest, 0.02f);
    EXPECT_LT(told.hands_over, 0.05f);
    EXPECT_LT(told.air, 0.15f);
    // The edge of a step counts as ground beside it.
    expect_at_most("air of 5 cm under who gets up on steps, ticks in a row", told.hangs, 2, 24);
    expect_at_most("joints of who gets up on steps, metres a tick", wide(told.farthest), 0.12, 0.23);
    EXPECT_LT(told.place_jumps, 0.02f);
}

}  // namespace
}  // namespace flaneur
