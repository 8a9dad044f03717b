// The place that is made of a recording.
#include <gtest/gtest.h>

#include "assets/traced/hall.h"

using namespace flaneur;

namespace {

// A room of 10 by 8 m with a pillar, and one who goes straight through it along x, out of both walls.
Trajectories room() {
    Trajectories t;
    t.area.push_back({{{-5, -4}, {5, -4}, {5, 4}, {-5, 4}}, {{{-1, 2}, {1, 2}, {1, 3}, {-1, 3}}}, 0, {}});
    for (uint32_t f = 0; f < 130; ++f)
        t.sightings.push_back({f, 1, {-7 + 0.11f * static_cast<float>(f), 0}, 0, {}});
    t.walls.push_back({{-3, -2}, {3, -2}});
    return t;
}

float free_way(const City& city, Vec3 from, Vec3 way) {
    const auto hit = raycast(city.ground, from, way, 20);
    return hit ? hit->distance : 20;
}

}  // namespace

TEST(Hall, WallsStandRoundTheAreaButWherePeopleGo) {
    const City city = build_hall(room(), "room");
    EXPECT_NEAR(free_way(city, {0, 0.8f, 0}, {1, 0, 0}), 20, 1e-3f);
    EXPECT_NEAR(free_way(city, {0, 0.8f, 1}, {1, 0, 0}), 5, 0.01f);
    EXPECT_NEAR(free_way(city, {0, 0.8f, 0}, {0, 0, 1}), 2, 0.01f);           // the pillar
    EXPECT_NEAR(free_way(city, {4, 0.8f, 0}, {0, 0, -1}), 4, 0.01f);          // the far wall
    EXPECT_NEAR(free_way(city, {0, 0.8f, 0}, {0, 0, -1}), 2 - 0.04f, 0.01f);  // the line
    EXPECT_NEAR(free_way(city, {0, 1.3f, 1}, {1, 0, 0}), 20, 1e-3f);          // over the walls
}

TEST(Hall, GroundIsUnderEverybodyAndBeside) {
    const Trajectories t = room();
    const City city = build_hall(t, "room");
    for (const Sighting& s : t.sightings) {
        const auto hit = ground_at(city.ground, at_height(s.at, 0), 0.5f, 0.5f);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->height, 0, 1e-4f);
    }
    EXPECT_FALSE(ground_at(city.ground, {0, 0, 2.5f}, 0.5f, 0.5f).has_value() &&
                 free_way(city, {0, 0.5f, 0}, {0, 0, 1}) > 3);
}

TEST(Hall, SlopesAreAsTheAreaSays) {
    Trajectories t = room();
    t.area[0].holes.clear();
    t.walls.clear();
    t.area[0].level = 1, t.area[0].rise = {0.2f, 0};
    const City city = build_hall(t, "slope");
    for (const float x : {-4.0f, 0.0f, 4.0f}) {
        const auto hit = ground_at(city.ground, {x, 1 + 0.2f * x, 0}, 0.3f, 0.3f);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->height, 1 + 0.2f * x, 1e-3f);
        EXPECT_NEAR(level_at(t, {x, 0}), 1 + 0.2f * x, 1e-4f);
    }
}

TEST(Hall, WithoutAnAreaGroundIsWherePeopleClimb) {
    Trajectories t;
    t.heights = HeightsOf::ground;
    // Up 3 m along x, and back below that.
    for (uint32_t f = 0; f < 200; ++f) {
        const float x = 0.05f * static_cast<float>(f);
        t.sightings.push_back({f, 1, {x, 0}, 0.3f * x, {}});
        t.sightings.push_back({f, 2, {x, 0}, -2, {}});
    }
    const City city = build_hall(t, "stairs");
    for (const Sighting& s : t.sightings) {
        if (s.at.x < 0.5f || s.at.x > 9.3f) continue;
        const auto hit = ground_at(city.ground, at_height(s.at, s.height), 0.3f, 0.3f);
        ASSERT_TRUE(hit) << s.at.x << " " << s.height;
        EXPECT_NEAR(hit->height, s.height, 0.08f);
    }
}
