// Back and forth in a run, as the window does it; without a window.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cstring>
#include <memory>
#include <string>

#include "tests/tools/loaded.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/time/time.h"

namespace flaneur {
namespace {

class Time : public testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();
        show.loaded = loaded_scene("corner", 40);
        v.is_loading = false;
        v.walkers = 40;
        begin_run(v.time, world());
        hashes.push_back(hash_world(world()));
        for (int i = 0; i < 400; ++i) {
            make_tick(show, v);
            hashes.push_back(hash_world(world()));
            if (world().tick % k_history_ticks == 0) settle(*v.time.history);  // so that none is left out
        }
    }
    void TearDown() override { ImGui::DestroyContext(); }
    World& world() { return *show.loaded.world; }
    // Pictures go by until it has come to where it goes.
    void arrive() {
        for (int pictures = 0; go_on(show, v, ++now); ++pictures) ASSERT_LT(pictures, 10'000);
    }
    void go(int64_t tick) {
        go_to(v, world(), tick);
        arrive();
    }
    void act(const char* name) {
        for (const Action& action : time_actions())
            if (std::string(action.name) == name) return action.act(show, v);
        FAIL() << name;
    }
    Show show;
    Viewer v;
    double now = 0;
    std::vector<uint64_t> hashes;  // by tick
};

TEST_F(Time, GoesToAnyTickAndTheWorldIsWhatItWas) {
    for (const int64_t tick : {399, 60, 61, 0, 1, 400, 180, 119, 300}) {
        go(tick);
        EXPECT_EQ(world().tick, tick);
        EXPECT_EQ(hash_world(world()), hashes[static_cast<size_t>(tick)]) << tick;
    }
    go(-50);
    EXPECT_EQ(world().tick, 0u) << "the start is the start";
    go(430);
    EXPECT_EQ(world().tick, 430u) << "and where it has not come to yet it goes";
    EXPECT_EQ(v.time.latest, 430u);
}

TEST_F(Time, ActionsAddUp) {
    act("A second back"), act("A second back"), act("One tick back");
    arrive();
    EXPECT_EQ(world().tick, 279u);
    EXPECT_TRUE(v.clock.is_paused);
    EXPECT_EQ(hash_world(world()), hashes[279]);
    act("Ten seconds back"), arrive();
    EXPECT_EQ(world().tick, 0u);
    act("As far as the run has come"), arrive();
    EXPECT_EQ(world().tick, 400u);
    act("To the start of the run"), arrive();
    EXPECT_EQ(world().tick, 0u);
}

TEST_F(Time, AHandOnTheTimelineSeesTheNearestAndThenTheVeryTick) {
    settle(*v.time.history);
    v.time.scrubbed_to = 150;
    EXPECT_TRUE(go_on(show, v, ++now));
    EXPECT_EQ(world().tick, 120u);
    v.time.scrubbed_to = 121;
    go_on(show, v, ++now);
    EXPECT_EQ(world().tick, 120u);
    v.time.scrubbed_to.reset();
    go(120);
    EXPECT_EQ(hash_world(world()), hashes[120]);
    // What was a tick before is known too, as pictures between two ticks want it.
    auto before = world().previous_poses;
    EXPECT_NE(std::memcmp(before.data(), world().poses.data(), before.size() * sizeof before[0]), 0);
}

TEST_F(Time, StopsWhereItHasCome) {
    go_to(v, world(), 1'000'000'000);
    go_on(show, v, ++now);
    ASSERT_TRUE(v.time.going);
    const auto progress = progress_of(v.time, world(), now + 1);
    ASSERT_TRUE(progress);
    EXPECT_TRUE(progress->is_long);
    EXPECT_TRUE(stop_going(v));
    EXPECT_FALSE(stop_going(v));
    EXPECT_TRUE(v.clock.is_paused);
    EXPECT_FALSE(go_on(show, v, ++now));
    EXPECT_GT(world().tick, 400u);
}

TEST_F(Time, Marks) {
    mark_moment(v, world());
    mark_moment(v, world());
    ASSERT_EQ(v.time.marks.size(), 1u) << "once";
    go(100);
    mark_moment(v, world());
    EXPECT_EQ(v.time.marks[0].tick, 100u) << "by time";
    EXPECT_EQ(v.time.marks[0].name, "Mark 2");
    act("To the next mark"), arrive();
    EXPECT_EQ(world().tick, 400u);
    act("To the mark before"), arrive();
    EXPECT_EQ(world().tick, 100u);
    act("To the mark before"), arrive();
    EXPECT_EQ(world().tick, 100u) << "there is none";
}

TEST_F(Time, TheNextEventIsGoneToAndFollowed) {
    v.time.watch.events = {{.tick = 90, .kind = EventKind::stuck, .walker = 7, .place = {}},
                           {.tick = 200, .kind = EventKind::arrival, .walker = 8, .place = {}},
                           {.tick = 300, .kind = EventKind::near_miss, .walker = 9, .place = {}}};
    go(10);
    v.time.wants = {false, true, true, true};
    act("To the next event, or on until there is one"), arrive();
    EXPECT_EQ(world().tick, 200u);
    EXPECT_EQ(v.selected, 8u);
    EXPECT_EQ(v.choice.kind, CameraChoice::Kind::follow);
    EXPECT_EQ(v.choice.walker, 8u);
    EXPECT_TRUE(v.clock.is_paused);
    EXPECT_EQ(hash_world(world()), hashes[200]);
    v.time.wants[0] = true;
    act("To the event before"), arrive();
    EXPECT_EQ(world().tick, 90u);
    // None is known after the last: on until there is one.
    v.time.watch.events.resize(1);
    world().crowd.journeys[5].stuck = 2;
    v.time.wants = {true, false, false, false};
    go(350);
    v.time.watch.events.push_back({.tick = 401, .kind = EventKind::stuck, .walker = 5, .place = {}});
    act("To the next event, or on until there is one"), arrive();
    EXPECT_EQ(world().tick, 401u);
    EXPECT_EQ(v.selected, 5u);
}

TEST_F(Time, WhatIsChangedByHandIsGoneBackTo) {
    v.time.watch.events = {{.tick = 90, .kind = EventKind::stuck, .walker = 7, .place = {}},
                           {.tick = 300, .kind = EventKind::near_miss, .walker = 9, .place = {}}};
    go(200);
    ASSERT_TRUE(remove_walker(world(), walkers(world())[3]));
    changed_by_hand(v.time, world());
    EXPECT_EQ(v.time.latest, 200u);
    EXPECT_EQ(v.time.changes, std::vector<uint32_t>{200});
    changed_by_hand(v.time, world());
    EXPECT_EQ(v.time.changes.size(), 1u) << "a hand on a slider makes one change";
    EXPECT_EQ(v.time.watch.events.size(), 1u) << "what was to come";
    const uint64_t at_200 = hash_world(world());
    for (int i = 0; i < 100; ++i) make_tick(show, v);
    const uint64_t at_300 = hash_world(world());
    EXPECT_NE(at_300, hashes[300]);
    go(150);
    EXPECT_EQ(hash_world(world()), hashes[150]) << "before the change it is as it was";
    go(300);
    EXPECT_EQ(hash_world(world()), at_300);
    go(200);
    EXPECT_EQ(hash_world(world()), at_200);
    go(150);
    while (world().tick < 300) make_tick(show, v);
    EXPECT_EQ(hash_world(world()), at_300) << "and as time goes by it is changed again";
    go(200);

    // On other ground nothing of before can be had.
    world().ground = std::make_shared<const Ground>(*world().ground);
    changed_by_hand(v.time, world());
    EXPECT_EQ(kept_ticks(*v.time.history), std::vector<uint32_t>{200});
    go(0);
    EXPECT_EQ(world().tick, 200u);

    // Nor while somebody is led by hand.
    v.time.is_led = true;
    for (int i = 0; i < 70; ++i) make_tick(show, v);
    EXPECT_TRUE(kept_ticks(*v.time.history).empty());
    go(100);
    EXPECT_EQ(world().tick, 270u);
    v.time.is_led = false;
    for (int i = 0; i < 10; ++i) make_tick(show, v);
    go(0);
    EXPECT_EQ(world().tick, 271u);
}

TEST_F(Time, OtherPeopleBeginARunOfTheirOwn) {
    mark_moment(v, world());
    restart(show, v, 77);
    ASSERT_TRUE(v.time.anew);
    v.time.anew->ready.wait();
    take_people_anew(show, v);
    EXPECT_FALSE(v.time.anew);
    EXPECT_EQ(world().seed, 77u);
    EXPECT_EQ(world().tick, 0u);
    EXPECT_EQ(world().crowd.count, 40u);
    EXPECT_EQ(v.time.run, 1u);
    EXPECT_TRUE(v.time.marks.empty());
    EXPECT_EQ(kept_ticks(*v.time.history), std::vector<uint32_t>{0});
    EXPECT_NE(hash_world(world()), hashes[0]);
    for (int i = 0; i < 70; ++i) make_tick(show, v);
    restart(show, v, 1);
    v.time.anew->ready.wait();
    take_people_anew(show, v);
    EXPECT_EQ(hash_world(world()), hashes[0]) << "the first run again";
    restart(show, v, 2);
    EXPECT_TRUE(stop_going(v));
    v.time.anew->ready.wait();
    take_people_anew(show, v);
    EXPECT_FALSE(v.time.anew);
}

TEST_F(Time, AnotherRunBesideGoesAlong) {
    auto wait = [&] {
        ASSERT_TRUE(v.time.anew);
        v.time.anew->ready.wait();
        take_people_anew(show, v);
        ASSERT_TRUE(v.time.beside);
    };
    auto keep_up = [&] {
        for (int pictures = 0; pictures < 1000 && v.time.beside->world->tick != world().tick; ++pictures)
            keep_up_beside(show, v);
        EXPECT_EQ(v.time.beside->world->tick, world().tick);
    };
    set_beside(show, v, {2, 50});
    wait(), keep_up();
    EXPECT_EQ(v.time.beside->world->seed, 2u);
    EXPECT_EQ(v.time.beside->world->crowd.count, 50u);
    EXPECT_EQ(world().tick, 400u) << "this run is left alone";
    EXPECT_EQ(hash_world(world()), hashes[400]);
    const uint64_t at_400 = hash_world(*v.time.beside->world);
    go(130), keep_up();
    go(400), keep_up();
    EXPECT_EQ(hash_world(*v.time.beside->world), at_400);
    EXPECT_EQ(size_of_one(v, {802, 600}).width, 400);

    // The same seed is the same run, and this moment stands still.
    set_beside(show, v, {1, 40});
    wait(), keep_up();
    EXPECT_EQ(hash_world(*v.time.beside->world), hashes[400]);
    go(250);
    set_beside_this_moment(show, v);
    go(300);
    wait();
    for (int pictures = 0; pictures < 100; ++pictures) keep_up_beside(show, v);
    EXPECT_EQ(v.time.beside->world->tick, 250u);
    EXPECT_EQ(hash_world(*v.time.beside->world), hashes[250]);
    v.time.beside.reset();
    EXPECT_EQ(size_of_one(v, {802, 600}).width, 802);
}

TEST_F(Time, LinesAndZonesCountInTheRunBesideToo) {
    // Before whoever is the fastest.
    const CrowdMotion& motion = world().crowd.motion;
    uint32_t who = 0;
    for (const WalkerId id : world().crowd.slots.living)
        if (length(motion.velocity[id.index]) > length(motion.velocity[who])) who = id.index;
    const Vec3 at = motion.position[who];
    const Vec2 ahead = normalize_or(motion.velocity[who], {1, 0});
    const Vec2 middle = on_ground(at) + ahead * 1.5f, aside = Vec2{-ahead.z, ahead.x} * 30;
    MeasurePlan plan;
    plan.lines.push_back({"L1", middle - aside, middle + aside});
    plan.zones.push_back(
        {"Z1", {{at.x - 9, at.z - 9}, {at.x + 9, at.z - 9}, {at.x + 9, at.z + 9}, {at.x - 9, at.z + 9}}});
    Counts& here = v.measure.counts;
    set_plan(here, plan, world().tick);
    count_people(here, world());
    auto put = [&](std::optional<uint32_t> moment) {
        set_beside(show, v, {1, 40, moment});
        v.time.anew->ready.wait();
        take_people_anew(show, v);
    };
    auto keep_up = [&] {
        for (int pictures = 0; pictures < 1000 && v.time.beside->world->tick != world().tick; ++pictures)
            keep_up_beside(show, v);
    };
    put({}), keep_up();
    // The same run: what is counted from here on is the same.
    begin_anew(v.time.beside->counts, world().tick);
    for (int i = 0; i < 300; ++i) make_tick(show, v);
    keep_up();
    const Counts& there = v.time.beside->counts;
    ASSERT_EQ(there.lines.size(), 1u);
    const Flow left = flow_of(here.lines[0], 700, 1e9), right = flow_of(there.lines[0], there.shown, 1e9);
    EXPECT_GT(left.left + left.right, 0u);
    EXPECT_EQ(left.left, right.left);
    EXPECT_EQ(left.right, right.right);
    EXPECT_EQ(zone_now(here.zones[0], here).people, zone_now(there.zones[0], there).people);
    // What has been looked at again is not counted again.
    go(500), keep_up(), go(700), keep_up();
    const Flow again = flow_of(there.lines[0], there.shown, 1e9);
    EXPECT_EQ(again.left + again.right, right.left + right.right);
    plan.lines.push_back({"L2", {at.x, at.z - 30}, {at.x, at.z + 30}});
    set_plan(here, plan, world().tick);
    keep_up_beside(show, v);
    EXPECT_EQ(plan_of(there), plan) << "drawn meanwhile";
    // A moment that is kept has what was counted until then.
    put(world().tick);
    keep_up_beside(show, v);
    const Flow kept = flow_of(v.time.beside->counts.lines[0], v.time.beside->counts.shown, 1e9);
    EXPECT_EQ(kept.left + kept.right, left.left + left.right);
}

TEST_F(Time, FiguresOfACrowd) {
    Crowd& crowd = world().crowd;
    for (uint32_t i = 0; i < crowd.count; ++i) {
        crowd.motion.position[i] = {10.0f * static_cast<float>(i), 0, 1};
        crowd.motion.velocity[i] = i < 10 ? Vec2{0, 1.5f} : Vec2{};
    }
    crowd.motion.position[4].x = crowd.motion.position[5].x = 0;
    const CrowdFigures figures = figures_of(world());
    EXPECT_EQ(figures.people, 40u);
    EXPECT_EQ(figures.walking, 10u);
    EXPECT_FLOAT_EQ(figures.speed, 1.5f);
    EXPECT_FLOAT_EQ(figures.density, 3.0f / 9);
}

TEST(RunTime, IsWritten) {
    EXPECT_EQ(run_time(0), "0:00.0");
    EXPECT_EQ(run_time(59), "0:00.9");
    EXPECT_EQ(run_time(60 * 65 + 30), "1:05.5");
    EXPECT_EQ(run_time(60 * 3600 + 60 * 62), "1:01:02.0");
}

}  // namespace
}  // namespace flaneur
