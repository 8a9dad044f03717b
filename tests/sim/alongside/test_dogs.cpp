// Dogs among people: feet that stand, leads, who is inside of whom.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/alongside/alongside.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

std::unique_ptr<World> with_dogs(Ground ground, uint64_t seed, float dogs, uint32_t walkers,
                                 int threads = 1) {
    for (const float x : {-6.0f, 5.0f})
        ground.obstacles.push_back({{x, 0, x > 0 ? 3.0f : -6.5f}, 0, {0.12f, 0.12f}});
    index_ground(ground);
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = threads};
    options.along.dogs = dogs;
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

float below(const World& w, Vec3 at) {
    const auto hit = ground_at(w.around, at, 0.4f, 0.8f);
    return hit ? hit->height - at.y : 0;
}

struct Seen {
    float slides = 0, sinks = 0, floats = 0;  // metres, of pads that stand
    float farthest = 0, nearest = 9, inside = -9;
    float turned = 0, moved = 0;  // of a bone in a tick: radians, metres
    double walked = 0;
    uint32_t steps = 0, sniffs = 0, sits = 0;
};

void watch(World& w, uint32_t ticks, Seen& seen) {
    std::vector<std::array<Vec3, 4>> stood(w.alongside->dogs.size());
    std::vector<std::array<bool, 4>> stands(w.alongside->dogs.size(), std::array<bool, 4>{});
    std::vector<DogPose> before(w.alongside->dogs.size());
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        step(w);
        for (size_t d = 0; d < w.alongside->dogs.size(); ++d) {
            const Dog& dog = w.alongside->dogs[d];
            const DogPose pose = pose_dog(dog);
            for (int leg = 0; leg < 4; ++leg) {
                const auto k = static_cast<size_t>(leg);
                const Vec3 pad = posed_pad(dog, pose, static_cast<DogLeg>(leg));
                if (dog.feet[leg].share < 1) {
                    seen.steps += stands[d][k];
                    stands[d][k] = false;
                    seen.sinks = std::max(seen.sinks, below(w, pad));
                    continue;
                }
                if (!stands[d][k]) stood[d][k] = pad;
                stands[d][k] = true;
                seen.slides = std::max(seen.slides, length(pad - stood[d][k]));
                seen.sinks = std::max(seen.sinks, below(w, pad));
                seen.floats = std::max(seen.floats, -below(w, pad));
            }
            if (tick > 0)
                for (size_t j = 0; j < pose.size(); ++j) {
                    seen.moved = std::max(seen.moved, length(pose[j].position - before[d][j].position));
                    const float same =
                        std::min(std::fabs(dot(pose[j].rotation, before[d][j].rotation)), 1.0f);
                    seen.turned = std::max(seen.turned, 2 * arccos(same));
                }
            before[d] = pose;
            const Vec2 at = on_ground(dog.position);
            const float far = length(at - on_ground(w.crowd.motion.position[dog.walker]));
            seen.farthest = std::max(seen.farthest, far), seen.nearest = std::min(seen.nearest, far);
            const DogShape& s = shape_of(dog.breed);
            for (const WalkerId id : w.crowd.slots.living)
                for (const float end : {1.0f, -1.0f}) {
                    const Vec2 part = at + heading_direction(dog.heading) * (end * s.half_long * dog.size);
                    const float apart = length(part - on_ground(w.crowd.motion.position[id.index]));
                    seen.inside = std::max(seen.inside, s.radius * dog.size + 0.15f - apart);
                }
            seen.walked += static_cast<double>(length(dog.velocity) * k_tick);
            seen.sniffs += dog.does == static_cast<uint32_t>(DogDoes::sniffs);
            seen.sits += dog.sits > 0.9f;
        }
    }
}

void tell(const char* where, const Seen& s) {
    std::printf(
        "%s: slides %.1f mm, sinks %.1f mm, floats %.1f mm; %.2f..%.2f m from owners, %.3f m inside; a bone "
        "%.3f m and %.2f rad in a tick; %.0f m in %u steps; sniffs %u, sits %u ticks\n",
        where, wide(1000 * s.slides), wide(1000 * s.sinks), wide(1000 * s.floats), wide(s.nearest),
        wide(s.farthest), wide(s.inside), wide(s.moved), wide(s.turned), s.walked, s.steps, s.sniffs, s.sits);
}

TEST(Dogs, StandOnTheirFeetAndKeepByTheirOwners) {
    struct {
        const char* name;
        Ground ground;
    } places[] = {{"square", square(24)}, {"street", street()}, {"steps", steps()}};
    for (auto& [name, ground] : places) {
        Seen seen;
        for (const uint64_t seed : {1u, 2u}) {
            auto world = with_dogs(ground, seed, 0.6f, 10);
            ASSERT_GE(world->alongside->dogs.size(), 2u);
            watch(*world, 900, seen);
        }
        tell(name, seen);
        EXPECT_LT(seen.slides, 0.010f) << name;
        EXPECT_LT(seen.sinks, 0.020f) << name;
        EXPECT_LT(seen.floats, 0.035f) << name;  // of one that its lead pulls round a post
        EXPECT_LT(seen.farthest, 2.3f) << name;
        EXPECT_GT(seen.nearest, 0.15f) << name;
        EXPECT_LT(seen.inside, 0.12f) << name;
        EXPECT_LT(seen.moved, 0.30f) << name;  // a shank that is lifted over a high step
        EXPECT_GT(seen.steps, 200u) << name;
        EXPECT_GT(seen.walked, 30) << name;
    }
}

TEST(Dogs, AreTheSameOnAnyNumberOfThreadsAndAfterTheyWereSaved) {
    auto one = with_dogs(square(24), 5, 0.5f, 12, 1), three = with_dogs(square(24), 5, 0.5f, 12, 3);
    for (int tick = 0; tick < 240; ++tick) step(*one), step(*three);
    EXPECT_EQ(hash_world(*one), hash_world(*three));
    std::vector<std::byte> bytes;
    save_state(*one, bytes);
    auto again = with_dogs(square(24), 5, 0.5f, 12, 2);
    const Result<void> loaded = load_state(*again, bytes);
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (int tick = 0; tick < 120; ++tick) step(*one), step(*again);
    EXPECT_EQ(hash_world(*one), hash_world(*again));
}

TEST(Dogs, TakeNoMemoryInATick) {
    auto world = with_dogs(square(24), 3, 0.5f, 12);
    for (int tick = 0; tick < 60; ++tick) step(*world);
    const size_t before = allocations();
    for (int tick = 0; tick < 300; ++tick) step(*world);
    EXPECT_EQ(allocations(), before);
}

TEST(AlongShares, NobodyHasWhereNoneIsAskedFor) {
    auto world = with_dogs(square(24), 3, 0, 12);
    EXPECT_EQ(world->alongside, nullptr);
}

TEST(AlongShares, WhoIsGoneTakesItAlong) {
    auto world = with_dogs(square(24), 3, 1, 8);
    const size_t dogs = world->alongside->dogs.size();
    ASSERT_GT(dogs, 0u);
    const uint32_t owner = world->alongside->dogs.front().walker;
    const WalkerId id{owner, world->crowd.slots.generation[owner]};
    EXPECT_EQ(told_along(*world, owner), "walks a dog");
    ASSERT_TRUE(remove_walker(*world, id));
    EXPECT_EQ(world->alongside->dogs.size(), dogs - 1);
    EXPECT_EQ(told_along(*world, owner), "");
    for (int tick = 0; tick < 30; ++tick) step(*world);
}

}  // namespace
}  // namespace flaneur
