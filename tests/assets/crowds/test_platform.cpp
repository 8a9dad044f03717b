// People who stagger on platforms, their bodies and feet too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/scene.h"
#include "assets/stages/platform.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
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
    const std::vector<Vec2> outlines[] = {k_usual_platform,
                                          {{-4, -3}, {5, -2}, {0, 6}},
                                          {{0, 0}, {20, 3}, {26, 14}, {12, 22}, {-3, 12}},
                                          {{0, 0}, {20, 0}, {10, 30}},  // 37 degrees
                                          {{0, 0}, {40, 7}, {41, 0}},   // 10 degrees
                                          {{-9, 0}, {0, -3}, {9, 0}, {0, 3}}};
    for (const std::vector<Vec2>& outline : outlines)
        for (const float drunk : {0.0f, 1.0f}) {
            const Result<City> city = build_platform(outline);
            ASSERT_TRUE(city);
            const uint32_t walkers = outline.size() == 5 || outline == k_usual_platform ? 40 : 6;
            auto world =
                make_world(std::make_shared<const Ground>(city->ground), staggering(walkers, outline, drunk));
            ASSERT_TRUE(world) << world.error().message;
            const Told told = watch(**world, *make_platform(outline), 90);
            EXPECT_GT(told.least_room, 0) << told_corners(outline);
            EXPECT_LT(told.straight, 0.03f) << told_corners(outline);
            std::printf(
                "%s, drunk %.0f: feet keep %.2f m from the edge, %.1f %% of ways of 2 s are straight\n",
                told_corners(outline).c_str(), static_cast<double>(drunk),
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

// Whichever way it lies among the voxels of the mesh.
TEST(Staggering, SharpCornersAreNoReasonToRefuse) {
    uint32_t made = 0;
    for (uint32_t n = 0; n < 24; ++n) {
        const RandomKey key{17, n, 0, Purpose::city};
        const float turn = random_between(key, 0, 2 * k_pi, 0), far = random_between(key, 25, 60, 1);
        const float half = random_between(key, 4, 25, 2) * k_radians;
        const Vec2 tip{random_between(key, -20, 20, 3), random_between(key, -20, 20, 4)};
        const std::vector<Vec2> outline{tip, tip + heading_direction(turn - half) * far,
                                        tip + heading_direction(turn + half) * far};
        const Result<City> city = build_platform(outline);
        ASSERT_TRUE(city) << city.error().message;
        auto world = make_world(std::make_shared<const Ground>(city->ground), staggering(3, outline, 0));
        ASSERT_TRUE(world) << world.error().message << " " << told_corners(outline);
        ++made;
    }
    EXPECT_EQ(made, 24u);
}

std::string refusal_of(const std::vector<Vec2>& outline, uint32_t walkers, Habit habit, bool has_pram) {
    const Result<City> city = build_platform(outline);
    if (!city) return city.error().message;
    WorldOptions options = staggering(walkers, outline, 0);
    options.habit = habit;
    if (has_pram) {
        Kind pushes{standard_body(1.7f)};
        pushes.body.pram = standard_pram(pushes.body);
        options.kinds = {pushes};
    }
    auto world = make_world(std::make_shared<const Ground>(city->ground), options);
    return world ? "" : world.error().message;
}

TEST(Staggering, TooNarrowIsSaidInOneSentence) {
    std::string first;
    for (const float wide : {0.5f, 1.1f, 1.5f})
        for (const Habit habit : {Habit::wander, Habit::stagger}) {
            const std::string said = refusal_of({{0, 0}, {40, 0}, {40, wide}, {0, wide}}, 3, habit, false);
            if (first.empty()) first = said;
            EXPECT_NE(said.find("no ground that a walker can stand on"), std::string::npos) << said;
            EXPECT_EQ(said, first) << wide;
        }
}

// It says what is wide enough for everybody.
TEST(Staggering, APlatformTooNarrowToTurnOnIsToldHowWide) {
    auto strip = [](float wide) { return std::vector<Vec2>{{0, 0}, {40, 0}, {40, wide}, {0, wide}}; };
    for (const bool has_pram : {false, true}) {
        const std::string said = refusal_of(strip(2.2f), 12, Habit::stagger, has_pram);
        EXPECT_NE(said.find(has_pram ? "to turn on with a pram" : "to turn on at "), std::string::npos)
            << said;
        const size_t at = said.find("a circle ");
        ASSERT_NE(at, std::string::npos) << said;
        const float wide = std::stof(said.substr(at + 9));
        EXPECT_EQ(refusal_of(strip(wide), 12, Habit::stagger, has_pram), "") << wide;
        EXPECT_EQ(refusal_of(strip(wide - 0.2f), 12, Habit::stagger, has_pram), said) << wide;
        std::printf("%s\n", said.c_str());
    }
}

// However many are asked for.
TEST(Platform, AsManyAsItSaysFit) {
    const std::vector<Vec2> square{{0, 0}, {6, 0}, {6, 6}, {0, 6}};
    uint32_t most = 0;
    for (const uint32_t walkers : {73u, 999u, 5000u, 200'000u}) {
        const std::string said = refusal_of(square, walkers, Habit::wander, false);
        uint32_t fit = 0, of = 0;
        ASSERT_EQ(
            std::sscanf(said.c_str(), "Only %u of %u walkers fit on the ground of 'platform'", &fit, &of), 2)
            << said;
        EXPECT_EQ(of, walkers);
        if (most == 0) most = fit;
        EXPECT_EQ(fit, most);
    }
    EXPECT_EQ(refusal_of(square, most, Habit::wander, false), "");
    EXPECT_NE(refusal_of(square, most + 1, Habit::wander, false), "");
}

TEST(Staggering, RefusesAPlatformThatIsNotThere) {
    const Result<City> city = build_platform(k_usual_platform);
    auto world = make_world(std::make_shared<const Ground>(city->ground),
                            staggering(3, {{50, 0}, {60, 0}, {50, 9}}, 0));
    EXPECT_FALSE(world);
}

}  // namespace
}  // namespace flaneur
