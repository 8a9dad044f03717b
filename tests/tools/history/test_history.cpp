#include <gtest/gtest.h>

#include "tests/tools/loaded.h"
#include "tools/flaneur/history/history.h"

namespace flaneur {
namespace {

void run_to(World& world, History& history, uint32_t tick) {
    while (world.tick < tick) {
        step(world);
        follow(history, world);
        if (world.tick % k_history_ticks == 0) settle(history);  // so that none is left out
    }
}

void go_back_to(World& world, const History& history, uint32_t tick) {
    const auto from = kept_before(history, tick);
    ASSERT_TRUE(from);
    Result<void> done = restore(history, *from, world);
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_EQ(world.tick, *from);
    while (world.tick < tick) step(world);
}

TEST(History, BackAndForthIsTheSameWorld) {
    for (const char* scene : {"corner", "asteroid"})
        for (const int threads : {1, 4}) {
            Loaded l = loaded_scene(scene, 60, threads);
            World& world = *l.world;
            HistoryPtr history = make_history();
            follow(*history, world);
            uint64_t at_0 = hash_world(world), at_137 = 0, at_300 = 0;
            run_to(world, *history, 137);
            at_137 = hash_world(world);
            run_to(world, *history, 300);
            at_300 = hash_world(world);
            keep_now(*history, world);
            go_back_to(world, *history, 300);  // not packed yet, maybe
            EXPECT_EQ(hash_world(world), at_300) << scene << threads;
            go_back_to(world, *history, 137);
            EXPECT_EQ(hash_world(world), at_137) << scene << threads;
            settle(*history);
            go_back_to(world, *history, 0);
            EXPECT_EQ(hash_world(world), at_0) << scene << threads;
            go_back_to(world, *history, 300);
            EXPECT_EQ(hash_world(world), at_300) << scene << threads;
            go_back_to(world, *history, 137);
            EXPECT_EQ(hash_world(world), at_137) << scene << threads;
        }
}

TEST(History, ThinsOutWithinItsMemoryAndKeepsTheFirst) {
    Loaded l = loaded_scene("corner", 100, 2);
    World& world = *l.world;
    HistoryPtr history = make_history();
    follow(*history, world);
    settle(*history);
    run_to(world, *history, 60);
    settle(*history);
    const size_t state = history_use(*history).state_bytes, most = 12 * state;
    set_most_bytes(*history, most);
    for (uint32_t tick = 120; tick <= 2400; tick += 60) {
        run_to(world, *history, tick);
        settle(*history);
        EXPECT_LE(history_use(*history).bytes, most) << tick;
        const std::vector<uint32_t> kept = kept_ticks(*history);
        EXPECT_EQ(kept.front(), 0u);
        EXPECT_EQ(kept.back(), tick);
    }
    const std::vector<uint32_t> kept = kept_ticks(*history);
    EXPECT_GT(kept.size(), 5u);
    EXPECT_LT(kept.size(), 41u) << "some had to go";
    EXPECT_EQ(kept[kept.size() - 1] - kept[kept.size() - 2], 60u) << "near now nothing is thinned out";
    EXPECT_GT(kept[1] - kept[0], 60u);
    go_back_to(world, *history, 700);
    EXPECT_EQ(world.tick, 700u);
}

TEST(History, WhatIsChangedByHandBeginsAnewFromThere) {
    Loaded l = loaded_scene("corner", 40, 2);
    World& world = *l.world;
    HistoryPtr history = make_history();
    follow(*history, world);
    run_to(world, *history, 300);
    settle(*history);
    go_back_to(world, *history, 150);
    ASSERT_FALSE(walkers(world).empty());
    ASSERT_TRUE(remove_walker(world, walkers(world).front()));
    keep_for_good(*history, world);
    EXPECT_EQ(kept_ticks(*history).back(), 150u) << "what was to come is not any more";
    const uint64_t at_150 = hash_world(world);
    run_to(world, *history, 260);
    const uint64_t at_260 = hash_world(world);
    settle(*history);
    set_most_bytes(*history, 0);
    EXPECT_EQ(kept_ticks(*history), (std::vector<uint32_t>{0, 150, 210})) << "whatever the memory";
    go_back_to(world, *history, 150);
    EXPECT_EQ(hash_world(world), at_150);
    go_back_to(world, *history, 260);
    EXPECT_EQ(hash_world(world), at_260);
    forget(*history);
    EXPECT_TRUE(kept_ticks(*history).empty());
    EXPECT_FALSE(kept_before(*history, 1000));
    EXPECT_FALSE(restore(*history, 0, world));
}

TEST(History, CloseTogetherOnlyNearNow) {
    Loaded l = loaded_scene("corner", 20, 1);
    World& world = *l.world;
    HistoryPtr history = make_history();
    follow(*history, world);
    run_to(world, *history, 240);
    settle(*history);
    go_back_to(world, *history, 100);
    keep_now(*history, world), settle(*history);
    step(world), step(world);
    keep_now(*history, world), settle(*history);
    EXPECT_EQ(kept_ticks(*history), (std::vector<uint32_t>{0, 60, 100, 102, 120, 180, 240}));
    go_back_to(world, *history, 240);
    run_to(world, *history, 301);
    settle(*history);
    EXPECT_EQ(kept_ticks(*history), (std::vector<uint32_t>{0, 60, 120, 180, 240, 300}));
}

TEST(History, AnotherRunIsTheOneThatAProgramBeginsWithThatSeed) {
    Loaded l = loaded_scene("corner", 50, 2);
    for (int i = 0; i < 100; ++i) step(*l.world);
    Result<std::unique_ptr<World>> again = make_people(order_people(l, l.world->seed, 50)),
                                   other = make_people(order_people(l, 99, 50));
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_TRUE(other) << other.error().message;
    const Loaded fresh = loaded_scene("corner", 50, 1);
    EXPECT_EQ(hash_world(**again), hash_world(*fresh.world));
    EXPECT_NE(hash_world(**other), hash_world(*fresh.world));
    for (int i = 0; i < 60; ++i) step(**again), step(*fresh.world);
    EXPECT_EQ(hash_world(**again), hash_world(*fresh.world));
    EXPECT_FALSE(make_people(order_people(l, 1, 50), [](std::string_view, float) { return false; }));

    // Nor does a state of one load into the other.
    HistoryPtr history = make_history();
    follow(*history, **again);
    EXPECT_FALSE(restore(*history, 60, **other));
    EXPECT_EQ((*other)->tick, 0u);
}

}  // namespace
}  // namespace flaneur
