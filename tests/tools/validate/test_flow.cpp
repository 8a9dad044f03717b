#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/measures/moments.h"
#include "sim/base/rng.h"
#include "tools/flaneur/validate/play.h"
#include "tools/flaneur/validate/report.h"

namespace flaneur {
namespace {

// A lattice, a metre apart, in a corridor 4 m wide, all of which goes east at `speed` for ten seconds.
Trajectories procession(float speed) {
    Trajectories tracks;
    tracks.fps = 10;
    tracks.area = {{{{0, 0}, {60, 0}, {60, 4}, {0, 4}}, {}}};
    for (uint32_t f = 0; f <= 100; ++f)
        for (uint32_t i = 0; i < 160; ++i) {
            const uint32_t row = i / 4, file = i % 4;
            tracks.sightings.push_back({f,
                                        i,
                                        {0.5f + static_cast<float>(row) + speed * static_cast<float>(f) / 10,
                                         0.5f + static_cast<float>(file)},
                                        0,
                                        {}});
        }
    return tracks;
}

TEST(Flow, IsDensityTimesSpeed) {
    const Trajectories tracks = procession(0.5f);
    const Rectangle zone{{20.3f, 0}, {24.7f, 4}};
    const MeanFlow mean = mean_of(flow_samples(tracks, zone, 0.5, 1, 9));
    EXPECT_EQ(mean.samples, 17u);
    EXPECT_NEAR(mean.density, 1, 1e-3) << "walls cut cells";
    EXPECT_NEAR(mean.classic, 1, 0.15);
    EXPECT_NEAR(mean.speed, 0.5, 1e-3);
    EXPECT_NEAR(mean.mean_speed, 0.5, 1e-3);
    const std::vector<double> crossings = crossings_at(tracks, 22);
    ASSERT_EQ(crossings.size(), 20u) << "four abreast, half a row a second, over ten seconds";
    EXPECT_NEAR(crossings[0], 1, 1e-3);
    EXPECT_NEAR(crossings[19], 9, 1e-3);
}

TEST(Flow, CountsOnlyGroundThatIsThere) {
    Trajectories tracks = procession(0);
    // A pillar takes a quarter of the zone, and nobody stands there.
    tracks.area[0].holes = {{{20, 0}, {22, 0}, {22, 2}, {20, 2}}};
    std::erase_if(tracks.sightings, [](const Sighting& s) { return is_in({{20, 0}, {22, 2}}, s.at); });
    const MeanFlow mean = mean_of(flow_samples(tracks, {{20, 0}, {24, 4}}, 1, 1, 9));
    EXPECT_NEAR(mean.classic, 1, 1e-6);
    EXPECT_NEAR(mean.density, 1, 1e-3);
    EXPECT_NEAR(mean.speed, 0, 1e-6);
}

// Whatever the places, nobody counts for more than one.
TEST(Flow, NobodyCountsTwice) {
    Trajectories tracks;
    tracks.area = {{{{-1, 0}, {110, 0}, {110, 5}, {-1, 5}}, {}}};
    for (uint32_t f = 0; f < 20; ++f) {
        const std::vector<Vec2> places = spread({{30, 0.25f}, {50, 4.75f}}, 200, f);
        for (uint32_t i = 0; i < places.size(); ++i) tracks.sightings.push_back({f, i, places[i], 0, {}});
    }
    for (const FlowSample& s : flow_samples(tracks, {{35, 0}, {45, 5}}, 0.04, 0, 0.76))
        EXPECT_NEAR(s.density, s.classic, 0.2);
}

TEST(Flow, WeidmannsCurveIsHis) {
    EXPECT_NEAR(weidmann_speed(0), 1.34, 1e-9);
    EXPECT_NEAR(weidmann_speed(0.3), 1.34, 0.01);
    EXPECT_NEAR(weidmann_speed(1), 1.06, 0.01);
    EXPECT_EQ(weidmann_speed(5.4), 0);
    EXPECT_EQ(weidmann_speed(9), 0);
}

TEST(Play, PeopleAreSpreadApart) {
    for (const size_t count : {1u, 40u, 200u}) {
        const std::vector<Vec2> places = spread({{1, 2}, {9, 10}}, count, count);
        EXPECT_EQ(places.size(), count);
        for (size_t i = 0; i < places.size(); ++i) {
            EXPECT_TRUE(is_in({{1, 2}, {9, 10}}, places[i]));
            for (size_t k = 0; k < i; ++k) EXPECT_GE(length(places[i] - places[k]), k_body_width - 1e-4f);
        }
    }
    EXPECT_LT(spread({{0, 0}, {10, 10}}, 1000, 1).size(), 470u) << "bodies have a size";
}

TEST(Play, GuestsComeGoAndLeave) {
    const Rectangle floor[] = {{{0, 0}, {20, 3}}};
    const Guest guests[] = {
        {.from = {2, 0, 1}, .goal = {19, 0, 1}, .exit = {{15, 0}, {20, 3}}, .starts = 3},
        {.from = {2, 0, 1}, .goal = {19, 0, 2}, .exit = {{15, 0}, {20, 3}}},  // waits until there is room
    };
    Result<Play> played = play(make_arena(floor), guests, {.seconds = 60, .sample_ticks = 6});
    ASSERT_TRUE(played) << played.error().message;
    EXPECT_EQ(count_left(*played), 2u);
    EXPECT_EQ(*played->fates[0].entered, 0);
    EXPECT_NEAR(*played->fates[0].moved, 3.3f, 0.3f);
    EXPECT_GT(*played->fates[1].entered, *played->fates[0].moved);
    EXPECT_FLOAT_EQ(*last_left(*played), played->seconds);
    for (const Sighting& s : played->tracks.sightings) EXPECT_LT(s.at.x, 15.1f);
    EXPECT_FALSE(play(make_arena(floor), std::vector<Guest>{{.from = {90, 0, 1}, .goal = {19, 0, 1}}},
                      {.seconds = 60}))
        << "nobody can stand there";
}

TEST(Play, GuestsMayComeWalking) {
    const Rectangle floor[] = {{{0, 0}, {20, 3}}};
    const Guest guest{.from = {2, 0, 1},
                      .goal = {19, 0, 1},
                      .exit = {{15, 0}, {20, 3}},
                      .heading = 1.5707963f,
                      .velocity = {1.3f, 0}};
    Result<Play> played = play(make_arena(floor), {&guest, 1}, {.seconds = 1, .sample_ticks = 1});
    ASSERT_TRUE(played);
    EXPECT_NEAR(played->tracks.sightings[30].at.x, 2.65f, 0.1f) << "half a second at 1.3 m/s";
}

TEST(Play, FloorsHaveWallsRoundThem) {
    const Rectangle floors[] = {{{0, 0}, {4, 4}}, {{4, 1}, {8, 2}}};
    const Arena arena = make_arena(floors);
    EXPECT_EQ(arena.ground.faces.size(), 8u);
    EXPECT_TRUE(is_on(arena, {5, 1.5f}));
    EXPECT_FALSE(is_on(arena, {5, 2.5f}));
    EXPECT_TRUE(closest_wall(arena.ground, {6, 0, 1.5f}, 0.6f));
    EXPECT_FALSE(closest_wall(arena.ground, {4, 0, 1.5f}, 0.45f)) << "none across the way";
}

// People few and far between, both ways: as they would go again.
Trajectories strollers() {
    Trajectories tracks;
    tracks.fps = 25;
    for (uint32_t f = 0; f < 3000; ++f)
        for (uint32_t i = 0; i < 50; ++i) {
            const float went = 1.2f * (static_cast<float>(f) / 25 - 2 * static_cast<float>(i));
            if (went < 0 || went > 12) continue;
            const bool east = i % 2 == 0;
            const float z = random_between({1, i, 0, Purpose::body}, east ? 0.3f : 2.3f, east ? 1.7f : 3.7f);
            tracks.sightings.push_back({f, i, {east ? went : 12 - went, z}, 0, {}});
        }
    return tracks;
}

TEST(Rerun, AWideCorridorKeepsSpeedAndDensity) {
    ValidationNotes notes;
    notes.measured = {{"strollers", strollers()}};
    EXPECT_TRUE(is_corridor(notes.measured[0].tracks));
    Result<Findings> findings = test_rerun(notes);
    ASSERT_TRUE(findings) << findings.error().message;
    ASSERT_EQ(findings->size(), 3u);
    for (const ValidationFinding& f : *findings)
        EXPECT_EQ(f.verdict, Validity::passed) << f.what << ": " << f.expected << ", " << f.measured;
    // Those who go nowhere, and those who pass a neck, are not rerun.
    for (Sighting& s : notes.measured[0].tracks.sightings) s.at.x = std::fmod(s.at.x, 4.0f);
    EXPECT_FALSE(is_corridor(notes.measured[0].tracks));
    Trajectories neck = strollers();
    for (Sighting& s : neck.sightings)
        if (s.at.x > 4 && s.at.x < 9) s.at.z = 2;
    EXPECT_FALSE(is_corridor(neck));
}

TEST(Validation, IsToldInEveryForm) {
    const ValidationTest& test = validation_tests()[0];
    const std::vector<Validated> all = {
        {&test, {{"a|b", "1", "2", Validity::missed}, {"c", "3", "3", Validity::passed}}, 1}};
    EXPECT_FALSE(is_passed(all[0].findings));
    EXPECT_NE(validation_markdown(all).find("| a\\|b: 1 | 2 | missed |\n|  |  | c: 3 | 3 | passed |\n"),
              std::string::npos)
        << validation_markdown(all);
    EXPECT_NE(validation_json(all).find("\"passed\": false"), std::string::npos);
    EXPECT_NE(told_validation(all[0]).find("missed"), std::string::npos);
    ValidationNotes notes;
    EXPECT_NE(diagram_svg(notes).find("Weidmann"), std::string::npos);
    EXPECT_EQ(within("", 2, 1, 3, "s").verdict, Validity::passed);
    EXPECT_EQ(within("", std::nan(""), 1, 3, "s").verdict, Validity::missed);
}

TEST(Validation, FewPeopleWalkAsTheyShould) {
    ValidationNotes notes;
    for (const ValidationTest& test : validation_tests()) {
        if (test.id != "R1" && test.id != "R2/3" && test.id != "R5" && test.id != "R6" && test.id != "R7")
            continue;
        Result<Findings> findings = test.run(notes);
        ASSERT_TRUE(findings) << findings.error().message;
        for (const ValidationFinding& f : *findings)
            EXPECT_EQ(f.verdict, Validity::passed) << test.id << ", " << f.what << ": " << f.measured;
    }
}

}  // namespace
}  // namespace flaneur
