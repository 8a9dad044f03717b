// Plans of lamps: who has green when, over many junctions.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/tick.h"
#include "sim/lamps/crossings.h"
#include "sim/lamps/lamps.h"

namespace flaneur {
namespace {

std::vector<LampPlan> junction(uint32_t n) {
    const RandomKey key{n, 7, 0, Purpose::city};
    std::vector<float> breadths(1 + n % 3);
    for (uint32_t k = 0; k < breadths.size(); ++k) breadths[k] = random_between(key, 4, 16, k);
    return plan_junction(breadths, {n, n, 0, Purpose::lamp});
}

TEST(Lamps, NobodyDrivesWhereOthersMayStillBe) {
    for (uint32_t n = 0; n < 200; ++n) {
        const auto plans = junction(n);
        const LampPlan& first = plans[0];
        ASSERT_GE(first.cycle, 60 / k_tick - k_lamp_ticks);
        ASSERT_LE(first.cycle, 90 / k_tick + k_lamp_ticks);
        std::vector<uint32_t> walks(plans.size(), 0), drives = walks;
        for (uint32_t tick = 0; tick < first.cycle; ++tick) {
            uint32_t driving = 0;
            for (size_t k = 0; k < plans.size(); ++k) {
                const Lamp walk = lamp_at(plans[k], tick), drive = lamp_of_drivers(plans[k], tick);
                ASSERT_EQ(plans[k].cycle, first.cycle);
                ASSERT_EQ(plans[k].shift, first.shift);
                walks[k] += walk.light == Light::green;
                drives[k] += drive.light == Light::green;
                driving += drive.light != Light::red;
                ASSERT_FALSE(walk.light == Light::green && drive.light != Light::red) << n;
            }
            ASSERT_LE(driving, 1u) << n;
        }
        for (size_t k = 0; k < plans.size(); ++k) {
            const float breadth = random_between({n, 7, 0, Purpose::city}, 4, 16, static_cast<uint32_t>(k));
            ASSERT_GE(static_cast<float>(clearance(plans[k])) * k_tick, breadth / k_clearing_speed);
            ASSERT_GE(static_cast<float>(walks[k]) * k_tick, 4);
            ASSERT_GE(static_cast<float>(drives[k]) * k_tick, 10);
        }
    }
}

TEST(Lamps, SayWhenTheyChangeAndSinceWhenTheyAreSo) {
    for (uint32_t n = 0; n < 30; ++n)
        for (const LampPlan& plan : junction(n))
            for (auto* of : {&lamp_at, &lamp_of_drivers}) {
                Lamp last = of(plan, 0);
                for (uint32_t tick = 1; tick < 2 * plan.cycle; ++tick) {
                    const Lamp now = of(plan, tick);
                    ASSERT_EQ(now.light != last.light, last.left == 1);
                    ASSERT_EQ(now.since, last.left == 1 ? 0 : last.since + 1);
                    ASSERT_EQ(now.left, last.left > 1 ? last.left - 1 : now.left);
                    ASSERT_GT(now.left, 0u);
                    last = now;
                }
            }
}

TEST(Crossings, PlacesComeBackFromWhereTheyAreOnThem) {
    for (uint32_t n = 0; n < 200; ++n) {
        auto between = [&](float low, float high, uint32_t k) {
            return random_between({n, 3, 0, Purpose::city}, low, high, k);
        };
        Crossing c;
        c.centre = {between(-50, 50, 0), 0, between(-50, 50, 1)};
        c.along = normalize_or(Vec2{between(-1, 1, 2), between(-1, 1, 3)}, {1, 0});
        const Vec2 square{-c.along.z, c.along.x};
        c.across = normalize_or(square + c.along * between(-1, 1, 4), square);
        c.half_length = between(2, 9, 5);
        const float over = between(-12, 12, 6), aside = between(-5, 5, 7);
        const OnCrossing on = on_crossing(c, on_ground(c.centre) + c.across * over + c.along * aside);
        ASSERT_NEAR(on.over, over, 2e-4f);
        ASSERT_NEAR(on.aside, aside, 2e-4f);
        for (const uint32_t kerb : {0u, 1u}) {
            const float back = between(0.1f, 3, 8);
            const Vec2 at = behind_kerb(c, kerb, back, aside);
            const float beyond = beyond_kerb(c, kerb, on_crossing(c, at));
            ASSERT_NEAR(beyond * dot(c.across, square), -back, 2e-3f);
            ASSERT_GT(dot(way_over(c, kerb), on_ground(c.centre) - at), 0);
        }
    }
}

TEST(Crossings, AreFoundWhereverTheirKerbsAreNear) {
    for (uint32_t n = 0; n < 20; ++n) {
        Crossings crossings;
        auto between = [&](float low, float high, uint32_t k) {
            return random_between({n, 5, 0, Purpose::city}, low, high, k);
        };
        for (uint32_t k = 0; k < 12; ++k) {
            Crossing c;
            c.centre = {between(-90, 90, 3 * k), 0, between(-90, 90, 3 * k + 1)};
            c.along = normalize_or(Vec2{between(-1, 1, 3 * k + 2), 0.5f}, {1, 0});
            c.across = {-c.along.z, c.along.x};
            crossings.all.push_back(c);
        }
        const std::vector<uint8_t> ruled{1, 1, 1, 0, 1, 1, 0, 1, 1, 1, 1, 1};
        set_lamps(crossings, ruled, n);
        const CrossingGrid grid = make_crossing_grid(crossings);
        for (uint32_t k = 0; k < 12; ++k) {
            const Crossing& c = crossings.all[k];
            ASSERT_EQ(is_ruled(c), ruled[k] != 0);
            for (uint32_t t = 0; t < 20; ++t) {
                const Vec2 at =
                    behind_kerb(c, t % 2, between(-3, k_kerb_reach - 0.1f, 100 + t), between(-2, 2, 200 + t));
                const auto near = crossings_near(grid, at);
                ASSERT_EQ(std::find(near.begin(), near.end(), k) != near.end(), is_ruled(c)) << n << ' ' << k;
            }
        }
    }
}

}  // namespace
}  // namespace flaneur
