#include <gtest/gtest.h>

#include <cmath>

#include "tools/flaneur/measure/count.h"

namespace flaneur {
namespace {

constexpr float k_dt = 1.0f / 60;

// Tells one walker's places, tick after tick from 0 on.
struct Track {
    Counts counts;
    uint32_t tick = 0;

    explicit Track(CountLine line = {"L1", {0, 0}, {0, 4}}) {
        MeasurePlan plan;
        plan.lines.push_back(line);
        set_plan(counts, plan, 0);
    }
    void at(Vec2 place, uint32_t walker = 3, uint32_t generation = 0) {
        const Present one{{walker, generation}, place, 1.5f, walker + 100 * generation};
        count_people(counts, tick++, std::span(&one, 1));
    }
    // Straight from one place to another, not along with what was before.
    void go(Vec2 from, Vec2 to, int ticks) {
        ++tick;
        go_on(from, to, ticks);
    }
    void go_on(Vec2 from, Vec2 to, int ticks) {
        for (int i = 0; i <= ticks; ++i)
            at(lerp(from, to, static_cast<float>(i) / static_cast<float>(ticks)));
    }
    const std::vector<LineCrossing>& crossings() const { return counts.lines[0].crossings; }
};

// The line goes south: its right is the west, where x is below 0.
TEST(Count, CrossingsEachWay) {
    Track track;
    track.go({1, 2}, {-1, 2}, 60);
    ASSERT_EQ(track.crossings().size(), 1u);
    const LineCrossing& right = track.crossings()[0];
    EXPECT_TRUE(right.to_right);
    EXPECT_NEAR(right.seconds, 0.5 + 1.0 / 60, 1e-6);
    EXPECT_EQ(right.person, 3u);
    EXPECT_NEAR(right.at.x, 0, 1e-5f);
    EXPECT_NEAR(right.at.z, 2, 1e-5f);
    track.go({-1, 3}, {1, 3}, 60);
    ASSERT_EQ(track.crossings().size(), 2u);
    EXPECT_FALSE(track.crossings()[1].to_right);
    const Flow flow = flow_of(track.counts.lines[0], track.counts.tick, 1e9);
    EXPECT_EQ(flow.left, 1u);
    EXPECT_EQ(flow.right, 1u);
}

TEST(Count, TimesAreTakenBetweenTicks) {
    Track track;
    track.at({0.75f, 1}), track.at({-0.25f, 1}), track.at({-1, 1});
    ASSERT_EQ(track.crossings().size(), 1u);
    EXPECT_NEAR(track.crossings()[0].seconds, 0.75 / 60, 1e-9);
}

TEST(Count, NobodyCrossesAlongTheLineOrBesideIt) {
    Track track;
    track.go({0, -1}, {0, 5}, 200);          // on the line itself
    track.go({0.05f, -1}, {0.05f, 5}, 200);  // just beside it
    track.go({1, 4.3f}, {-1, 4.3f}, 30);     // past its last end
    track.go({1, -0.3f}, {-1, -0.3f}, 30);   // past its first
    EXPECT_TRUE(track.crossings().empty());
}

// Of two lines that share an end, one has it.
TEST(Count, AnEndBelongsToOneLineOfAChain) {
    for (const float z : {3.999f, 4.0f, 4.001f}) {
        Track upper, lower({"L2", {0, 4}, {0, 8}});
        upper.go({1, z}, {-1, z}, 7), lower.go({1, z}, {-1, z}, 7);
        EXPECT_EQ(upper.crossings().size() + lower.crossings().size(), 1u) << z;
    }
}

TEST(Count, HighSpeedSkipsNothing) {
    Track track;
    track.at({50, 0}), track.at({-50, 4});  // 6 km/s
    ASSERT_EQ(track.crossings().size(), 1u);
    EXPECT_NEAR(track.crossings()[0].at.z, 2, 1e-4f);
}

TEST(Count, ATickExactlyOnTheLineIsNoTwoCrossingsAndNotNone) {
    Track track;
    track.at({0.5f, 1}), track.at({0, 1}), track.at({-0.5f, 1});
    EXPECT_EQ(track.crossings().size(), 1u);
    track.at({0, 1}), track.at({0.5f, 1});
    EXPECT_EQ(track.crossings().size(), 2u);
    Track level({"L1", {0, 0}, {4, 0}});
    level.at({1, 0.5f}), level.at({1, 0}), level.at({1, -0.5f});
    EXPECT_EQ(level.crossings().size(), 1u);
    level.at({1, 0}), level.at({1, 0.5f});
    EXPECT_EQ(level.crossings().size(), 2u);
}

TEST(Count, WhoStandsOnTheLineOrTurnsBackIsNotCounted) {
    Track track;
    for (int i = 0; i < 500; ++i) track.at({i % 2 ? 0.02f : -0.02f, 2});
    EXPECT_TRUE(track.crossings().empty()) << "sways on the line";
    track.go_on({0.02f, 2}, {1, 2}, 20);
    const size_t swayed = track.crossings().size();
    EXPECT_LE(swayed, 1u) << "and goes off to one side";
    track.go({1, 2}, {-0.08f, 2}, 30), track.go_on({-0.08f, 2}, {1, 2}, 30);
    EXPECT_EQ(track.crossings().size(), swayed) << "turns back 8 cm beyond it";
    track.go({1, 2}, {-0.5f, 2}, 30), track.go_on({-0.5f, 2}, {1, 2}, 30);
    ASSERT_EQ(track.crossings().size(), swayed + 2) << "turns back half a metre beyond it";
    EXPECT_NE(track.crossings()[swayed].to_right, track.crossings()[swayed + 1].to_right);
}

TEST(Count, WhoComesAnewCrossesNothing) {
    Track track;
    track.at({1, 2}, 3, 0), track.at({-1, 2}, 3, 1);  // another one in the same slot
    EXPECT_TRUE(track.crossings().empty());
    track.tick += 7;  // ticks that nobody told of
    track.at({1, 2}, 3, 1);
    EXPECT_TRUE(track.crossings().empty());
}

TEST(Count, AnEarlierTickForgetsWhatCameAfterIt) {
    Track track;
    track.go({1, 2}, {-1, 2}, 60), track.go({-1, 2}, {1, 2}, 60);
    ASSERT_EQ(track.crossings().size(), 2u);
    track.tick = 50;
    track.at({-0.6f, 2});
    EXPECT_EQ(track.crossings().size(), 1u);
    track.tick = 10;
    track.at({0.6f, 2});
    EXPECT_TRUE(track.crossings().empty());
}

TEST(Count, APlanKeepsWhatIsAsItWas) {
    Track track;
    track.go({1, 2}, {-1, 2}, 60);
    MeasurePlan plan = plan_of(track.counts);
    plan.lines.push_back({"L2", {5, 0}, {5, 4}});
    set_plan(track.counts, plan, track.tick);
    EXPECT_EQ(track.crossings().size(), 1u);
    EXPECT_EQ(track.counts.lines[1].since, track.tick);
    plan.lines[0].b = {0, 3};
    set_plan(track.counts, plan, track.tick);
    EXPECT_TRUE(track.crossings().empty()) << "a line that was moved begins anew";
}

// People in lanes, one behind the other: flow is density times speed.
class Stream : public testing::Test {
  protected:
    static constexpr float k_spacing = 1.6f, k_lane = 0.8f, k_speed = 1.25f;
    static constexpr int k_lanes = 5, k_ranks = 400;
    void run(int ticks) {
        MeasurePlan plan;
        plan.lines.push_back({"L1", {0, 0}, {0, k_lanes * k_lane}});
        plan.zones.push_back({"Z1", {{-20, 0}, {20, 0}, {20, k_lanes * k_lane}, {-20, k_lanes * k_lane}}});
        set_plan(counts, plan, 0);
        std::vector<Present> people;
        for (int t = 0; t <= ticks; ++t) {
            people.clear();
            for (uint32_t lane = 0; lane < k_lanes; ++lane)
                for (uint32_t rank = 0; rank < k_ranks; ++rank)
                    people.push_back(
                        {{lane * k_ranks + rank, 0},
                         {k_speed * k_dt * static_cast<float>(t) + 30.1f -
                              k_spacing * static_cast<float>(rank) - 0.3f * static_cast<float>(lane),
                          k_lane * (static_cast<float>(lane) + 0.5f)},
                         k_speed});
            count_people(counts, static_cast<uint32_t>(t), people);
        }
    }
    Counts counts;
};

TEST_F(Stream, FlowIsDensityTimesSpeed) {
    run(120 * 60);
    const double density = 1.0 / (k_spacing * k_lane), specific = density * k_speed;
    for (const double seconds : {k_flow_seconds, 1e9}) {
        const Flow flow = flow_of(counts.lines[0], counts.tick, seconds);
        EXPECT_EQ(flow.seconds, std::min(seconds, 120.0));
        EXPECT_EQ(flow.right, 0u) << "they go east, to the left of who looks south";
        EXPECT_NEAR(flow.per_metre_second, specific, 0.02 * specific);
        EXPECT_NEAR(flow.per_minute, 60 * specific * k_lanes * k_lane,
                    0.02 * 60 * specific * k_lanes * k_lane);
    }
    ASSERT_EQ(counts.zones[0].samples.size(), 121u);
    for (const ZoneSample& s : counts.zones[0].samples) {
        EXPECT_NEAR(s.density, density, 0.03 * density);
        EXPECT_NEAR(s.speed, k_speed, 1e-5f);
    }
    EXPECT_EQ(fruin_level(static_cast<float>(density)), 3);
}

}  // namespace
}  // namespace flaneur
