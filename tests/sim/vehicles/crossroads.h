// Two streets that cross, with those who drive and walk there.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {

inline constexpr float k_half = 4, k_out = 80;  // metres: of a carriageway, to the map's edges

// Two streets that cross, with pavements at the corners, level with them.
inline Ground crossroads() {
    constexpr float k_from = 7, k_to = 11;  // of crossings
    Ground ground;
    ground.name = "crossroads";
    add_floor(ground, {-k_half, -k_half}, {k_half, k_half}, 0, Surface::road);
    for (const float side : {-1.0f, 1.0f}) {
        auto along = [&](float from, float to, Surface kind) {
            const float low = side > 0 ? from : -to, high = side > 0 ? to : -from;
            add_floor(ground, {low, -k_half}, {high, k_half}, 0, kind);
            add_floor(ground, {-k_half, low}, {k_half, high}, 0, kind);
        };
        along(k_half, k_from, Surface::road);
        along(k_from, k_to, Surface::crossing);
        along(k_to, k_out, Surface::road);
        for (const float to : {-1.0f, 1.0f})
            add_floor(ground, {to > 0 ? k_half : -k_out, side > 0 ? k_half : -k_out},
                      {to > 0 ? k_out : -k_half, side > 0 ? k_out : -k_half}, 0, Surface::sidewalk);
    }
    index_ground(ground);
    return ground;
}

inline Crossings four_crossings(bool ruled, uint64_t seed) {
    constexpr float k_off = 9;
    Crossings c;
    for (const float side : {-1.0f, 1.0f}) {
        c.all.push_back({{side * k_off, 0, 0}, {0, 1}, {1, 0}, k_half, 2});
        c.all.push_back({{0, 0, side * k_off}, {1, 0}, {0, 1}, k_half, 2});
    }
    const uint8_t all[] = {1, 1, 1, 1};
    if (ruled) set_lamps(c, all, seed);
    return c;
}

inline RoadPlan two_streets(bool drives_left = false) {
    RoadPlan plan;
    plan.drives_left = drives_left;
    plan.nodes = {{{0, 0}, false}, {{-78, 0}, true}, {{78, 0}, true}, {{0, -78}, true}, {{0, 78}, true}};
    for (uint32_t n = 1; n < 5; ++n)
        plan.roads.push_back(
            {.line = {plan.nodes[0].at, plan.nodes[n].at}, .from = 0, .to = n, .width = 2 * k_half});
    return plan;
}

inline WorldOptions busy(bool ruled, uint64_t seed, float traffic, uint32_t walkers,
                         const RoadPlan& plan = two_streets()) {
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = 1};
    for (const float x : {-20.0f, 20.0f})
        for (const float z : {-20.0f, 20.0f})
            options.destinations.push_back(
                {DestinationKind::square, {x, 0, z}, {x > 0 ? 1.0f : -1.0f, 0}, 1});
    options.crossings = four_crossings(ruled, seed);
    options.lanes = make_lanes(plan, options.crossings, {}, {});
    options.traffic = traffic;
    return options;
}

inline std::unique_ptr<World> make_busy(const WorldOptions& options) {
    auto world = make_world(std::make_shared<const Ground>(crossroads()), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

// Its first walker stands at a place for good; where it cannot, the test fails.
inline void stand_at(World& w, Vec3 spot) {
    const auto place = nearest(*w.navmesh, 0, spot);
    ASSERT_TRUE(place);
    w.crowd.motion.position[0] = spot;
    w.crowd.motion.polygon[0] = place->polygon;
    w.crowd.journeys[0] = {};
    w.crowd.journeys[0].errand = Errand::arrive;
}

}  // namespace flaneur
