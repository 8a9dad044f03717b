#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assets/measures/lines.h"
#include "assets/measures/moments.h"
#include "assets/measures/ttc.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

// One person, a place a frame.
Trajectories way(const std::vector<Vec2>& places, float fps = 10) {
    Trajectories tracks;
    tracks.fps = fps;
    for (uint32_t f = 0; f < places.size(); ++f) tracks.sightings.push_back({f, 5, places[f], 0, {}});
    return tracks;
}

// A lattice, a metre apart, four abreast in a corridor 4 m wide, all of which goes east for ten seconds.
Trajectories parade(float speed) {
    Trajectories tracks;
    tracks.fps = 10;
    tracks.area = {{{{0, 0}, {60, 0}, {60, 4}, {0, 4}}, {}}};
    for (uint32_t f = 0; f <= 100; ++f)
        for (uint32_t i = 0; i < 160; ++i)
            tracks.sightings.push_back(
                {f,
                 i,
                 {0.5f + static_cast<float>(i / 4) + speed * static_cast<float>(f) / 10,
                  0.5f + static_cast<float>(i % 4)},
                 0,
                 {}});
    return tracks;
}

TEST(Tracks, WindowsAreOfFramesAndEndWhereOneIsNotSeen) {
    Trajectories tracks = way({{0, 0}, {0.1f, 0}, {0.3f, 0}, {0.6f, 0}, {1, 0}, {1.5f, 0}, {2.1f, 0}});
    tracks.sightings.erase(tracks.sightings.begin() + 5);  // of frame 5 nothing is known
    const TrackTable table = track_table(tracks);
    EXPECT_FALSE(later(table, 0, -1));
    EXPECT_FALSE(later(table, 4, 1));
    EXPECT_EQ(*later(table, 4, 2), 5u);
    EXPECT_EQ(*later(table, 5, -2), 4u);
    EXPECT_EQ(*later(table, 5, -6), 0u);
    const std::vector<float> excluded = speeds_of(velocities(table, 2, AtEnds::exclude));
    EXPECT_TRUE(std::isnan(excluded[0]) && std::isnan(excluded[1]));
    EXPECT_NEAR(excluded[2], 1 / 0.4, 1e-5);
    EXPECT_TRUE(std::isnan(excluded[3])) << "frame 5";
    EXPECT_NEAR(excluded[4], (2.1 - 0.3) / 0.4, 1e-5);
    const std::vector<float> adaptive = speeds_of(velocities(table, 2, AtEnds::adaptive));
    EXPECT_TRUE(std::isnan(adaptive[0]));
    EXPECT_NEAR(adaptive[1], 0.3 / 0.2, 1e-5);
    EXPECT_NEAR(adaptive[3], 0.7 / 0.2, 1e-5);
    const std::vector<float> single = speeds_of(velocities(table, 2, AtEnds::single_sided));
    EXPECT_NEAR(single[0], 0.3 / 0.2, 1e-5);
    EXPECT_NEAR(single[3], 0.5 / 0.2, 1e-5);
    EXPECT_NEAR(single[5], 1.1 / 0.2, 1e-5);
    const std::vector<float> back = speeds_along(velocities(table, 2, AtEnds::exclude), {-3, 0});
    EXPECT_NEAR(back[2], -1 / 0.4, 1e-5) << "the other way";
}

TEST(Tracks, AccelerationIsThatOfAFallingStone) {
    std::vector<Vec2> places;
    for (int f = 0; f < 30; ++f) {
        const float t = static_cast<float>(f) / 10;
        places.push_back({1.5f * t, 4.9f * t * t});
    }
    const Trajectories tracks = way(places);
    const std::vector<Vec2> all = accelerations(track_table(tracks), 2);
    EXPECT_TRUE(std::isnan(all[3].x) && std::isnan(all[26].x));
    for (size_t i = 4; i < 26; ++i) {
        EXPECT_NEAR(all[i].x, 0, 1e-3f);
        EXPECT_NEAR(all[i].z, 9.8f, 1e-3f);
    }
}

TEST(Moments, DensitySpeedAndFlowOfAParade) {
    const Trajectories tracks = parade(0.5f);
    const TrackTable table = track_table(tracks);
    const std::vector<float> speeds = speeds_of(velocities(table, 2, AtEnds::single_sided));
    const std::vector<WalkablePolygon> outline = {{{{20.3f, -1}, {24.7f, -1}, {24.7f, 5}, {20.3f, 5}}, {}}};
    const WorkersPtr workers = make_workers(2);
    for (const float cut_off : {0.0f, 0.8f, 3.0f}) {
        const MeasuredArea area = measured_area(outline, tracks.area, {cut_off});
        EXPECT_NEAR(area.square_metres, 4.4 * 4, 1e-4) << "of it that is between the walls";
        const std::vector<AreaMoment> moments =
            area_moments(table, area, cell_ground(tracks.area, {cut_off}), speeds, {10, 90}, *workers);
        ASSERT_EQ(moments.size(), 81u);
        for (const AreaMoment& m : moments) {
            EXPECT_NEAR(m.voronoi, 1, 2e-4) << "walls cut cells";
            EXPECT_NEAR(m.covered, 1, 2e-4);
            EXPECT_NEAR(m.voronoi_speed, 0.5, 2e-4);
            EXPECT_NEAR(m.mean_speed, 0.5, 1e-4);
            EXPECT_EQ(m.people % 4, 0u);
            EXPECT_NEAR(m.classic, m.people / 17.6, 1e-5);
        }
        const std::vector<FundamentalPoint> points = fundamental_points(moments, DensityMethod::voronoi);
        const std::vector<FundamentalBin> bins = fundamental_bins(points, 0.4);
        ASSERT_EQ(bins.size(), 1u);
        EXPECT_EQ(bins[0].moments, 81u);
        EXPECT_NEAR(bins[0].from, 0.8, 1e-9);
        EXPECT_NEAR(bins[0].flow, 0.5, 3e-4);
        EXPECT_NEAR(bins[0].speed_spread, 0, 1e-3);
    }
}

// What a cut-off leaves to nobody has no speed; PedPy counts it as 0.
TEST(Moments, WhatNobodyHasIsTold) {
    Trajectories tracks = way(std::vector<Vec2>(9, {5, 5}));
    const TrackTable table = track_table(tracks);
    const std::vector<float> speeds(9, 2.0f);
    const std::vector<WalkablePolygon> outline = {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
    const WorkersPtr workers = make_workers(1);
    const std::vector<AreaMoment> moments =
        area_moments(table, measured_area(outline, {}), cell_ground({}, {1}), speeds, {}, *workers);
    for (const AreaMoment& m : moments) {
        EXPECT_NEAR(m.voronoi, 0.01, 1e-6);
        EXPECT_NEAR(m.covered, 0.03, 1e-6) << "a dodecagon of 3 m2";
        EXPECT_NEAR(m.voronoi_speed, 0.06, 1e-6);
        EXPECT_NEAR(speed_where_covered(m), 2, 1e-6);
    }
}

TEST(Moments, PersonalSpaceIsThatOfALattice) {
    const Trajectories tracks = parade(0);
    const WorkersPtr workers = make_workers(1);
    const std::vector<PersonalSpace> spaces =
        personal_spaces(track_table(tracks), cell_ground(tracks.area, {3, 24}), {0, 0}, *workers);
    const PersonalSpace& inner = spaces[4 * 20 + 1];
    EXPECT_NEAR(inner.area, 1, 1e-4f);
    EXPECT_EQ(inner.neighbours, 4u);
    EXPECT_NEAR(inner.mean_distance, 1, 1e-5f);
    EXPECT_NEAR(inner.nearest, 1, 1e-6f);
    EXPECT_EQ(spaces[4 * 20].neighbours, 3u) << "a wall at one side";
    EXPECT_EQ(spaces[160].area, 0) << "out of the range";
}

TEST(Moments, StaysEndWhereOneLeavesOrIsNotSeen) {
    Trajectories tracks = way({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 0}, {2, 0}, {2, 0}, {9, 0}});
    tracks.sightings.erase(tracks.sightings.begin() + 6);
    const std::vector<WalkablePolygon> outline = {{{{0.5f, -1}, {3.5f, -1}, {3.5f, 1}, {0.5f, 1}}, {}}};
    const std::vector<Sojourn> stays = sojourns(track_table(tracks), measured_area(outline, {}), {});
    ASSERT_EQ(stays.size(), 3u);
    EXPECT_EQ(stays[0].first, 1u);
    EXPECT_EQ(stays[0].last, 3u);
    EXPECT_NEAR(seconds_of(stays[0], 10), 0.3, 1e-9);
    EXPECT_EQ(stays[1].first, 5u);
    EXPECT_EQ(stays[2].first, 7u);
    EXPECT_EQ(sojourns(track_table(tracks), measured_area(outline, {}), {2, 4}).size(), 1u);
}

TEST(Lines, AParadeCrossesEvenly) {
    const Trajectories tracks = parade(0.5f);
    const TrackTable table = track_table(tracks);
    // To the south along x = 22: the east is to the left.
    const std::vector<LineCrossed> crossings = line_crossings(table, {{22, 0}, {22, 4}}, {});
    ASSERT_EQ(crossings.size(), 20u) << "four abreast, half a row a second, over ten seconds";
    for (const LineCrossed& c : crossings) EXPECT_TRUE(c.to_left);
    EXPECT_NEAR(crossings[0].frames, 10, 1e-2);
    EXPECT_NEAR(crossings[19].frames, 90, 1e-2);
    EXPECT_NEAR(crossings[0].at.x, 22, 1e-5f);
    EXPECT_EQ(line_crossings(table, {{22, 0}, {22, 2}}, {}).size(), 10u) << "half of the line";
    const std::vector<float> speeds = speeds_of(velocities(table, 2, AtEnds::single_sided));
    for (const FlowInterval& i : flow_intervals(first_crossings(crossings), speeds, 25, 100, 10)) {
        EXPECT_NEAR(i.mean_speed, 0.5, 1e-4);
        EXPECT_EQ(i.people % 4, 0u);
    }
}

TEST(Lines, WhoTurnsBackOnALineHasNotCrossedIt) {
    const MeasuredLine line{{0, -1}, {0, 1}};
    auto count = [&](const std::vector<Vec2>& places) {
        const Trajectories tracks = way(places);
        return line_crossings(track_table(tracks), line, {}).size();
    };
    EXPECT_EQ(count({{-1, 0}, {0, 0}, {-1, 0}}), 0u);
    EXPECT_EQ(count({{-1, 0}, {0, 0}, {0, 0.2f}, {1, 0}}), 1u);
    EXPECT_EQ(count({{-1, 0}, {1, 0}, {-1, 0}, {1, 0}}), 3u);
    EXPECT_EQ(count({{-1, 2}, {1, 2}, {1, 0}, {-1, 0}}), 1u) << "round its end, and back through it";
    EXPECT_EQ(count({{0, 0}, {1, 0}}), 0u) << "where it came from is not known";
    EXPECT_EQ(count({{-1, 3}, {0, 3}, {0, 0}, {1, 0}}), 1u) << "onto it along its straight line";
    const Trajectories tracks = way({{-1, 0}, {1, 0}, {-1, 0}});
    EXPECT_EQ(first_crossings(line_crossings(track_table(tracks), line, {})).size(), 1u);
}

// PedPy's rule: the first interval begins with the first crossing, each next one a frame after its last.
TEST(Lines, FlowIsCountedFromCrossingToCrossing) {
    std::vector<LineCrossed> crossings;
    for (const uint32_t frame : {10u, 12u, 18u, 31u, 35u})
        crossings.push_back({.frame = frame, .id = frame, .at = {}});
    const std::vector<float> speeds(1, 1.0f);
    const std::vector<FlowInterval> flows = flow_intervals(crossings, speeds, 10, 100, 25);
    ASSERT_EQ(flows.size(), 2u);
    EXPECT_EQ(flows[0].people, 3u);
    EXPECT_NEAR(flows[0].flow, 3 * 25.0 / (18 + 1 - 10), 1e-9);
    EXPECT_EQ(flows[1].people, 2u);
    EXPECT_NEAR(flows[1].flow, 2 * 25.0 / (35 + 1 - 19), 1e-9);
}

TEST(Lines, PassagesLeadFromOneLineToTheOther) {
    const MeasuredLine line{{0, 0}, {0, 4}};
    for (Vec2 p : area_beside(line, 2)) EXPECT_GE(p.x, 0) << "the left of who looks south is the east";
    auto through = [&](const std::vector<Vec2>& places) {
        const Trajectories tracks = way(places);
        return passages(track_table(tracks), line, 2, {});
    };
    const std::vector<PassedThrough> passed =
        through({{-1, 2}, {0.2f, 2}, {0.8f, 2}, {1.4f, 2}, {1.9f, 2}, {2.6f, 2}});
    ASSERT_EQ(passed.size(), 1u);
    EXPECT_EQ(passed[0].entered, 1u);
    EXPECT_EQ(passed[0].left, 5u);
    EXPECT_NEAR(passed[0].speed, 2 / 0.4, 1e-6);
    EXPECT_NEAR(passed[0].density, 1.0 / 8, 1e-6);
    EXPECT_EQ(through({{3, 2}, {1.4f, 2}, {0.2f, 2}, {-1, 2}}).size(), 1u) << "the other way";
    EXPECT_TRUE(through({{-1, 2}, {1, 2}, {-1, 2}}).empty()) << "in and out by the same line";
    EXPECT_TRUE(through({{-1, 2}, {1, 2}, {1, 6}, {3, 6}}).empty()) << "out at the side";
    EXPECT_TRUE(through({{1, 2}, {3, 2}}).empty()) << "began inside";
}

TEST(Ttc, DiscsMeetWhenTheyShould) {
    EXPECT_NEAR(time_to_collision({5, 0}, {-2, 0}, 0.4f), 2.3f, 1e-6f) << "head on";
    EXPECT_EQ(time_to_collision({5, 0}, {2, 0}, 0.4f), std::numeric_limits<float>::infinity()) << "apart";
    EXPECT_EQ(time_to_collision({5, 0}, {0, 0}, 0.4f), std::numeric_limits<float>::infinity()) << "at rest";
    EXPECT_EQ(time_to_collision({0.3f, 0}, {1, 0}, 0.4f), 0) << "they touch";
    // Aside by 0.3 of 0.5: they meet where the way left is 5 - 0.4.
    EXPECT_NEAR(time_to_collision({5, 0.3f}, {-1, 0}, 0.5f), 4.6f, 1e-5f);
    EXPECT_EQ(time_to_collision({5, 0.6f}, {-1, 0}, 0.5f), std::numeric_limits<float>::infinity()) << "past";
    EXPECT_NEAR(time_to_collision({1000, 0}, {-1, 0}, 0.4f), 999.6f, 1e-3f);
}

TEST(Ttc, IsTheLeastOfAll) {
    Trajectories tracks;
    tracks.fps = 10;
    for (uint32_t f = 0; f < 3; ++f) {
        const float t = static_cast<float>(f) / 10;
        tracks.sightings.push_back({f, 1, {t, 0}, 0, {}});
        tracks.sightings.push_back({f, 2, {5 - t, 0}, 0, {}});
        tracks.sightings.push_back({f, 3, {9, 0}, 0, {}});
        if (f == 1) tracks.sightings.push_back({f, 4, {4, 0.1f}, 0, {}});
    }
    const TrackTable table = track_table(tracks);
    const WorkersPtr workers = make_workers(2);
    const std::vector<NextCollision> next =
        next_collisions(table, velocities(table, 1, AtEnds::single_sided), 0.2f, {1, 2}, *workers);
    EXPECT_TRUE(std::isnan(next[0].seconds)) << "out of the range";
    EXPECT_NEAR(next[3].seconds, (4.8f - 0.4f) / 2, 1e-4f);
    EXPECT_EQ(next[3].with, 2u);
    EXPECT_EQ(next[4].with, 1u);
    EXPECT_NEAR(next[5].seconds, 8.9f - 0.4f, 1e-4f) << "the first one comes, behind the second";
    EXPECT_TRUE(std::isnan(next[6].seconds)) << "whose speed is not known";
}

}  // namespace
}  // namespace flaneur
