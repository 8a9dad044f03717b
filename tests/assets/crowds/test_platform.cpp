// People who stagger on platforms, their bodies and feet too.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/scene.h"
#include "assets/stages/platform.h"
#include "sim/base/math.h"
#include "sim/ways/platform.h"
#include "sim/world.h"

namespace flaneur {
namespace {

WorldOptions staggering(uint32_t walkers, const std::vector<Vec2>& outline, float drunk) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = 2;
    options.habit = Habit::stagger;
    options.platform = outline;
    options.drunk = drunk;
    options.navmesh.agent_radius = k_off_the_edge;
    for (const float height : {1.58f, 1.7f, 1.86f}) options.kinds.push_back({standard_body(height)});
    return options;
}

// The least room that soles had to the edge, metres, and whose way was as good as straight for two seconds,
// of all ways of two seconds.
struct Told {
    float least_room = 9, straight = 0;
};
Told watch(World& w, const Platform& platform, int seconds) {
    Told told;
    std::vector<Vec2> before(w.crowd.count);
    size_t ways = 0, straight = 0;
    for (int tick = 0; tick < seconds * 60; ++tick) {
        step(w);
        for (uint32_t i = 0; i < w.crowd.count; ++i) {
            for (const Joint toes : {left_toes, right_toes}) {
                const Vec2 foot = on_ground(joint_between(w, i, toes, 1).position);
                told.least_room = std::min(told.least_room, room_at(platform, foot));
            }
            if (tick % 120 != 0) continue;
            const Vec2 velocity = w.crowd.motion.velocity[i];
            if (length(velocity) > 0.5f && length(before[i]) > 0.5f) {
                const float turned = wrap_angle(heading_of(velocity) - heading_of(before[i]));
                ++ways, straight += std::fabs(turned) < 0.5f * k_radians;
            }
            before[i] = velocity;
        }
    }
    told.straight = static_cast<float>(straight) / static_cast<float>(std::max<size_t>(ways, 1));
    return told;
}

TEST(Staggering, BodiesStayOnAnyPlatformAndNeverGoStraight) {
    const std::vector<Vec2> outlines[] = {
        k_usual_platform, {{-4, -3}, {5, -2}, {0, 6}}, {{0, 0}, {20, 3}, {26, 14}, {12, 22}, {-3, 12}}};
    for (const std::vector<Vec2>& outline : outlines)
        for (const float drunk : {0.0f, 1.0f}) {
            const Result<City> city = build_platform(outline);
            ASSERT_TRUE(city);
            const uint32_t walkers = outline.size() == 3 ? 6 : 40;
            auto world =
                make_world(std::make_shared<const Ground>(city->ground), staggering(walkers, outline, drunk));
            ASSERT_TRUE(world) << world.error().message;
            const Told told = watch(**world, *make_platform(outline), 90);
            EXPECT_GT(told.least_room, 0) << told_platform(outline);
            EXPECT_LT(told.straight, 0.03f) << told_platform(outline);
            std::printf(
                "%s, drunk %.0f: feet keep %.2f m from the edge, %.1f %% of ways of 2 s are straight\n",
                told_platform(outline).c_str(), static_cast<double>(drunk),
                static_cast<double>(told.least_room), 100 * static_cast<double>(told.straight));
        }
}

// Who is drunk steps wider, and less like the step before; and the same drunk is the same on any threads.
TEST(Staggering, DrinkIsSeenInTheSteps) {
    float wide[2];
    for (const bool is_drunk : {false, true}) {
        const Result<City> city = build_platform(k_usual_platform);
        auto world = make_world(std::make_shared<const Ground>(city->ground),
                                staggering(12, k_usual_platform, is_drunk ? 1.0f : 0.0f));
        ASSERT_TRUE(world);
        World& w = **world;
        double apart = 0;
        int count = 0;
        for (int tick = 0; tick < 60 * 60; ++tick) {
            step(w);
            for (uint32_t i = 0; i < w.crowd.count; ++i) {
                if (length(w.crowd.motion.velocity[i]) < 0.7f) continue;
                const Vec3 feet =
                    joint_between(w, i, left_foot, 1).position - joint_between(w, i, right_foot, 1).position;
                apart += std::fabs(dot(on_ground(feet), right_of(w.crowd.motion.heading[i])));
                ++count;
            }
        }
        wide[is_drunk] = static_cast<float>(apart / count);
    }
    std::printf("ankles are %.3f m apart to the side, drunk %.3f\n", static_cast<double>(wide[0]),
                static_cast<double>(wide[1]));
    EXPECT_GT(wide[1], wide[0] * 1.35f);
}

TEST(Staggering, RefusesAPlatformThatIsNotThere) {
    const Result<City> city = build_platform(k_usual_platform);
    auto world = make_world(std::make_shared<const Ground>(city->ground),
                            staggering(3, {{50, 0}, {60, 0}, {50, 9}}, 0));
    EXPECT_FALSE(world);
}

}  // namespace
}  // namespace flaneur
