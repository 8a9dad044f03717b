// What the card tells of walkers, and how their gait is watched.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/loaded.h"
#include "tools/flaneur/window/ask/facts.h"
#include "tools/flaneur/window/ask/gait.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

class AskingTest : public testing::Test {
  protected:
    void SetUp() override { show.loaded = loaded_scene("corner", 60); }
    World& world() { return *show.loaded.world; }
    Show show;
};

TEST_F(AskingTest, TellsWhatTheSimulationKnows) {
    int to = 0, stays = 0, asked = 0;
    for (int tick = 0; tick < 40 * 60; ++tick) {
        step(world());
        if (tick % 300 != 0) continue;
        for (uint32_t i = 0; i < world().crowd.count; ++i) {
            const WalkerFacts f = facts_of(show, i);
            const Journey& journey = world().crowd.journeys[i];
            ++asked;
            to += f.to.has_value();
            stays += f.doing == Doing::stays;
            EXPECT_EQ(f.doing == Doing::stays, journey.arrived && world().tick < journey.pause_until) << i;
            if (f.doing == Doing::stays) {
                EXPECT_NEAR(f.seconds, (journey.pause_until - world().tick) / 60.0, 1e-3);
            }
            if (f.doing == Doing::gives_way) {
                EXPECT_NE(f.whom, i);
            }
            if (f.to) {
                float nearest = 1e9f;
                for (const Attraction& a : world().crowd.demand.attractions[static_cast<int>(*f.to)])
                    nearest = std::min(nearest, length(a.place.position - journey.goal.position));
                EXPECT_LT(nearest, 2.1f) << i;
            }
            EXPECT_FALSE(told_doing(f).empty());
        }
    }
    EXPECT_GT(to, asked * 8 / 10) << "most go somewhere";
    EXPECT_GT(stays, 0);
}

TEST_F(AskingTest, WatchesTheStridesOfOne) {
    GaitWatch watch;
    watch.shows_steps = true;
    uint32_t walker = 0;
    // One who goes on, once they are under way.
    for (int tick = 0; tick < 120; ++tick) step(world());
    for (uint32_t i = 0; i < world().crowd.count; ++i)
        if (length(world().crowd.motion.velocity[i]) > 1.1f && facts_of(show, i).to_go > 25) walker = i;
    for (int tick = 0; tick < 480; ++tick) step(world()), watch_gait(world(), walker, watch);
    measure_legs(watch);
    ASSERT_TRUE(watch.legs[k_left] && watch.legs[k_right]);
    EXPECT_GT(watch.seconds, 0.7);
    EXPECT_LT(watch.seconds, 1.6);
    EXPECT_NEAR(watch.metres / watch.seconds,
                static_cast<double>(length(world().crowd.motion.velocity[walker])), 0.4);
    EXPECT_GE(watch.prints.size(), 10u);
    for (const auto& leg : watch.legs) {
        EXPECT_GT(leg->stance, 0.5);
        EXPECT_LT(leg->stance, 0.75);
        double most = 0;
        for (const double knee : leg->curves.knee) {
            ASSERT_TRUE(std::isfinite(knee));
            most = std::max(most, knee);
        }
        EXPECT_GT(most, 40) << "knees bend";
        EXPECT_LT(most, 95);
    }
    EXPECT_EQ(watch.walk.ticks.size(), 480u);
    // Nobody, another one, or a gap in time begins anew.
    step(world()), step(world()), watch_gait(world(), walker, watch);
    EXPECT_EQ(watch.walk.ticks.size(), 1u);
    step(world()), watch_gait(world(), (walker + 1) % world().crowd.count, watch);
    EXPECT_EQ(watch.walk.ticks.size(), 1u);
    watch_gait(world(), {}, watch);
    EXPECT_TRUE(watch.walk.ticks.empty() && watch.prints.empty());
    EXPECT_TRUE(watch.shows_steps);
}

TEST_F(AskingTest, KeepsTheLastTicksAlone) {
    GaitWatch watch;
    for (size_t tick = 0; tick < 2 * k_watched_ticks + 50; ++tick) {
        step(world()), watch_gait(world(), 0, watch);
        EXPECT_LE(watch.walk.ticks.size(), 2 * k_watched_ticks);
    }
    EXPECT_GT(watch.walk.ticks.size(), k_watched_ticks);
}

TEST(Gait, IsThatOfWhoIsFollowedWhereNobodyIsSelected) {
    Viewer v;
    v.choice.walker = 7;
    EXPECT_FALSE(watched(v)) << "the eye flies";
    for (const auto kind : {CameraChoice::Kind::follow, CameraChoice::Kind::eyes}) {
        v.choice.kind = kind;
        EXPECT_EQ(watched(v), 7u);
    }
    v.selected = 3;
    EXPECT_EQ(watched(v), 3u);
}

}  // namespace
}  // namespace flaneur
