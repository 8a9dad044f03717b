// Trams: on their tracks, at their stops, among cars and people.
#include <gtest/gtest.h>

#include "sim/base/planar.h"
#include "sim/state.h"
#include "sim/vehicles/drive.h"
#include "tests/debt.h"
#include "tests/sim/allocations.h"
#include "tests/sim/vehicles/crossroads.h"
#include "tests/sim/vehicles/watch_traffic.h"

namespace flaneur {
namespace {

uint32_t add_node(RoadPlan& plan, Vec2 at, bool is_gate) {
    plan.nodes.push_back({at, is_gate});
    return static_cast<uint32_t>(plan.nodes.size() - 1);
}

void add_track(RoadPlan& plan, std::vector<Vec2> line) {
    const uint32_t from = add_node(plan, line.front(), true), to = add_node(plan, line.back(), true);
    plan.roads.push_back({.line = std::move(line), .from = from, .to = to, .width = 2.65f, .is_track = true});
}

// Both ways along one of the two streets, in the lanes that are there.
RoadPlan streets_with_tracks() {
    RoadPlan plan = two_streets();
    add_track(plan, {{-78, 2}, {78, 2}});
    add_track(plan, {{78, -2}, {-78, -2}});
    return plan;
}

constexpr float k_track = 34;  // x of the track below: off the squares where people stay

// A street, and a track on a bed of its own that bends by a quarter and crosses it.
RoadPlan street_and_bend(float radius) {
    RoadPlan plan;
    plan.nodes = {{{-78, 0}, true}, {{78, 0}, true}};
    plan.roads.push_back({.line = {{-78, 0}, {78, 0}}, .from = 0, .to = 1, .width = 2 * k_half});
    std::vector<Vec2> line{{k_track, -78}};
    for (int k = 0; k <= 24; ++k) {
        const SinCos at = sin_cos(0.5f * k_pi * static_cast<float>(k) / 24);
        line.push_back({k_track - radius * (1 - at.cosine), 15 + radius * at.sine});
    }
    line.push_back({-78, line.back().z});
    add_track(plan, std::move(line));
    return plan;
}

// Of a plan where nobody crosses by stripes.
WorldOptions without_crossings(const RoadPlan& plan, uint64_t seed, float traffic, uint32_t walkers) {
    WorldOptions options = busy(false, seed, traffic, walkers);
    options.crossings = {};
    options.lanes = make_lanes(plan, {}, {}, {});
    return options;
}

const Vehicle& first_tram(const World& w) { return w.vehicles.all[w.vehicles.first_tram]; }

float off_line(const Lanes& lanes, Vec2 p) {
    float least = 1e9f;
    for (const Lane& lane : lanes.all)
        for (uint32_t k = 0; lane.is_track && k + 1 < lane.count; ++k) {
            const Vec2 a = on_ground(lanes.places[lane.first + k]),
                       b = on_ground(lanes.places[lane.first + k + 1]);
            least = std::min(least, length(lerp(a, b, closest_on(a, b, p)) - p));
        }
    return least;
}

TEST(Tracks, AreCutWhereLanesCrossThem) {
    const Lanes lanes = make_lanes(streets_with_tracks(), four_crossings(false, 1), {}, {});
    uint32_t curves = 0, whole = 0;
    for (uint32_t i = 0; i < lanes.all.size(); ++i) {
        const Lane& lane = lanes.all[i];
        for (const uint32_t next : nexts_of(lanes, lane)) {
            EXPECT_EQ(lane.is_track, lanes.all[next].is_track);
            EXPECT_LT(length(on_lane(lanes, i, lane.length).at - on_lane(lanes, next, 0).at), 0.05f);
        }
        if (!lane.is_track) continue;
        (is_curve(lane) ? curves : whole) += 1;
        if (!is_curve(lane)) continue;
        // What goes straight across, and who turns left over it from ahead; not who goes along.
        uint32_t across = 0, along = 0;
        const Vec2 way = on_lane(lanes, i, lane.length / 2).along;
        for (const uint32_t other : conflicts_of(lanes, lane)) {
            EXPECT_FALSE(lanes.all[other].is_track);
            const auto back = conflicts_of(lanes, lanes.all[other]);
            EXPECT_NE(std::ranges::find(back, i), back.end());
            const float with = dot(way, on_lane(lanes, other, lanes.all[other].length / 2).along);
            across += std::fabs(with)<0.1f, along += std::fabs(with)> 0.95f;
        }
        EXPECT_EQ(across, 2u);
        EXPECT_EQ(along, 0u);
        EXPECT_GE(lane.conflict_count, 5u);
    }
    EXPECT_EQ(curves, 2u);
    EXPECT_EQ(whole, 4u);
    // A street that is crossed somewhere is cut there, in both its lanes.
    const Lanes bend = make_lanes(street_and_bend(50), {}, {}, {});
    for (const Lane& lane : bend.all) EXPECT_EQ(lane.conflict_count > 0, is_curve(lane));
    EXPECT_EQ(std::ranges::count_if(bend.all, [](const Lane& lane) { return is_curve(lane); }), 3);
    // Against the lanes of a street none is laid.
    RoadPlan against = two_streets();
    add_track(against, {{78, 2}, {-78, 2}});
    const Lanes none = make_lanes(against, {}, {}, {});
    EXPECT_TRUE(std::ranges::none_of(none.all, [](const Lane& lane) { return lane.is_track != 0; }));
    EXPECT_EQ(none.all.size(), make_lanes(two_streets(), {}, {}, {}).all.size());
}

TEST(Trams, KeepToTheirTracksInBends) {
    for (const float radius : {50.0f, 22.0f}) {
        const auto world = make_busy(without_crossings(street_and_bend(radius), 1, 0.3f, 0));
        World& w = *world;
        const Lanes& lanes = w.vehicles.map->lanes;
        const float length_of_one = 30.0f / k_tram_sections;
        // The middle of a section is inside of a bend by its chord's height.
        const float sagitta = length_of_one * length_of_one / (8 * radius);
        float joints = 0, middles = 0;
        uint32_t bent = 0, ticks = 0;
        for (int t = 0; t < 90 * 60; ++t) {
            step(w);
            if (!is_there(first_tram(w))) continue;
            const uint32_t first = first_section(w.vehicles, w.vehicles.first_tram);
            for (uint32_t s = 0; s < k_tram_sections; ++s) {
                const VehiclePlace& place = w.vehicles.places[first + s];
                if (place.presence <= 0) continue;
                const Vec2 middle = on_ground(place.middle), ahead = heading_direction(place.heading);
                for (const float end : {-0.5f, 0.5f})
                    joints = std::max(joints, off_line(lanes, middle + ahead * (end * length_of_one)));
                middles = std::max(middles, off_line(lanes, middle));
                bent += std::fabs(ahead.x) > 0.2f && std::fabs(ahead.z) > 0.2f;
            }
            ++ticks;
        }
        std::printf("radius %.0f m: joints %.3f m off, middles %.3f\n", wide(radius), wide(joints),
                    wide(middles));
        EXPECT_GT(ticks, 600u);
        EXPECT_GT(bent, 200u);
        EXPECT_LT(joints, 0.03f);
        EXPECT_LT(middles, sagitta + 0.03f);
        EXPECT_LT(middles, radius > 45 ? 0.1f : 0.25f);
    }
}

TEST(Trams, HaltWithTheirMiddleAtAStop) {
    RoadPlan plan = street_and_bend(50);
    plan.tram_stops = {{k_track + 3, -40}};
    const auto world = make_busy(without_crossings(plan, 2, 0.3f, 0));
    World& w = *world;
    uint32_t stood = 0, halts = 0;
    float hardest = 0, fastest = 0;
    for (int t = 0; t < 5 * 60 * 60; ++t) {
        step(w);
        const Vehicle& v = first_tram(w);
        if (!is_there(v)) continue;
        fastest = std::max(fastest, v.acceleration);
        if (v.speed > 0.2f && v.brakes == Brakes::stop) hardest = std::max(hardest, -v.acceleration);
        const bool stands = v.speed < 0.05f && v.brakes == Brakes::stop;
        stood = stands ? stood + 1 : 0;
        if (stood != 60) continue;
        ++halts;
        const uint32_t first = first_section(w.vehicles, w.vehicles.first_tram);
        EXPECT_NEAR(w.vehicles.places[first + k_tram_sections / 2].middle.z, -40, 2);
        const uint32_t since = v.stood_since;
        while (first_tram(w).speed < 0.05f) step(w);
        EXPECT_NEAR(static_cast<float>(w.tick - since) * k_tick, 20, 0.6f);
    }
    EXPECT_GT(halts, 1u);
    EXPECT_LE(fastest, 1);
    EXPECT_LT(hardest, 1.6f);
}

TEST(Trams, StopForOneWhoStandsOnTheRails) {
    RoadPlan plan = street_and_bend(50);
    plan.nodes[0].is_gate = plan.nodes[1].is_gate = false;  // no cars
    WorldOptions options = without_crossings(plan, 3, 0.3f, 1);
    options.destinations.clear();
    const auto world = make_busy(options);
    World& w = *world;
    ASSERT_NO_FATAL_FAILURE(stand_at(w, {k_track, 0, 3}));
    const TrafficTally seen = watch_traffic(w, 90 * 60);
    print("one stands on the rails", seen);
    EXPECT_LT(seen.into_people, 0);
    EXPECT_GT(seen.decided[static_cast<size_t>(Brakes::people)], 600u);
    EXPECT_LT(seen.hardest, 2.9f);
    EXPECT_EQ(seen.stopped, 0u);
    EXPECT_GT(first_tram(w).stood_since, 0u);
}

TEST(Trams, HitNobodyAmongCarsThatCross) {
    auto watch = [](const char* what, const WorldOptions& options) {
        const auto world = make_busy(options);
        const TrafficTally seen = watch_traffic(*world, 10 * 60 * 60);
        print(what, seen);
        EXPECT_LT(seen.into_people, 0.02f);
        EXPECT_LE(seen.into_vehicles, 0);
        EXPECT_EQ(seen.on_red, 0u);
        // Without tracks 121 to 336 s, as long.
        expect_at_most("seconds that somebody who drives stands beside trams",
                       static_cast<double>(seen.longest_stood), 120, 360);
        expect_at_most("who drives beside trams is stopped at the last moment, in ten minutes", seen.stopped,
                       6, 20);
        EXPECT_GT(seen.left, 50u);
    };
    watch("trams in a street with lamps", busy(true, 4, 1, 50, streets_with_tracks()));
    watch("without", busy(false, 4, 1, 30, streets_with_tracks()));
    watch("trams across a street", without_crossings(street_and_bend(30), 5, 1, 15));
}

TEST(Trams, AllocateNothingInATick) {
    const auto world = make_busy(busy(true, 2, 1, 60, streets_with_tracks()));
    for (int t = 0; t < 60; ++t) step(*world);
    const size_t before = allocations();
    for (int t = 0; t < 1200; ++t) step(*world);
    EXPECT_EQ(allocations(), before);
}

TEST(Trams, AreOneStateForAnyThreadsAndAfterARest) {
    WorldOptions options = busy(true, 5, 1, 60, streets_with_tracks());
    const auto one = make_busy(options);
    options.threads = 2;
    const auto two = make_busy(options), rested = make_busy(options);
    ASSERT_EQ(one->vehicles.all.back().kind, VehicleKind::tram);
    for (int t = 0; t < 900; ++t) step(*one), step(*two);
    EXPECT_EQ(hash_world(*one), hash_world(*two));
    std::vector<std::byte> bytes;
    save_state(*one, bytes);
    ASSERT_TRUE(load_state(*rested, bytes));
    for (int t = 0; t < 300; ++t) step(*one), step(*rested);
    EXPECT_EQ(hash_world(*one), hash_world(*rested));
}

}  // namespace
}  // namespace flaneur
