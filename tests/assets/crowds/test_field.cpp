// People on the walled field, who find their ways by rays alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/stages/field.h"
#include "sim/world.h"

namespace flaneur {
namespace {

// Nobody touches walls, pillars, the block or another.
void expect_no_collision(LimbLead limbs, int minutes, float least_speed) {
    const City city = build_field(1);
    auto ground = std::make_shared<const Ground>(city.ground);
    WorldOptions options;
    options.walkers = 30;
    options.threads = 2;
    options.habit = Habit::ramble;
    options.limbs = limbs;
    for (const float height : {1.3f, 1.6f, 1.86f}) options.kinds.push_back({standard_body(height)});
    auto world = make_world(ground, options);
    ASSERT_TRUE(world) << world.error().message;
    World& w = **world;
    constexpr float k_body = 0.2f;  // metres from a walker's middle to a wall
    float deepest = 0, went = 0;
    for (int tick = 0; tick < minutes * 60 * 60; ++tick) {
        step(w);
        deepest = std::max(deepest, deepest_overlap(w.crowd));
        for (uint32_t i = 0; i < w.crowd.count; ++i) went += length(w.crowd.motion.velocity[i]) / 60;
        if (tick % 4 != 0) continue;
        for (uint32_t i = 0; i < w.crowd.count; ++i) {
            const Vec3 place = w.crowd.motion.position[i];
            ASSERT_FALSE(closest_wall(*ground, place + Vec3{0, 1, 0}, k_body))
                << "walker " << i << ", tick " << tick;
            ASSERT_LT(std::max(std::fabs(place.x), std::fabs(place.z)), k_field_half - k_body);
        }
    }
    EXPECT_LT(deepest, 0.05f);
    const float speed = went / static_cast<float>(minutes * 60 * 30);
    EXPECT_GT(speed, least_speed) << "m/s: they walk on and on";
    std::printf("thirty people for %d minutes: %.3f m into each other at most, %.2f m/s\n", minutes,
                static_cast<double>(deepest), static_cast<double>(speed));
}

TEST(Rambling, ForTenMinutesNobodyTouchesAnything) { expect_no_collision(LimbLead::gait, 10, 0.9f); }
TEST(Rambling, NorDoesWhoTurnsSlowlyAtThePaceOfCurves) { expect_no_collision(LimbLead::curves, 5, 0.4f); }

}  // namespace
}  // namespace flaneur
