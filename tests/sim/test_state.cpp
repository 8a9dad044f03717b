// A world's state as bytes: taken back to it, the world goes on as it did.
#include <gtest/gtest.h>

#include <cstring>

#include "sim/base/rng.h"
#include "sim/sim.h"
#include "sim/state.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

Kind with(Vec3 cane, Vec3 pram) {
    Kind kind{standard_body(1.7f)};
    kind.body.cane = cane;
    kind.body.pram = pram;
    return kind;
}

// People, canes and prams among them, on a street with a plaza's worth of room.
std::unique_ptr<World> made(int threads, uint64_t seed = 1, uint32_t walkers = 60,
                            Ground ground = square(60)) {
    WorldOptions options;
    options.walkers = walkers;
    options.capacity = 150;
    options.threads = threads;
    options.seed = seed;
    options.kinds = {Kind{standard_body(1.75f)}, with(standard_cane(1.7f), {}),
                     with({}, standard_pram(standard_body(1.7f)))};
    index_ground(ground);
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

// Some come and some go, by the tick alone.
void come_and_go(World& w) {
    auto number = [&](uint32_t i) { return random_unit({7, w.tick, 0, Purpose::spawn}, i); };
    if (w.tick % 3 == 0 && walkers(w).size() < w.crowd.capacity) (void)add_walker(w, {.wanders = true});
    if (w.tick % 4 == 0 && walkers(w).size() > 30) {
        const auto all = walkers(w);
        remove_walker(w, all[static_cast<size_t>(number(1) * static_cast<float>(all.size()))]);
    }
}

void run(World& w, uint32_t ticks, bool with_comers) {
    for (uint32_t i = 0; i < ticks; ++i) {
        if (with_comers) come_and_go(w);
        step(w);
    }
}

template <class Blocks>
bool are_same(const Blocks& a, const Blocks& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

TEST(State, TakenBackTheWorldGoesOnAsItDid) {
    for (const int threads : {1, 4})
        for (const bool with_comers : {false, true}) {
            auto w = made(threads);
            run(*w, 200, with_comers);
            std::vector<std::byte> bytes;
            save_state(*w, bytes);
            const uint64_t then = hash_world(*w);
            run(*w, 150, with_comers);
            const uint64_t end = hash_world(*w);
            const auto poses = w->previous_poses;
            const auto trails = w->previous_trails;
            run(*w, 300, with_comers);
            Result<void> loaded = load_state(*w, bytes);
            ASSERT_TRUE(loaded) << loaded.error().message;
            EXPECT_EQ(w->tick, 200u);
            EXPECT_EQ(hash_world(*w), then) << threads << " threads, comers " << with_comers;
            run(*w, 150, with_comers);
            EXPECT_EQ(hash_world(*w), end) << threads << " threads, comers " << with_comers;
            EXPECT_TRUE(are_same(w->previous_poses, poses));
            EXPECT_TRUE(are_same(w->previous_trails, trails));
        }
}

TEST(State, KnowsWhoIsDriven) {
    auto w = made(1);
    drive(w->crowd, 3);
    w->crowd.driven.wish = {1, 0};
    run(*w, 30, false);
    std::vector<std::byte> bytes;
    save_state(*w, bytes);
    const uint64_t then = hash_world(*w);
    run(*w, 60, false);
    const uint64_t end = hash_world(*w);
    let_go(w->crowd);
    drive(w->crowd, 5);
    ASSERT_TRUE(load_state(*w, bytes));
    EXPECT_EQ(hash_world(*w), then);
    EXPECT_EQ(w->crowd.driven.walker, 3u);
    run(*w, 60, false);
    EXPECT_EQ(hash_world(*w), end);
}

TEST(State, OnSteps) {
    auto w = made(2, 1, 50, steps());
    run(*w, 300, true);
    std::vector<std::byte> bytes;
    save_state(*w, bytes);
    run(*w, 200, true);
    const uint64_t end = hash_world(*w);
    run(*w, 200, true);
    ASSERT_TRUE(load_state(*w, bytes));
    run(*w, 200, true);
    EXPECT_EQ(hash_world(*w), end);
}

TEST(State, AnotherWorldOfTheSameMakeTakesIt) {
    auto one = made(1), four = made(4);
    run(*one, 120, true);
    std::vector<std::byte> bytes;
    save_state(*one, bytes);
    ASSERT_TRUE(load_state(*four, bytes));
    run(*one, 90, true), run(*four, 90, true);
    EXPECT_EQ(hash_world(*one), hash_world(*four));
}

TEST(State, RoamersToo) {
    WorldOptions options;
    options.walkers = 40;
    Ground stage = square(40);
    index_ground(stage);
    auto made = make_world(std::make_shared<const Ground>(std::move(stage)), options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    Compound ball;
    ball.spheres.push_back({{0, 0, 0}, 9});
    ASSERT_TRUE(set_down(w, ball));
    run(w, 100, false);
    std::vector<std::byte> bytes;
    save_state(w, bytes);
    run(w, 100, false);
    const uint64_t end = hash_world(w);
    ASSERT_TRUE(load_state(w, bytes));
    run(w, 100, false);
    EXPECT_EQ(hash_world(w), end);
}

TEST(State, OfAnotherWorldOrCutShortIsRefused) {
    auto w = made(1), other = made(1, 2), fewer = made(1, 1, 59);
    run(*w, 50, true);
    std::vector<std::byte> bytes;
    save_state(*w, bytes);
    EXPECT_EQ(tick_of_state(bytes), 50u);
    EXPECT_FALSE(load_state(*other, bytes)) << "another seed";
    const uint64_t before = hash_world(*w);
    for (size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 997) {
        Result<void> loaded = load_state(*w, std::span(bytes).first(size));
        ASSERT_FALSE(loaded) << size;
        EXPECT_FALSE(loaded.error().message.empty());
    }
    auto longer = bytes;
    longer.push_back({});
    EXPECT_FALSE(load_state(*w, longer)) << "too long";
    for (size_t i = 0; i < 56; ++i) {  // the head, harmed
        auto harmed = bytes;
        harmed[i] ^= std::byte{0x80};
        if (!load_state(*w, harmed)) {
            EXPECT_EQ(hash_world(*w), before) << i;
        } else {  // a tick, say, may be any
            ASSERT_TRUE(load_state(*w, bytes));
        }
    }
    EXPECT_FALSE(tick_of_state({}));
}

}  // namespace
}  // namespace flaneur
