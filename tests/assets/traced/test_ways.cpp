// What points become: ways of made trajectories, whose truth is known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "assets/traced/ways.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

using namespace flaneur;

namespace {

constexpr float k_two_pi = 2 * k_pi;

// Noise of a tracker, metres: nearly normal with that deviation.
Vec2 noise(uint32_t number, float deviation) {
    const RandomKey key{5, number, 0, Purpose::spawn};
    return {deviation * random_normal(key), deviation * random_normal(key, 1)};
}

// One who is at `truth` and seen beside it.
Trajectories made(float fps, float seconds, const std::function<Vec2(float)>& truth,
                  const std::function<Vec2(float, uint32_t)>& beside = {}) {
    Trajectories t;
    t.fps = fps;
    const auto frames = static_cast<uint32_t>(std::lround(seconds * fps)) + 1;
    for (uint32_t f = 0; f < frames; ++f) {
        const float time = static_cast<float>(f) / fps;
        t.sightings.push_back({f, 7, truth(time) + (beside ? beside(time, f) : Vec2{}), 0, {}});
    }
    return t;
}

TracePoint at_second(const RecordedWays& ways, float seconds, size_t way = 0) {
    return trace_at(ways.traces, ways.traces.ways[way],
                    k_trace_lead + static_cast<uint32_t>(std::lround(seconds * 60)));
}

float farthest(const RecordedWays& ways, float from, float to, const std::function<Vec2(float)>& truth) {
    float most = 0;
    for (float s = from; s <= to; s += 1 / 60.0f)
        most = std::max(most, length(on_ground(at_second(ways, s).at) - truth(s)));
    return most;
}

float fastest(const RecordedWays& ways, float from, float to) {
    float most = 0;
    for (float s = from; s <= to; s += 1 / 60.0f) most = std::max(most, length(at_second(ways, s).velocity));
    return most;
}

}  // namespace

TEST(Ways, SwayAndJitterOfAHeadAreTakenOutOfAStraightWalk) {
    auto truth = [](float t) { return Vec2{1.3f * t, 0}; };
    auto sways = [](float t, uint32_t f) {
        const SinCos stride = sin_cos(k_two_pi * 0.9f * t), step = sin_cos(k_two_pi * 1.8f * t + 1);
        return Vec2{0.012f * step.sine, 0.04f * stride.sine} + noise(f, 0.008f);
    };
    const RecordedWays ways = make_ways(made(25, 12, truth, sways));
    EXPECT_GT(ways.figures.sways, 0.95);
    EXPECT_LT(farthest(ways, 0.5f, 11.5f, truth), 0.015f);
    for (float s = 1; s < 11; s += 0.05f) {
        const TracePoint p = at_second(ways, s);
        EXPECT_NEAR(length(p.velocity), 1.3f, 0.04f);
        EXPECT_LT(std::fabs(p.velocity.z), 0.03f);
        EXPECT_NEAR(p.heading, k_pi / 2, 0.02f);
    }
}

TEST(Ways, WhoDodgesDoesNotSway) {
    // Half a metre aside and back, once in twelve seconds.
    auto truth = [](float t) {
        return Vec2{1.3f * t, 0.5f * smoothstep(4, 6, t) * (1 - smoothstep(6, 8, t))};
    };
    const RecordedWays ways = make_ways(made(25, 12, truth));
    EXPECT_LT(ways.figures.sways, 0.3);
    EXPECT_LT(farthest(ways, 0, 12, truth), 0.05f);
}

TEST(Ways, WhoStandsStands) {
    auto truth = [](float) { return Vec2{2, 3}; };
    const RecordedWays ways =
        make_ways(made(25, 20, truth, [](float, uint32_t f) { return noise(f, 0.015f); }));
    EXPECT_LT(farthest(ways, 0, 20, truth), 0.02f);
    EXPECT_LT(fastest(ways, 0, 20), 0.03f);  // k_standing_speed is 0.08
    for (float s = 0; s < 20; s += 0.5f) EXPECT_NEAR(at_second(ways, s).turn_rate, 0, 1e-3f);
}

TEST(Ways, AHalfTurnTakesAsLongAsPeopleTakeForIt) {
    auto truth = [](float t) { return Vec2{t < 5 ? 1.2f * t : 6 - 1.2f * (t - 5), 0}; };
    const RecordedWays ways = make_ways(made(25, 10, truth));
    EXPECT_LT(farthest(ways, 0, 10, truth), 0.15f);
    float turned = 0;
    for (float s = 3; s < 7; s += 1 / 60.0f) {
        const TracePoint p = at_second(ways, s);
        EXPECT_LT(std::fabs(p.turn_rate), 2.6f);
        turned += p.turn_rate / 60;
    }
    EXPECT_NEAR(std::fabs(turned), k_pi, 0.15f);
}

TEST(Ways, WhoStopsAndGoesDoesSoInTime) {
    auto truth = [](float t) { return Vec2{1.3f * std::min(t, 4.0f) + 1.3f * std::max(t - 8, 0.0f), 0}; };
    const RecordedWays ways = make_ways(made(25, 12, truth));
    EXPECT_LT(farthest(ways, 0, 12, truth), 0.12f);
    EXPECT_LT(fastest(ways, 5.2f, 6.8f), 0.08f);
    EXPECT_GT(length(at_second(ways, 2).velocity), 1.2f);
    EXPECT_LT(ways.figures.near, 0.05f);
    EXPECT_LT(ways.figures.farthest, 0.15f);
}

TEST(Ways, OneSightingASecondIsEnough) {
    auto truth = [](float t) { return Vec2{1.3f * t, 2 * sin_cos(0.3f * t).sine}; };
    const RecordedWays ways = make_ways(made(1, 20, truth));
    EXPECT_LT(farthest(ways, 1, 19, truth), 0.06f);
    EXPECT_EQ(ways.figures.sways, 0);
}

TEST(Ways, ShortGapsAreBridgedAndLongOnesLeave) {
    auto truth = [](float t) { return Vec2{1.3f * t, 0}; };
    Trajectories t = made(25, 12, truth);
    auto leave_out = [&](uint32_t from, uint32_t to) {
        std::erase_if(t.sightings, [&](const Sighting& s) { return s.frame > from && s.frame < to; });
    };
    leave_out(50, 75);
    const RecordedWays bridged = make_ways(t);
    EXPECT_EQ(bridged.figures.ways, 1u);
    EXPECT_EQ(bridged.figures.bridged, 1u);
    EXPECT_LT(farthest(bridged, 0, 12, truth), 0.03f);
    leave_out(150, 225);
    const RecordedWays left = make_ways(t);
    ASSERT_EQ(left.figures.ways, 2u);
    EXPECT_EQ(left.traces.ways[0].gone, k_trace_lead + 360);
    EXPECT_EQ(left.traces.ways[1].seen, k_trace_lead + 540);
}

TEST(Ways, WhoJumpsLeavesAndComesAndStraysAreLeftOut) {
    Trajectories t = made(25, 8, [](float s) { return Vec2{1.3f * s + (s > 4 ? 5.0f : 0.0f), 0}; });
    t.sightings[40].at.z += 3;
    const RecordedWays ways = make_ways(t);
    EXPECT_EQ(ways.figures.ways, 2u);
    EXPECT_EQ(ways.figures.jumps, 1u);
    EXPECT_EQ(ways.figures.strays, 1u);
    EXPECT_LT(ways.figures.farthest, 0.03f);
}

TEST(Ways, OneFrameIsAPictureOfPeopleWhoStand) {
    Trajectories t;
    for (uint32_t id = 0; id < 5; ++id)
        t.sightings.push_back({100, id, {static_cast<float>(id), 2}, 0, {0, 1}});
    const RecordedWays ways = make_ways(t);
    ASSERT_EQ(ways.traces.ways.size(), 5u);
    EXPECT_EQ(ways.traces.most, 5u);
    for (size_t i = 0; i < 5; ++i) {
        for (const float s : {0.0f, 5.0f, 9.9f}) {
            EXPECT_NEAR(at_second(ways, s, i).at.x, static_cast<float>(i), 1e-3f);
            EXPECT_NEAR(length(at_second(ways, s, i).velocity), 0, 1e-3f);
            EXPECT_NEAR(at_second(ways, s, i).heading, 0, 1e-3f);
        }
        EXPECT_GE(ways.traces.ways[i].gone, k_trace_lead + 600);
    }
}

TEST(Ways, WhoFacesAsideGoesAside) {
    Trajectories t = made(25, 6, [](float s) { return Vec2{0.6f * s, 0}; });
    for (Sighting& s : t.sightings) s.facing = {0, 1};
    const RecordedWays ways = make_ways(t);
    for (float s = 0; s < 6; s += 0.5f) EXPECT_NEAR(at_second(ways, s).heading, 0, 0.02f);
}

TEST(Ways, WhoStepsInIsThereInFullAsLongAsItIsRecorded) {
    Trajectories t = made(25, 6, [](float s) { return Vec2{1.2f * s, 0}; });
    t.sightings.push_back({0, 9, {0, 9}, 0, {}});
    t.sightings.push_back({200, 9, {0, 9}, 0, {}});
    std::erase_if(t.sightings, [](const Sighting& s) { return s.id == 7 && s.frame < 50; });
    std::ranges::stable_sort(t.sightings, {}, &Sighting::frame);
    for (const Entering how : {Entering::fade, Entering::step}) {
        const RecordedWays ways = make_ways(t, how);
        const auto seven = std::ranges::find(ways.traces.ways, 7u, &TracedWay::id);
        ASSERT_NE(seven, ways.traces.ways.end());
        const uint32_t first = k_trace_lead + 120, last = k_trace_lead + 360;
        EXPECT_EQ(seven->seen, how == Entering::fade ? first : first - 32);
        EXPECT_EQ(seven->gone, how == Entering::fade ? last : last + 32);
        EXPECT_EQ(seven->begin, first - k_trace_lead);
    }
}

TEST(Ways, HeadsTellHowTallOneIs) {
    Trajectories t = made(25, 4, [](float s) { return Vec2{s, 0}; });
    t.heights = HeightsOf::heads;
    for (Sighting& s : t.sightings) s.height = 1.70f + 0.02f * sin_cos(static_cast<float>(s.frame)).sine;
    EXPECT_NEAR(make_ways(t).traces.ways[0].height, 1.72f, 0.015f);
    t.tracked.push_back({.id = 7, .name = {}, .height = 1.55f});
    EXPECT_FLOAT_EQ(make_ways(t).traces.ways[0].height, 1.55f);
    t.tracked[0].kind = TrackedKind::bicycle;
    EXPECT_EQ(make_ways(t).traces.ways.size(), 0u);
}
