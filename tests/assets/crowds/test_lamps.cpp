// Crossings of cities: which lamps rule them, and people who mind them there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "assets/cities.h"
#include "assets/props/props.h"
#include "assets/quayside.h"
#include "sim/base/math.h"
#include "sim/world.h"

namespace flaneur {
namespace {

TEST(CityLamps, EachSignalOfTheDistrictIsOfACrossingWithPlacesToWait) {
    size_t signals = 0, drivers = 0, spots = 0, kerbs = 0;
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const City city = generate_district({.seed = seed, .blocks = 3});
        const auto mesh = build_navmesh(city.ground, {}, 2);
        ASSERT_TRUE(mesh);
        const KerbMap map = make_kerb_map(city.crossings, **mesh);
        for (const Crossing& c : city.crossings.all) {
            const auto hit = ground_at(city.ground, c.centre, 0.5f, 0.5f);
            ASSERT_TRUE(hit && hit->kind == Surface::crossing);
            EXPECT_NEAR(length(c.across), 1, 1e-3f);
            EXPECT_GT(c.half_length, 2);
        }
        for (const Prop& prop : city.props) {
            if (prop.kind != PropKind::signal) continue;
            const uint32_t number = crossing_of_post(city.crossings, prop.position);
            ASSERT_NE(number, k_no_lamp);
            const Crossing& c = city.crossings.all[number];
            const SignalHeads heads = heads_of(prop, c);
            // Seen from the kerb on the other side.
            EXPECT_GT(dot(heading_direction(heads.walk_yaw), on_ground(c.centre - prop.position)), 0);
            ++signals;
            if (!heads.drive_yaw) continue;
            ++drivers;
            const Vec2 facing = heading_direction(*heads.drive_yaw);
            EXPECT_GT(std::fabs(dot(facing, c.along)), 0.999f);
            EXPECT_GT(dot(facing, on_ground(prop.position - c.centre)), 0) << "before the crossing";
        }
        for (uint32_t kerb = 0; kerb < 2 * city.crossings.all.size(); ++kerb) {
            if (!is_ruled(city.crossings.all[kerb / 2])) continue;
            EXPECT_GE(map.first[kerb + 1] - map.first[kerb], 4u);
            spots += map.first[kerb + 1] - map.first[kerb];
            ++kerbs;
        }
    }
    std::printf("district: %zu signals, %zu of them for drivers; %zu kerbs with %zu places\n", signals,
                drivers, kerbs, spots);
    EXPECT_GT(signals, 20u);
    EXPECT_GT(drivers, 8u);
}

TEST(CityLamps, NobodyIsHeldUpOnTheQuaysideAndCreaturesCrossOnGreen) {
    const auto city = std::make_shared<const City>(build_quayside(1));
    uint32_t crossed = 0, red = 0, creatures = 0, stuck = 0;
    for (const uint64_t seed : {1u, 2u}) {
        WorldOptions options{.walkers = 120, .seed = seed, .threads = 2};
        options.destinations = city->destinations;
        options.crossings = city->crossings;
        options.jaywalkers = 0;
        auto made = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
        ASSERT_TRUE(made) << made.error().message;
        World& w = **made;
        ASSERT_TRUE(set_loose(w, 6));
        const Crossing& crossing = city->crossings.all[0];
        // Of those on it: what its lamp showed as they came off the kerb, and whether they are told already.
        std::vector<Light> entered(w.crowd.count, Light::green);
        std::vector<uint8_t> was_on(w.crowd.count, 1), told(w.crowd.count, 1);
        for (uint32_t tick = 0; tick < 180 * 60; ++tick) {
            const Light light = lamp_at(city->crossings.plans[crossing.plan], w.tick).light;
            step(w);
            ASSERT_LE(deepest_overlap(w.crowd), k_most_overlap + 1e-3f);
            for (const WalkerId id : w.crowd.slots.living) {
                const uint32_t i = id.index;
                const OnCrossing on = on_crossing(crossing, on_ground(w.crowd.motion.position[i]));
                const float inside = crossing.half_length - std::fabs(on.over);
                const bool is_on =
                    inside > 0.05f && std::fabs(on.aside) < crossing.half_width + k_kerb_margin;
                if (is_on && was_on[i] == 0) entered[i] = light, told[i] = 0;
                was_on[i] = is_on;
                if (is_on && told[i] == 0 && inside > 1) {
                    told[i] = 1;
                    ++crossed;
                    red += entered[i] != Light::green;
                    if (is_creature(w.herd, i)) {
                        ++creatures;
                        EXPECT_EQ(entered[i], Light::green);
                    }
                }
                stuck += w.tick - w.crowd.journeys[i].closest_tick == 15 * 60 &&
                         w.tick >= w.crowd.journeys[i].pause_until;
            }
        }
    }
    std::printf("quayside: %u went over the ruled crossing, %u of them creatures; %u on red\n", crossed,
                creatures, red);
    EXPECT_GT(crossed, 25u);
    EXPECT_GT(creatures, 0u);
    EXPECT_LE(red, crossed / 20);
    EXPECT_EQ(stuck, 0u);
}

}  // namespace
}  // namespace flaneur
