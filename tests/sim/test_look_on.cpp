// Simulation level of detail: those afar of every eye go eight ticks at once, and those farther sixteen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/isa.h"
#include "sim/crowd/places.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr Vec3 k_eye{-45, 1.6f, -45};
constexpr float k_reach = 40;

// A square crowd at one of whose corners somebody looks on.
std::unique_ptr<World> made(int threads, uint32_t walkers = 320) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = threads;
    Ground ground = square(90);
    index_ground(ground);
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    look_from(**world, {&k_eye, 1}, k_reach);
    return std::move(*world);
}

float deepest(const World& w) {
    const Crowd& c = w.crowd;
    float most = -1;
    for (uint32_t i = 0; i < c.count; ++i)
        for (uint32_t j = i + 1; j < c.count; ++j) {
            const float d = length(on_ground(c.motion.position[i] - c.motion.position[j]));
            most = std::max(most, c.identity.radius[i] + c.identity.radius[j] - d);
        }
    return most;
}

TEST(LookOn, ThoseAfarWalkAsFastMeetNobodyAndStayOffWalls) {
    auto w = made(2);
    const Crowd& c = w->crowd;
    double pace[3] = {};
    int walking[3] = {};
    for (int tick = 0; tick < 40 * 60; ++tick) {
        step(*w);
        if (tick % 8 != 0) continue;
        ASSERT_LT(deepest(*w), 0.05f) << tick;
        for (uint32_t i = 0; i < c.count; ++i) {
            const Vec3 p = c.motion.position[i];
            ASSERT_TRUE(ground_at(*w->ground, p, 0.01f, 0.01f)) << i << " at " << p.x << " " << p.z;
            ASSERT_FALSE(closest_wall(*w->ground, p, 0.2f)) << i << " at " << p.x << " " << p.z;
            const uint32_t at_once = c.at_once[i / k_block];
            const int afar = at_once == k_farther_ticks ? 2 : at_once == k_afar_ticks ? 1 : 0;
            const float speed = length(c.motion.velocity[i]);
            if (speed < 0.3f) continue;
            ++walking[afar];
            pace[afar] += static_cast<double>(speed / c.identity.preferred_speed[i]);
        }
    }
    ASSERT_GT(walking[0], 1000);
    ASSERT_GT(walking[1], 5000);
    ASSERT_GT(walking[2], 5000);
    EXPECT_NEAR(pace[1] / walking[1], pace[0] / walking[0], 0.04);
    EXPECT_NEAR(pace[2] / walking[2], pace[0] / walking[0], 0.04);
}

// In whichever order blocks step, on however many threads and with whatever lanes; and from a state kept
// between two of their steps.
TEST(LookOn, IsEqualOnAnyThreadsAndTakenBack) {
    uint64_t expected = 0;
    for (const int threads : {1, 2, 7})
        for (const std::string_view isa : isa_names()) {
            ASSERT_TRUE(use_isa(isa));
            auto w = made(threads, 160);
            for (int tick = 0; tick < 203; ++tick) step(*w);
            std::vector<std::byte> bytes;
            save_state(*w, bytes);
            for (int tick = 0; tick < 100; ++tick) step(*w);
            const uint64_t hash = hash_world(*w);
            if (expected == 0) expected = hash;
            EXPECT_EQ(hash, expected) << threads << " threads, " << isa;
            ASSERT_TRUE(load_state(*w, bytes));
            for (int tick = 0; tick < 100; ++tick) step(*w);
            EXPECT_EQ(hash_world(*w), expected) << threads << " threads, " << isa << ", taken back";
        }
    ASSERT_TRUE(use_isa("best"));
}

// Bodies are shown where they would be by now: nobody jumps, neither afar nor as an eye comes or goes.
TEST(LookOn, NobodyIsSeenToJump) {
    auto w = made(2, 160);
    const Crowd& c = w->crowd;
    std::vector<Vec3> before(c.count);
    bool was_afar = false;
    for (int tick = 0; tick < 600; ++tick) {
        const Vec3 eye = tick / 100 % 2 == 0 ? k_eye : Vec3{1000, 0, 0};
        look_from(*w, {&eye, 1}, k_reach);
        step(*w);
        for (uint32_t i = 0; i < c.count; ++i) {
            was_afar |= c.at_once[i / k_block] > 1;
            for (const float between : {0.0f, 0.5f, 1.0f}) {
                const Vec3 hip = joint_between(*w, i, hips, between).position;
                // A body leads and lags its feet by some, as speed changes.
                if (tick > 0) {
                    ASSERT_LT(length(on_ground(hip - before[i])), 0.09f) << i << " at " << tick;
                }
                before[i] = hip;
            }
        }
    }
    EXPECT_TRUE(was_afar);
}

// However long a step is that is taken at once, no swing is over before it has begun.
TEST(LookOn, FeetOfThoseAfarSwingWithinTheirTime) {
    WorldOptions options;
    options.walkers = 300;
    options.kinds = {Kind{standard_body(1.75f)}, Kind{standard_body(1.05f), 1, 6},
                     Kind{standard_body(1.6f), 1, 80}};
    auto made = make_world(std::make_shared<const Ground>(steps()), options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    const Vec3 eye{5000, 0, 0};
    look_from(w, {&eye, 1});
    float least = 1, most = 0, longest = 0;
    for (int tick = 0; tick < 90 * 60; ++tick) {
        step(w);
        for (uint32_t i = 0; i < w.crowd.count; ++i) {
            for (const FootBlock& foot : w.gait.blocks[i / k_block].feet) {
                ASSERT_GE(foot.phase[i % k_block], 0) << i << " at " << tick;
                ASSERT_LT(foot.phase[i % k_block], 1) << i << " at " << tick;
            }
            ASSERT_TRUE(std::isfinite(w.crowd.motion.position[i].x)) << i << " at " << tick;
            // Nor does anybody squat or float, on steps up and down: hips stay about a leg above both feet.
            const float height = w.kinds[w.crowd.identity.body[i]].body.height * w.crowd.identity.scale[i];
            const Vec3 hip = joint_pose(w.poses, i, hips).position;
            const float over = hip.y - w.gait.blocks[i / k_block].base[i % k_block];
            least = std::min(least, over / height), most = std::max(most, over / height);
            for (const Joint foot : {left_foot, right_foot}) {
                const float leg = length(joint_pose(w.poses, i, foot).position - hip);
                longest = std::max(longest, leg / height);
            }
        }
    }
    EXPECT_GT(least, 0.42f);
    EXPECT_LT(most, 0.58f);
    EXPECT_LT(longest, 0.56f);
}

// Five to a square metre, more than anybody near minds, all of whom go sixteen ticks at once.
TEST(LookOn, AThrongAfarDoesNotPressIntoItself) {
    Ground ground = square(11);
    index_ground(ground);
    WorldOptions options;
    options.capacity = 484;
    options.threads = 2;
    auto made = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    for (int k = 0; k < 484; ++k) {
        const int row = k / 22, column = k % 22;
        const Vec3 place{0.45f * static_cast<float>(column) - 4.7f, 0,
                         0.45f * static_cast<float>(row) - 4.7f};
        ASSERT_TRUE(add_walker(w, {.place = place, .speed = 1.8f, .radius = 0.2f, .wanders = true})) << k;
    }
    const Vec3 eye{5000, 0, 0};
    look_from(w, {&eye, 1});
    float most = 0;
    for (int tick = 0; tick < 60 * 60; ++tick) {
        step(w);
        if (tick % 4 == 0) most = std::max(most, deepest(w));
    }
    EXPECT_LT(most, k_most_overlap + 0.002f);
}

// Who flees, and goes all of a step at once, is looked for where it is.
TEST(LookOn, NobodyStraysFartherFromItsSquareThanOthersLook) {
    Ground ground = square(90);
    index_ground(ground);
    auto made = make_world(std::make_shared<const Ground>(std::move(ground)), {.capacity = 2});
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    const auto hare = add_walker(w, {.place = Vec3{-40, 0, 1}, .speed = 2.0f}),
               hound = add_walker(w, {.place = Vec3{-43, 0, 0}, .speed = 2.0f});
    ASSERT_TRUE(hare && hound);
    ASSERT_TRUE(let_flee(w, *hare, *hound, 80));
    const Vec3 eye{5000, 0, 0};
    look_from(w, {&eye, 1});
    float most = 0;
    for (int tick = 0; tick < 25 * 60; ++tick) {
        step(w);
        const Vec2 p = on_ground(w.crowd.motion.position[hare->index]);
        const Filed filed = w.crowd.motion.filed[hare->index];
        const Vec2 low = Vec2{static_cast<float>(filed.column), static_cast<float>(filed.row)} * k_seen_cell;
        const float beside =
            std::max({low.x - p.x, p.x - low.x - k_seen_cell, low.z - p.z, p.z - low.z - k_seen_cell});
        ASSERT_LE(beside, w.crowd.scratch.strays) << tick;
        most = std::max(most, beside);
    }
    EXPECT_GT(most, 0.5f);
}

// Alone in its block it does not wait for the turn of those who were there before; nor does a block that
// comes near keep what it decided afar.
TEST(LookOn, WhoComesAndWhoComesNearActAtOnce) {
    auto w = made(1, 32);
    Crowd& c = w->crowd;
    const Vec3 eye{5000, 0, 0};
    look_from(*w, {&eye, 1}, k_reach);
    for (int tick = 0; tick < 40; ++tick) step(*w);
    ASSERT_EQ(c.at_once[0], k_farther_ticks);
    const std::vector<WalkerId> all = c.slots.living;
    for (uint32_t i = 0; i < k_block; ++i)
        ASSERT_TRUE(remove_walker(
            *w, *std::find_if(all.begin(), all.end(), [&](WalkerId id) { return id.index == i; })));
    step(*w);
    const auto id = add_walker(*w, {.place = Vec3{0, 0, 0}, .wanders = true});
    ASSERT_TRUE(id);
    ASSERT_LT(id->index, k_block);
    EXPECT_EQ(c.at_once[0], 1);

    // The other block, with an eye next to it: in the tick in which it is near it decides.
    look_from(*w, {}, k_reach);
    for (int tick = 0; tick < 16 && c.at_once[1] > 1; ++tick) {
        step(*w);
        if (c.at_once[1] == 1) {
            EXPECT_TRUE(decides(c, 1, w->tick - 1)) << tick;
        }
    }
    EXPECT_EQ(c.at_once[1], 1);
}

TEST(LookOn, WithoutEyesEverybodyIsInFull) {
    auto w = made(1, 64);
    look_from(*w, {}, k_reach);
    auto plain = made(1, 64);
    plain->crowd.onlookers = {};
    for (int tick = 0; tick < 60; ++tick) step(*w), step(*plain);
    EXPECT_EQ(hash_world(*w), hash_world(*plain));
    EXPECT_EQ(std::count(w->crowd.at_once.begin(), w->crowd.at_once.end(), 1),
              static_cast<std::ptrdiff_t>(w->crowd.at_once.size()));
}

}  // namespace
}  // namespace flaneur
