#include <gtest/gtest.h>

#include "tests/tools/loaded.h"
#include "tools/flaneur/history/events.h"

namespace flaneur {
namespace {

// People who are set down by hand: nothing steps but the tick.
class Events : public testing::Test {
  protected:
    void SetUp() override {
        loaded = loaded_scene("corner", 30);
        // Far apart, and at rest.
        for (uint32_t i = 0; i < world().crowd.count; ++i) {
            world().crowd.motion.position[i] = {static_cast<float>(i) * 20, 0, 0};
            world().crowd.motion.velocity[i] = {};
        }
        watch(w, world());
    }
    World& world() { return *loaded.world; }
    // So many ticks, each looked at.
    void pass(uint32_t ticks) {
        for (uint32_t i = 0; i < ticks; ++i) ++world().tick, watch(w, world());
    }
    size_t count(EventKind kind) const {
        size_t n = 0;
        for (const Event& event : w.events) n += event.kind == kind;
        return n;
    }
    Loaded loaded;
    Watch w;
};

TEST_F(Events, WhoDoesNotGetOnIsStuckOnce) {
    pass(10);
    EXPECT_TRUE(w.events.empty());
    Journey& j = world().crowd.journeys[3];
    j.stuck = 1;
    pass(5);
    EXPECT_EQ(count(EventKind::stuck), 0u) << "3 s are no event yet";
    j.stuck = 2;
    pass(5);
    ASSERT_EQ(count(EventKind::stuck), 1u);
    EXPECT_EQ(w.events[0].walker, 3u);
    EXPECT_EQ(w.events[0].tick, 16u);
    EXPECT_EQ(w.events[0].value, 6);
    j.stuck = 3;
    pass(5);
    EXPECT_EQ(count(EventKind::stuck), 1u);
    j.stuck = 0;
    pass(5);
    j.stuck = 2;
    pass(1);
    EXPECT_EQ(count(EventKind::stuck), 2u) << "again";
}

TEST_F(Events, NearMissesAreOfThoseWhoCloseIn) {
    CrowdMotion& m = world().crowd.motion;
    const float apart = world().crowd.identity.radius[4] + world().crowd.identity.radius[5] + 0.04f;
    m.position[5] = m.position[4] + Vec3{apart, 0, 0};
    pass(8);
    EXPECT_TRUE(w.events.empty()) << "they stand";
    m.velocity[4] = {0, 1.4f}, m.velocity[5] = {0, -1.4f};
    pass(8);
    EXPECT_TRUE(w.events.empty()) << "they pass by";
    m.velocity[4] = {1, 0};
    pass(40);
    ASSERT_EQ(count(EventKind::near_miss), 1u);
    EXPECT_EQ(w.events[0].walker, 4u);
    EXPECT_EQ(w.events[0].other, 5u);
    EXPECT_NEAR(w.events[0].value, 0.04f, 1e-3f);
    m.position[5].y = 3;
    m.velocity[5] = {-2, 0};
    pass(400);
    EXPECT_EQ(count(EventKind::near_miss), 1u) << "on a bridge";
}

TEST_F(Events, CrowdsAreTold) {
    CrowdMotion& m = world().crowd.motion;
    for (uint32_t i = 0; i < 9; ++i) m.position[i] = {0.2f + 0.3f * static_cast<float>(i), 0, 1.5f};
    m.position[0].x = -0.2f;
    pass(20);
    EXPECT_EQ(count(EventKind::crowding), 0u) << "8 on 9 m2";
    m.position[0].x = 0.2f;
    pass(40);
    ASSERT_EQ(count(EventKind::crowding), 1u);
    EXPECT_EQ(w.events[0].value, 1);
    m.position[0].x = -0.2f, pass(20), m.position[0].x = 0.2f, pass(20);
    EXPECT_EQ(count(EventKind::crowding), 1u) << "the same crowd";
    for (uint32_t i = 0; i < 9; ++i) m.position[i].x = -100.0f - 20 * static_cast<float>(i);
    pass(20);
    for (uint32_t i = 0; i < 9; ++i) m.position[i].x = 0.2f + 0.3f * static_cast<float>(i);
    pass(20);
    EXPECT_EQ(count(EventKind::crowding), 2u);
}

TEST_F(Events, TheFirstToArriveAndFasterOnes) {
    auto arrive = [&](uint32_t walker, float metres, uint32_t ticks) {
        ++world().crowd.journeys[walker].trip;
        world().crowd.journeys[walker].arrived = false;
        pass(1);
        world().crowd.motion.position[walker].z += metres;
        pass(ticks - 1);
        world().crowd.journeys[walker].arrived = true;
        pass(1);
    };
    arrive(1, 5, 300);
    EXPECT_EQ(count(EventKind::arrival), 1u) << "the first";
    arrive(2, 30, 1800);
    ASSERT_EQ(count(EventKind::arrival), 2u) << "the first whose way is long enough to count";
    EXPECT_NEAR(w.events[1].value, 1, 1e-3f);
    arrive(3, 30, 2000);
    EXPECT_EQ(count(EventKind::arrival), 2u) << "slower";
    arrive(4, 30, 1200);
    EXPECT_EQ(count(EventKind::arrival), 3u);
}

TEST_F(Events, AreToldOnceAndFoundByTime) {
    for (const uint32_t walker : {2u, 7u, 9u}) {
        world().crowd.journeys[walker].stuck = 2;
        pass(10);
    }
    const size_t known = w.events.size();
    ASSERT_EQ(known, 3u);
    world().tick = 5;
    for (uint32_t walker : {2u, 7u, 9u}) world().crowd.journeys[walker].stuck = 0;
    pass(10);
    world().crowd.journeys[1].stuck = 2;
    pass(10);
    EXPECT_EQ(w.events.size(), known) << "what is done again is not told again";

    const EventFilter all{true, true, true, true}, none{}, arrivals{false, false, false, true};
    EXPECT_EQ(event_after(w.events, 0, all)->tick, 1u);
    EXPECT_EQ(event_after(w.events, 1, all)->tick, 11u);
    EXPECT_EQ(event_after(w.events, 21, all), nullptr);
    EXPECT_EQ(event_before(w.events, 21, all)->tick, 11u);
    EXPECT_EQ(event_before(w.events, 1, all), nullptr);
    EXPECT_EQ(event_after(w.events, 0, none), nullptr);
    EXPECT_EQ(event_after(w.events, 0, arrivals), nullptr);
    for (const Event& event : w.events) EXPECT_FALSE(event_text(event).empty());
}

TEST_F(Events, TheListIsBounded) {
    for (uint32_t i = 0; i < 3 * k_most_events; ++i) {
        world().crowd.journeys[3].stuck = i % 2 ? 0 : 2;
        pass(1);
    }
    EXPECT_LE(w.events.size(), k_most_events);
    EXPECT_GT(w.events.size(), k_most_events / 2);
    EXPECT_GT(w.events.front().tick, 1u) << "the oldest go";
}

}  // namespace
}  // namespace flaneur
