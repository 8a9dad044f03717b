// People who are pushed: who stays on his feet, who falls, lies and gets up, on level ground, on steps and by
// walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "sim/base/isa.h"
#include "sim/fall/bodies.h"
#include "sim/state.h"
#include "tests/debt.h"
#include "tests/sim/allocations.h"
#include "tests/sim/fall/pushed_world.h"

namespace flaneur {
namespace {

TEST(Falls, HarmlessPushesFellNobodyAndHardOnesEverybody) {
    for (const bool is_hard : {false, true}) {
        auto w = world_on(square(40), 60);
        for (int i = 0; i < 60; ++i) step(*w);
        push_all(*w, is_hard ? 1.01f * k_felling_push : 0.99f * k_harmless_push, 1);
        std::vector<bool> fell(w->crowd.count, false);
        for (int i = 0; i < 120; ++i) {
            step(*w);
            for (const WalkerId id : walkers(*w))
                if (has_fallen(*w, id)) fell[id.index] = true;
        }
        EXPECT_EQ(std::count(fell.begin(), fell.end(), true), is_hard ? 60 : 0);
    }
}

TEST(Falls, AHarderPushFellsWhomALighterOneDoes) {
    // The speed from which each falls, pushed each of eight ways; from there on always.
    constexpr int k_ways = 8, k_steps = 20;
    float least = 9, most = 0;
    for (int way = 0; way < k_ways; ++way) {
        std::vector<int> fell_from(40, k_steps);
        std::vector<int> fell(40, 0);
        for (int s = 0; s < k_steps; ++s) {
            auto w = world_on(square(40), 40);
            for (int i = 0; i < 30; ++i) step(*w);
            const float speed = 0.25f + 0.11f * static_cast<float>(s);
            const std::vector<WalkerId> all(walkers(*w).begin(), walkers(*w).end());
            for (const WalkerId id : all) {
                const float yaw = w->crowd.motion.heading[id.index] + static_cast<float>(way) * k_pi / 4;
                (void)push(*w, id, heading_direction(yaw) * (speed * mass(*w, id)));
            }
            for (int i = 0; i < 40; ++i) step(*w);
            for (const WalkerId id : walkers(*w)) {
                if (!has_fallen(*w, id)) continue;
                fell_from[id.index] = std::min(fell_from[id.index], s);
                ++fell[id.index];
            }
        }
        for (size_t i = 0; i < fell.size(); ++i) {
            EXPECT_EQ(fell[i], k_steps - fell_from[i]) << "walker " << i << ", way " << way;
            least = std::min(least, 0.25f + 0.11f * static_cast<float>(fell_from[i]));
            most = std::max(most, 0.25f + 0.11f * static_cast<float>(fell_from[i]));
        }
    }
    std::printf("falls from %.2f to %.2f m/s on\n", static_cast<double>(least), static_cast<double>(most));
    EXPECT_GT(most - least, 0.8f);  // the old and small from behind, the young and tall from the front
}

// How many of the walkers have fallen within two seconds who are pushed so many times, `apart` ticks apart.
int fell_by(float speed, int times, uint32_t apart) {
    auto w = world_on(square(40), 40);
    for (int i = 0; i < 30; ++i) step(*w);
    const std::vector<WalkerId> all(walkers(*w).begin(), walkers(*w).end());
    std::vector<bool> fell(w->crowd.count, false);
    for (uint32_t t = 0; t < 120; ++t) {
        if (t % apart == 0 && t / apart < static_cast<uint32_t>(times))
            for (const WalkerId id : all) (void)push(*w, id, Vec2{1, 0} * (speed * mass(*w, id)));
        step(*w);
        for (const WalkerId id : all)
            if (has_fallen(*w, id)) fell[id.index] = true;
    }
    return static_cast<int>(std::count(fell.begin(), fell.end(), true));
}

TEST(Falls, PushesThatFollowEachOtherAddUp) {
    EXPECT_EQ(fell_by(0.29f, 1, 60), 0);
    EXPECT_GT(fell_by(0.29f, 12, 4), 30);  // 3.5 m/s within a second
    EXPECT_EQ(fell_by(0.29f, 2, 60), 0) << "what is over a second ago is over";
}

TEST(Falls, WhoIsPushedAgainstOthersPassesAPartOn) {
    // A row along x, 3 cm apart; the first is pushed along it, or away from it.
    for (const float way : {1.0f, -1.0f}) {
        auto w = world_on(square(20), 0);
        std::vector<WalkerId> row;
        for (int i = 0; i < 5; ++i) {
            const Vec3 place{0.43f * static_cast<float>(i), 0, 0};
            const auto id = add_walker(*w, {.place = place, .kind = 0});
            ASSERT_TRUE(id) << id.error().message;
            row.push_back(*id);
        }
        for (int i = 0; i < 10; ++i) step(*w);
        (void)push(*w, row[0], Vec2{way, 0} * (1.2f * mass(*w, row[0])));
        const Fall *first = fall_of(*w, row[0].index), *second = fall_of(*w, row[1].index),
                   *third = fall_of(*w, row[2].index);
        ASSERT_TRUE(first);
        EXPECT_EQ(second != nullptr && third != nullptr, way > 0);
        if (!second || !third) continue;
        EXPECT_NEAR(length(first->carried), 0.6f, 1e-3f);
        EXPECT_NEAR(length(second->carried), 0.3f, 1e-3f);
        // No momentum is won or lost.
        float whole = 0;
        for (const WalkerId id : row)
            if (const Fall* f = fall_of(*w, id.index)) whole += f->carried.x * mass(*w, id);
        EXPECT_NEAR(whole, 1.2f * mass(*w, row[0]), 0.5f);
    }
}

struct Told {
    float longest = 0;  // seconds on the ground
    float deepest = 0;  // metres of a ball in the ground, and in a wall
    float in_wall = 0;
    float farthest = 0;  // metres that a drawn joint goes in a tick
    uint32_t falls = 0;
};

// Everybody is pushed about for a minute.
Told pushed_about(World& w, float speed, uint32_t seconds) {
    Told told;
    std::vector<uint32_t> down(w.crowd.capacity, 0);
    std::vector<std::array<Vec3, k_joint_count>> was(w.crowd.capacity);
    for (uint32_t t = 0; t < seconds * k_ticks_a_second; ++t) {
        if (t % 600 == 60) push_all(w, speed, t);
        step(w);
        for (const WalkerId id : walkers(w)) {
            const uint32_t i = id.index;
            told.falls += down[i] == 0 && has_fallen(w, id);
            down[i] = has_fallen(w, id) ? down[i] + 1 : 0;
            told.longest = std::max(told.longest, static_cast<float>(down[i]) * k_tick);
            const BodyPose pose = body_pose_of(w.poses, i);
            const PersonBlock& person = w.gait.people[i / k_block];
            const auto places = places_of(pose, person, static_cast<int>(i % k_block));
            if (t > 0)
                for (int j = 0; j < k_joint_count; ++j)
                    told.farthest = std::max(told.farthest, length(places[j] - was[i][j]));
            was[i] = places;
            const Fall* f = fall_of(w, i);
            if (!f || f->phase == FallPhase::sways) continue;
            const auto balls = balls_of(pose, f->segments, person, static_cast<int>(i % k_block));
            for (int k = 0; k < k_ball_count; ++k) {
                // A foot that pushes off is bent at the ball; those that fall are stiff.
                const bool is_tip = k == 14 || k == 22;
                if (is_tip && f->phase == FallPhase::falls && w.tick - f->began < 8) continue;
                if (const auto hit = ground_at(w.around, balls[k], 0.6f, 3)) {
                    const float deep = f->segments.radius[k] - (balls[k].y - hit->height) * hit->normal.y;
                    told.deepest = std::max(told.deepest, deep);
                }
                if (const auto wall = closest_wall(w.around, balls[k], f->segments.radius[k]))
                    told.in_wall = std::max(told.in_wall, f->segments.radius[k] - wall->distance);
            }
        }
    }
    std::printf("%u falls, %.1f s on the ground, %.1f mm in it, %.1f mm in walls, joints go %.0f mm a tick\n",
                told.falls, static_cast<double>(told.longest), 1e3 * static_cast<double>(told.deepest),
                1e3 * static_cast<double>(told.in_wall), 1e3 * static_cast<double>(told.farthest));
    return told;
}

TEST(Falls, EverybodyGetsUpAgainOnLevelGround) {
    auto w = world_on(square(60), 60);
    const Told told = pushed_about(*w, 2, 30);
    EXPECT_GT(told.falls, 100u);
    EXPECT_LT(told.longest, 10);
    EXPECT_LT(told.deepest, 0.02f);
    EXPECT_LT(told.farthest, 0.25f);
    EXPECT_TRUE(w->crowd.downed.empty() || w->tick % 600 < 660);
}

TEST(Falls, AreTheSameHighUp) {
    Ground high;
    add_floor(high, {-20, -20}, {20, 20}, 37, Surface::plaza);
    auto w = world_on(std::move(high), 40);
    const Told told = pushed_about(*w, 2, 20);
    EXPECT_GT(told.falls, 60u);
    EXPECT_LT(told.longest, 10);
    EXPECT_LT(told.deepest, 0.02f);
    EXPECT_LT(told.farthest, 0.25f);
}

TEST(Falls, StepsAndWallsHold) {
    auto on_steps = world_on(steps(), 40);
    const Told steep = pushed_about(*on_steps, 2, 30);
    EXPECT_LT(steep.longest, 10);
    expect_at_most("depth in a slope of who falls on it, metres", wide(steep.deepest), 0.05, 0.06);
    expect_at_most("joints of who falls on a slope, metres a tick", wide(steep.farthest), 0.25, 0.28);
    auto narrow = world_on(corridor(20, 2.5f), 20);
    const Told tight = pushed_about(*narrow, 2, 30);
    EXPECT_LT(tight.longest, 10);
    expect_at_most("depth in steps of who falls between walls, metres", wide(tight.deepest), 0.02, 0.03);
    EXPECT_LT(tight.in_wall, 0.02f);
}

// Ball by ball and tick by tick, of those who fall or lie.
struct Within {
    long balls = 0, in_ground = 0;   // in all; more than 0.02 m in it
    float deepest = 0, in_wall = 0;  // metres
    long pairs = 0, in_another = 0;  // of bodies; more than 0.05 m in each other
    float pair_deepest = 0;
};
Within fallen_on(Ground (*ground)(), uint32_t people, int seeds) {
    Within in;
    for (int seed = 1; seed <= seeds; ++seed) {
        auto w = world_on(ground(), people, static_cast<uint64_t>(seed));
        for (uint32_t t = 0; t < 200; ++t) {
            if (t == 60) push_all(*w, 2.3f, static_cast<uint32_t>(seed));
            step(*w);
            std::vector<BodyInTheWay> bodies;
            for (const Fall& f : w->falls.all) {
                if (f.phase == FallPhase::sways || f.phase == FallPhase::rises) continue;
                const auto balls = balls_of(*w, f.walker, f.segments);
                for (size_t k = 0; k < k_ball_count; ++k) {
                    const bool is_tip = k == 14 || k == 22;  // see pushed_about()
                    if (is_tip && w->tick - f.fell < 8) continue;
                    const float radius = f.segments.radius[k];
                    float deep = 0;
                    if (const auto hit = ground_at(w->around, balls[k], 0.6f, 3))
                        deep = radius - (balls[k].y - hit->height) * hit->normal.y;
                    in.deepest = std::max(in.deepest, deep);
                    in.in_ground += deep > 0.02f;
                    ++in.balls;
                    if (const auto wall = closest_wall(w->around, balls[k], radius))
                        in.in_wall = std::max(in.in_wall, radius - wall->distance);
                }
                bodies.push_back({balls, f.segments.radius});
            }
            for (size_t i = 0; i < bodies.size(); ++i)
                for (size_t j = 0; j < i; ++j) {
                    if (length(bodies[i].balls[0] - bodies[j].balls[0]) > 2) continue;
                    float deep = 0;
                    for (size_t k = 0; k < k_ball_count; ++k)
                        deep = std::max(
                            deep, -nearest_to(bodies[j], bodies[i].balls[k], bodies[i].radius[k]).clear);
                    in.pair_deepest = std::max(in.pair_deepest, deep);
                    in.in_another += deep > 0.05f;
                    ++in.pairs;
                }
        }
    }
    std::printf(
        "%ld of %ld balls more than 20 mm in the ground, %.0f mm at most, %.0f mm in walls; %ld of %ld "
        "pairs more than 50 mm in each other, %.0f mm at most\n",
        in.in_ground, in.balls, 1e3 * wide(in.deepest), 1e3 * wide(in.in_wall), in.in_another, in.pairs,
        1e3 * wide(in.pair_deepest));
    return in;
}

TEST(Falls, NothingIsInGroundOrWallsOrAnother) {
    const Within kerbs = fallen_on(street, 40, 3);
    const Within stairs = fallen_on(steps, 40, 3);
    const Within walls = fallen_on([] { return corridor(20, 2.5f); }, 20, 3);
    const Within throng = fallen_on([] { return square(12); }, 40, 2);
    for (const Within& in : {kerbs, stairs, walls, throng}) {
        EXPECT_LT(in.in_wall, 0.02f);
        EXPECT_LT(in.in_ground, 1e-4f * static_cast<float>(in.balls));
        EXPECT_LT(in.in_another, 0.05f * static_cast<float>(in.pairs));
    }
    EXPECT_LT(walls.deepest, 0.02f);
    EXPECT_LT(throng.deepest, 0.02f);
}

TEST(Falls, AllocateNothing) {
    auto w = world_on(square(40), 50, 1, 1);
    for (int i = 0; i < 60; ++i) step(*w);
    push_all(*w, 2, 1);
    const size_t before = allocations();
    for (int i = 0; i < 600; ++i) step(*w);
    EXPECT_EQ(allocations(), before);
}

TEST(Falls, AreTheSameOnAllThreadsAndInstructionSetsAndFromAState) {
    uint64_t first = 0;
    std::vector<std::byte> kept;
    for (const int threads : {1, 2, 3}) {
        auto w = world_on(square(40), 50, 3, threads);
        for (uint32_t t = 0; t < 240; ++t) {
            if (t == 60) push_all(*w, 1.4f, t);
            if (t == 200 && threads == 1) save_state(*w, kept);
            step(*w);
        }
        if (threads == 1) first = hash_world(*w);
        EXPECT_EQ(hash_world(*w), first) << threads << " threads";
    }
    for (const std::string_view isa : isa_names()) {
        ASSERT_TRUE(use_isa(isa));
        auto w = world_on(square(40), 50, 3);
        for (uint32_t t = 0; t < 240; ++t) {
            if (t == 60) push_all(*w, 1.4f, t);
            step(*w);
        }
        EXPECT_EQ(hash_world(*w), first) << isa;
    }
    ASSERT_TRUE(use_isa("best"));
    auto w = world_on(square(40), 50, 3);
    ASSERT_TRUE(load_state(*w, kept));
    for (uint32_t t = 200; t < 240; ++t) step(*w);
    EXPECT_EQ(hash_world(*w), first);
}

}  // namespace
}  // namespace flaneur
