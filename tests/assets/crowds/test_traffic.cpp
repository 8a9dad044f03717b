// Those who drive in cities that are made, among people, over minutes.
#include <gtest/gtest.h>

#include "assets/cities.h"
#include "assets/quayside.h"
#include "tests/debt.h"
#include "tests/sim/vehicles/watch_traffic.h"

namespace flaneur {
namespace {

std::unique_ptr<World> peopled(City made, bool lamps, uint64_t seed, float traffic, uint32_t walkers) {
    const auto city = std::make_shared<const City>(std::move(made));
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = 2};
    options.destinations = city->destinations;
    options.crossings = city->crossings;
    if (!lamps) take_lamps(options.crossings);
    options.lanes = city->lanes;
    options.traffic = traffic;
    auto world = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

void expect_sound(const TrafficTally& seen) {
    EXPECT_LT(seen.into_people, 0.02f);
    EXPECT_LE(seen.into_vehicles, 0);
    EXPECT_LT(seen.hardest, 7.6f);
    EXPECT_LT(seen.jump, 0.27f);
    EXPECT_EQ(seen.on_red, 0u);
}

TEST(CityTraffic, HitsNobodyAndGetsOnInTheDistrict) {
    for (const bool lamps : {true, false}) {
        const auto world = peopled(generate_district({1, 4}), lamps, 1, 1, 400);
        std::printf("%zu vehicles\n", world->vehicles.all.size());
        const TrafficTally seen = watch_traffic(*world, 4 * 60 * 60);
        print(lamps ? "district with lamps" : "district", seen);
        expect_sound(seen);
        // Without lamps people who cross one after the other hold them up.
        expect_at_most(lamps ? "seconds that somebody who drives stands in the district"
                             : "seconds that somebody who drives stands in the district without lamps",
                       seen.longest_stood, 120, lamps ? 150 : 240);
        EXPECT_GT(seen.mean_speed, 1.5f);
    }
}

TEST(CityTraffic, TramsHitNobodyAndGetOnInTheDistrict) {
    const City plain = generate_district({1, 3}), city = generate_district({1, 3, true});
    EXPECT_TRUE(plain.grooves.empty());
    EXPECT_FALSE(city.grooves.empty());
    uint32_t stops = 0, gates = 0;
    for (const Lane& lane : city.lanes.all)
        if (lane.is_track) stops += lane.stop_count, gates += lane.is_gate_in;
    EXPECT_EQ(stops, 2u);
    EXPECT_EQ(gates, 2u);
    const auto world = peopled(City(city), true, 1, 1, 300);
    World& w = *world;
    const uint32_t first = w.vehicles.first_tram;
    ASSERT_LT(first, w.vehicles.all.size());
    const TrafficTally seen = watch_traffic(w, 4 * 60 * 60);
    print("district with trams", seen);
    expect_sound(seen);
    expect_at_most("seconds that somebody who drives stands in the district with trams", seen.longest_stood,
                   120, 240);
    EXPECT_GT(seen.mean_speed, 1.5f);
    for (uint32_t n = first; n < w.vehicles.all.size(); ++n)
        EXPECT_GT(w.vehicles.all[n].turns, 12u) << "tram " << n << " got nowhere";
}

TEST(CityTraffic, HitsNobodyOnTheQuayside) {
    const auto world = peopled(build_quayside(1), true, 2, 1, 150);
    const TrafficTally seen = watch_traffic(*world, 4 * 60 * 60);
    print("quayside", seen);
    expect_sound(seen);
    EXPECT_LT(seen.longest_stood, 120);
}

}  // namespace
}  // namespace flaneur
