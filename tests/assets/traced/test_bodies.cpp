// Bodies in the place and on the ways that are made of a recording.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/traced/hall.h"
#include "assets/traced/ways.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/world.h"

using namespace flaneur;

namespace {

std::unique_ptr<World> world_of(const Trajectories& t) {
    auto traces = std::make_shared<const Traces>(make_ways(t).traces);
    WorldOptions options;
    options.capacity = traces->most;
    options.kinds = {{standard_body(1.7f)}};
    auto made = make_world(std::make_shared<const Ground>(build_hall(t, "made").ground), options);
    EXPECT_TRUE(made) << made.error().message;
    follow_traces(**made, std::move(traces));
    return std::move(*made);
}

// How often feet leave the ground until a tick.
int steps_until(World& w, uint32_t tick) {
    int steps = 0;
    bool swung[2] = {};
    while (w.tick < tick) {
        step(w);
        for (const Side side : {k_left, k_right}) {
            const bool swings = w.gait.blocks[0].feet[side].swinging[0] != 0;
            steps += swings && !swung[side];
            swung[side] = swings;
        }
    }
    return steps;
}

}  // namespace

TEST(Bodies, NoiseMakesNobodyStep) {
    Trajectories t;
    for (uint32_t f = 0; f <= 500; ++f) {
        const RandomKey key{3, f, 0, Purpose::spawn};
        t.sightings.push_back(
            {f, 1, Vec2{0.015f * random_normal(key), 0.015f * random_normal(key, 1)}, 0, {}});
    }
    const auto w = world_of(t);
    EXPECT_LE(steps_until(*w, 20 * 60), 1);  // who stands long shifts a foot now and then
}

TEST(Bodies, WhoWalksStepsAsOftenAsPeopleDo) {
    Trajectories t;
    for (uint32_t f = 0; f <= 250; ++f)
        t.sightings.push_back({f, 1, {0.052f * static_cast<float>(f), 0}, 0, {}});
    const auto w = world_of(t);
    EXPECT_NEAR(steps_until(*w, 600), 19, 2);  // 1.3 m/s
}

TEST(Bodies, WhoClimbsIsOnTheGroundThatWaysTell) {
    Trajectories t;
    t.heights = HeightsOf::ground;
    for (uint32_t f = 0; f <= 250; ++f) {
        const float x = 0.03f * static_cast<float>(f);
        t.sightings.push_back({f, 1, {x, 0}, 0.4f * x, {}});
        t.sightings.push_back({f, 2, {x, 0}, -3, {}});
    }
    const auto w = world_of(t);
    for (int tick = 0; tick < 580; ++tick) {
        step(*w);
        for (const WalkerId id : w->crowd.slots.living) {
            const Vec3 at = w->crowd.motion.position[id.index];
            const bool climbs = w->traced.traces->ways[w->traced.way_of[id.index]].id == 1;
            if (at.x < 0.5f || at.x > 7) continue;
            EXPECT_NEAR(at.y, climbs ? 0.4f * at.x : -3, 0.1f);
        }
    }
}
