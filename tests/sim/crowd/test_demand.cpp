#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/demand.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// On a plaza: a shop, a bench and an edge in its corners, and a door off the mesh.
const std::vector<Destination> k_places = {{DestinationKind::shop, {50, 0, 50}, {0, 1}, 3},
                                           {DestinationKind::shop, {-50, 0, 50}, {0, 1}, 1},
                                           {DestinationKind::bench, {50, 0, -50}, {1, 0}, 1},
                                           {DestinationKind::square, {-50, 0, -50}, {1, 0}, 1},
                                           {DestinationKind::door, {500, 0, 0}, {1, 0}, 1}};

struct Made {
    Ground ground;
    std::vector<Destination> places;
    NavmeshPtr mesh;
    Demand demand;
};
Made make(std::vector<Destination> places) {
    Made m;
    m.ground = square(120);
    m.places = std::move(places);
    m.mesh = std::move(build_navmesh(m.ground, {}, 1)).value();
    m.demand = make_demand(m.places, m.ground.low, m.ground.high, *m.mesh, 12);
    return m;
}

TEST(Demand, FollowsTheDay) {
    EXPECT_GT(demand_at(DestinationKind::door, 18), demand_at(DestinationKind::door, 12));
    EXPECT_GT(demand_at(DestinationKind::shop, 12), demand_at(DestinationKind::shop, 22));
    EXPECT_GT(demand_at(DestinationKind::square, 20), demand_at(DestinationKind::square, 8));
    for (int k = 0; k < k_destination_count; ++k) {
        auto kind = static_cast<DestinationKind>(k);
        EXPECT_FLOAT_EQ(demand_at(kind, 0), demand_at(kind, 24));
        EXPECT_NEAR(demand_at(kind, 23.999f), demand_at(kind, 0), 0.01f);
        EXPECT_FLOAT_EQ(demand_at(kind, 30), demand_at(kind, 6));
        for (float hour = 0; hour < 24; hour += 0.5f) EXPECT_GE(demand_at(kind, hour), 0);
        EXPECT_LT(stay_at(kind).least, stay_at(kind).most);
    }
}

TEST(Demand, TripsGoWhereThereIsSomething) {
    Made m = make(k_places);
    NavPoint from = *nearest(*m.mesh, 0, {0, 0, 0});
    std::array<int, k_destination_count> trips{};
    int heavy = 0, strolls = 0;
    for (uint32_t i = 0; i < 4000; ++i) {
        auto trip = choose_trip(m.demand, *m.mesh, 0, from, By::feet, 0, {1, i, 0, Purpose::errand});
        if (!trip) {
            ++strolls;
            continue;
        }
        ++trips[static_cast<size_t>(trip->kind)];
        heavy += trip->kind == DestinationKind::shop && trip->place.position.x > 0;
        float nearest_one = 1e9f;
        for (const Destination& d : m.places) {
            if (d.kind == trip->kind)
                nearest_one = std::min(nearest_one, length(d.position - trip->place.position));
        }
        EXPECT_LT(nearest_one, 2.5f);
        EXPECT_NE(trip->place.polygon, 0u);
        EXPECT_GT(length(trip->place.position - from.position), 38);
    }
    int shops = trips[static_cast<size_t>(DestinationKind::shop)];
    EXPECT_EQ(trips[static_cast<size_t>(DestinationKind::door)], 0) << "it is not on the mesh";
    EXPECT_EQ(trips[static_cast<size_t>(DestinationKind::stop)], 0);
    EXPECT_GT(shops, trips[static_cast<size_t>(DestinationKind::bench)]);
    EXPECT_NEAR(static_cast<float>(heavy) / static_cast<float>(shops), 0.75f, 0.05f);
    EXPECT_GT(strolls, 100);
}

TEST(Demand, NobodyIsDrawnWhereThereIsNothing) {
    Made m = make({});
    NavPoint from = *nearest(*m.mesh, 0, {0, 0, 0});
    for (uint32_t i = 0; i < 50; ++i)
        EXPECT_FALSE(choose_trip(m.demand, *m.mesh, 0, from, By::feet, 0, {1, i, 0, Purpose::errand}));
}

TEST(Demand, WalkersGetThereAndFaceIt) {
    Made m = make(k_places);
    WorkersPtr workers = make_workers(2);
    prepare_queries(*m.mesh, 2);
    Folk folk;
    auto made =
        populate(m.ground, surroundings_of(m.ground), m.places, *m.mesh, *workers, 60, {&folk, 1}, 5, 12);
    ASSERT_TRUE(made);
    Crowd& c = *made;
    int stood = 0, facing = 0;
    std::vector<uint32_t> since(c.count, 0);
    for (uint32_t tick = 0; tick < 360 * 60; ++tick) {
        step_crowd(c, surroundings_of(m.ground), *m.mesh, *workers, tick, 5);
        for (uint32_t i = 0; i < c.count; ++i) {
            bool stands = tick < c.journeys[i].pause_until && length_squared(c.journeys[i].facing) > 0;
            since[i] = stands ? since[i] + 1 : 0;
            if (since[i] != 3 * 60) continue;  // time to turn
            ++stood;
            facing += dot(heading_direction(c.motion.heading[i]), c.journeys[i].facing) > 0.8f;
        }
    }
    EXPECT_GT(stood, 80);
    std::printf("%d of %d face what they came for\n", facing, stood);
    EXPECT_GT(facing, stood * 9 / 10);
}

}  // namespace
}  // namespace flaneur
