// Prams in narrow places and among others.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

WorldPtr world_with_prams(const Ground& ground) {
    WorldOptions options;
    options.capacity = 8;
    options.threads = 1;
    Kind pushes{standard_body(1.7f)};
    pushes.body.pram = standard_pram(pushes.body);
    options.kinds = {Kind{standard_body(1.7f)}, pushes};
    auto world = make_world_on(ground, options);
    EXPECT_TRUE(world) << (world ? "" : world.error().message);
    return std::move(*world);
}

WalkerId add(World& w, Vec3 place, uint32_t kind, float heading) {
    auto id = add_walker(w, {.place = place, .heading = heading, .kind = kind, .speed = 1.2f});
    EXPECT_TRUE(id) << (id ? "" : id.error().message);
    return *id;
}

// Seconds until it is where it is sent, or `most`.
float time_to(World& w, WalkerId who, Vec3 goal, float most) {
    const auto sent = send_to(w, who, goal);
    EXPECT_TRUE(sent) << (sent ? "" : sent.error().message);
    for (int tick = 0; tick < static_cast<int>(most * 60); ++tick) {
        if (has_arrived(w, who)) return static_cast<float>(tick) / 60;
        step(w);
    }
    return most;
}

// With a pram up against a wall, and somebody right beside it.
TEST(Prams, AreTurnedOnTheSpotPastWhoStandsBeside) {
    Ground ground = square(20);
    index_ground(ground);
    for (const float beside : {-0.66f, 0.66f}) {
        WorldPtr w = world_with_prams(ground);
        const WalkerId pushes = add(*w, {0, 0, 8.6f}, 1, 0);
        add(*w, {beside, 0, 9.5f}, 0, 0);
        EXPECT_LT(time_to(*w, pushes, {beside * 10, 0, 5}, 60), 30) << beside;
        EXPECT_LT(deepest_overlap(w->crowd), 0.05f);
    }
}

// Who pushes a pram that sticks out into the way of somebody who insists takes over that one's right to get
// on, however far back it stands itself.
TEST(Prams, WhoseStandsInTheWayInheritsTheRightOfWay) {
    Ground ground = square(20);
    index_ground(ground);
    for (const float aside : {0.0f, 3.0f}) {
        WorldPtr w = world_with_prams(ground);
        const WalkerId comes = add(*w, {0, 0, 0}, 0, 0),
                       pushes = add(*w, {1.2f + aside, 0, 0.7f}, 1, -k_pi / 2);
        ASSERT_TRUE(send_to(*w, comes, {0, 0, 8}));
        Journey& journey = w->crowd.journeys[comes.index];
        bool inherits = false;
        for (int tick = 0; tick < 60; ++tick) {
            journey.insists_since = 0;
            journey.insists_from = on_ground(w->crowd.motion.position[comes.index]);
            step(*w);
            const Claim& claim = w->crowd.decision.claim[pushes.index];
            inherits |= claim.since == 0 && claim.owner == comes.index;
        }
        EXPECT_EQ(inherits, aside == 0) << aside;
    }
}

// A dog-leg between walls, hardly wide enough for the mesh: round one corner and at once round the next.
TEST(Prams, GetThroughADogLeg) {
    for (const float wide : {1.6f, 1.8f, 2.2f}) {
        Ground ground;
        add_floor(ground, {-10, -10}, {10, 10}, 0, Surface::plaza);
        add_solid_box(ground, {-10, 0, -1}, {-wide, 3, 1});
        add_solid_box(ground, {-wide, 0, wide / 2}, {0, 3, 1});
        add_solid_box(ground, {wide, 0, -1}, {10, 3, 1});
        add_solid_box(ground, {0, 0, -1}, {wide, 3, -wide / 2});
        index_ground(ground);
        for (const float from : {-6.0f, 0.3f, 5.0f}) {
            WorldPtr w = world_with_prams(ground);
            const WalkerId pushes = add(*w, {from, 0, -6}, 1, 0);
            EXPECT_LT(time_to(*w, pushes, {from / 2, 0, 6}, 90), 60) << wide << " m, from " << from;
        }
    }
}

}  // namespace
}  // namespace flaneur
