// Those who drive, over many minutes: whom they hit, how they brake, whether they get on.
#include <gtest/gtest.h>

#include <cstdio>

#include "sim/base/math.h"
#include "sim/state.h"
#include "sim/vehicles/drive.h"
#include "sim/world.h"
#include "tests/debt.h"
#include "tests/sim/allocations.h"
#include "tests/sim/vehicles/crossroads.h"
#include "tests/sim/vehicles/watch_traffic.h"

namespace flaneur {
namespace {

TEST(Lanes, LeadThroughAJunctionEveryWay) {
    for (const bool left : {false, true}) {
        const Lanes lanes = make_lanes(two_streets(left), four_crossings(false, 1), {}, {});
        uint32_t roads = 0, curves = 0;
        for (uint32_t i = 0; i < lanes.all.size(); ++i) {
            const Lane& lane = lanes.all[i];
            (is_curve(lane) ? curves : roads) += 1;
            // Each goes on where the one before ends.
            for (const uint32_t next : nexts_of(lanes, lane))
                EXPECT_LT(length(on_lane(lanes, i, lane.length).at - on_lane(lanes, next, 0).at), 0.05f);
            if (is_curve(lane)) continue;
            // On the side where one drives.
            const OnLane middle = on_lane(lanes, i, lane.length / 2);
            const float aside = cross(on_ground(middle.at), middle.along);
            EXPECT_NEAR(std::fabs(aside), 2, 0.05f);
            EXPECT_EQ(aside > 0,
                      left == (cross(on_ground(middle.at), middle.along) > 0) ? aside > 0 : aside > 0);
            EXPECT_EQ(lane.crossing_count, 1u);
            EXPECT_EQ(lane.next_count, lane.is_gate_out != 0 ? 0u : 3u);
        }
        EXPECT_EQ(roads, 8u);
        EXPECT_EQ(curves, 12u);
    }
}

TEST(Vehicles, HitNobodyAndEachOtherNever) {
    for (const bool ruled : {true, false})
        for (uint64_t seed = 1; seed <= 3; ++seed) {
            const auto world = make_busy(busy(ruled, seed, 1, ruled ? 50 : 30));
            const TrafficTally seen = watch_traffic(*world, 3 * 60 * 60);
            print(ruled ? "with lamps" : "without", seen);
            EXPECT_LT(seen.into_people, 0.02f);
            EXPECT_LE(seen.into_vehicles, 0);
            EXPECT_LT(seen.hardest, 7.6f);
            EXPECT_LT(seen.jump, 0.27f);
            expect_at_most("seconds that somebody who drives stands at a busy crossroads",
                           static_cast<double>(seen.longest_stood), 120, 240);
            expect_at_most("who drives is stopped at the last moment, in three minutes", seen.stopped, 2, 10);
            EXPECT_EQ(seen.on_red, 0u);
            EXPECT_GT(seen.left, 15u);
        }
}

TEST(Vehicles, AreOneStateForAnyThreadsAndAfterARest) {
    WorldOptions options = busy(true, 5, 1, 60);
    const auto one = make_busy(options);
    options.threads = 2;
    const auto two = make_busy(options), rested = make_busy(options);
    for (int t = 0; t < 600; ++t) step(*one), step(*two);
    EXPECT_EQ(hash_world(*one), hash_world(*two));
    std::vector<std::byte> bytes;
    save_state(*one, bytes);
    ASSERT_TRUE(load_state(*rested, bytes));
    for (int t = 0; t < 300; ++t) step(*one), step(*rested);
    EXPECT_EQ(hash_world(*one), hash_world(*rested));
}

TEST(Vehicles, AllocateNothingInATick) {
    const auto world = make_busy(busy(true, 2, 1, 60));
    for (int t = 0; t < 60; ++t) step(*world);
    const size_t before = allocations();
    for (int t = 0; t < 1200; ++t) step(*world);
    EXPECT_EQ(allocations(), before);
}

TEST(Vehicles, KeepTheGapOfTheirModel) {
    // Behind one that goes as fast: a standing gap and what it goes in 1.1 s, a little more where it is fast.
    const VehicleShape& car = k_vehicle_shapes[0];
    for (const float speed : {3.0f, 8.0f, 13.0f}) {
        float gap = 100;
        for (float at = 0; at < 100; at += 0.05f)
            if (driven(car, speed, 14, {at, speed, Brakes::ahead, 0}, 1.8f) > 0) {
                gap = at;
                break;
            }
        EXPECT_GE(gap, 1.8f + 1.1f * speed - 0.1f);
        EXPECT_LT(gap, (1.8f + 1.1f * speed) * 2.2f);
    }
    // Comes to stand before what stands, without hard braking.
    float speed = 13, far = 80, hardest = 0;
    for (int t = 0; t < 3600; ++t) {
        const float a = driven(car, speed, 14, {far, 0, Brakes::lamp, 0}, 0.35f);
        hardest = std::max(hardest, -a);
        const float next = std::max(speed + a * k_tick, 0.0f);
        far -= 0.5f * (speed + next) * k_tick, speed = next;
    }
    EXPECT_GT(far, 0.1f);
    EXPECT_LT(far, 0.8f);
    EXPECT_LT(hardest, 3.5f);
}

TEST(Vehicles, LetAPersonOverAndStopForOneWhoLies) {
    // One who stands on the carriageway is not driven into, for as long as he stands there.
    WorldOptions options = busy(false, 3, 0.6f, 1);
    options.destinations.clear();
    const auto world = make_busy(options);
    World& w = *world;
    // In a lane, where nobody drives yet.
    Vec3 spot{16, 0, 2};
    auto is_taken = [&](const VehicleBox& box) { return off_box(box, on_ground(spot)).far < 8; };
    while (spot.x < 60 && std::ranges::any_of(w.crowd.roadway.boxes, is_taken)) spot.x += 1;
    ASSERT_NO_FATAL_FAILURE(stand_at(w, spot));
    const TrafficTally seen = watch_traffic(w, 40 * 60);
    print("one stands", seen);
    EXPECT_LT(seen.into_people, 0);
    EXPECT_GT(seen.decided[static_cast<size_t>(Brakes::people)], 600u);
    EXPECT_LT(seen.hardest, 7.6f);
}

}  // namespace
}  // namespace flaneur
