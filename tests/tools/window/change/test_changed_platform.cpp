// A platform whose outline changes while people stagger on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/stages/platform.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/rng.h"
#include "sim/ways/platform.h"
#include "tools/flaneur/window/change/making.h"
#include "tools/flaneur/window/change/platform.h"

namespace flaneur {
namespace {

struct Stage {
    std::shared_ptr<const City> city;
    std::unique_ptr<World> world;
    std::vector<Vec2> ground;
};

Stage stage(uint32_t walkers, uint64_t seed) {
    Stage s;
    s.ground = k_usual_platform;
    s.city = std::make_shared<const City>(*build_platform(s.ground));
    WorldOptions options;
    options.walkers = walkers;
    options.threads = 2;
    options.seed = seed;
    options.habit = Habit::stagger;
    options.platform = s.ground;
    options.navmesh.agent_radius = k_off_the_edge;
    for (const float height : {1.58f, 1.7f, 1.86f}) options.kinds.push_back({standard_body(height)});
    auto world = make_world({s.city, &s.city->ground}, options);
    EXPECT_TRUE(world) << world.error().message;
    s.world = std::move(*world);
    return s;
}

// What the window does once a frame.
void carry(Stage& s, const std::vector<Vec2>& wanted) {
    const PlatformStep step = next_step(*s.world, s.ground, wanted);
    if (step.is_for_circles) {
        const Result<void> done = change_platform(*s.world, wanted);
        ASSERT_TRUE(done) << done.error().message;
    }
    // Making a city takes a while.
    if (step.ground.empty() || s.world->tick % 15 != 0) return;
    City city = *build_platform(step.ground);
    const auto next = std::make_shared<const City>(std::move(city));
    const Rectangle areas[] = {area_about(s.ground, step.ground)};
    const Ground& before = s.city->ground;
    auto mesh = rebuild_navmesh(next->ground, settings_of(*s.world->navmesh),
                                navmesh_bytes(*s.world->navmesh), before.low, before.high, areas, 1);
    ASSERT_TRUE(mesh) << mesh.error().message;
    if (step.ground == wanted && !holds_everybody(*s.world, **mesh)) return;
    change_ground(*s.world, {next, &next->ground}, std::move(*mesh), {}, areas);
    s.city = next;
    s.ground = step.ground;
}

std::vector<Vec2> another(const World& world, const std::vector<Vec2>& now, RandomKey key) {
    for (uint32_t attempt = 0; attempt < 200; ++attempt) {
        key.when = attempt;
        std::vector<Vec2> next = now;
        const float kind = random_unit(key, 0);
        if (kind < 0.3f)
            next = turned_outline(now, 1, random_between(key, -k_pi, k_pi, 1));
        else if (kind < 0.6f)
            next = turned_outline(now, random_between(key, 0.5f, 1.8f, 1), 0);
        else if (kind < 0.75f)
            next = even_outline(now, 3 + static_cast<int>(random_unit(key, 1) * 13));
        else {
            Vec2& corner =
                next[static_cast<size_t>(random_unit(key, 1) * 0.999f * static_cast<float>(next.size()))];
            corner += Vec2{random_between(key, -8, 8, 2), random_between(key, -8, 8, 3)};
        }
        const double area = std::fabs(signed_area_of(next));
        if (area > 120 && area < 4000 && why_not(world, next).empty()) return next;
    }
    return now;
}

TEST(ChangedPlatform, NobodyLeavesItWhileItChanges) {
    float least = 9, least_before = 9;
    uint32_t changes = 0, on = 0, never_done = 0;
    for (const uint64_t seed : {1, 2}) {
        Stage s = stage(16, seed);
        std::vector<Vec2> wanted = s.ground;
        for (uint32_t n = 0; n < 12; ++n) {
            wanted = another(*s.world, wanted, {seed, n, 0, Purpose::city});
            const Platform then = *make_platform(wanted);
            ++changes;
            std::vector<uint8_t> had_room(s.world->crowd.count);
            for (uint32_t i = 0; i < s.world->crowd.count; ++i)
                had_room[i] = room_at(then, on_ground(s.world->crowd.motion.position[i])) > 1.6f;
            for (int tick = 0; tick < 60 * 6; ++tick) {
                carry(s, wanted);
                if (HasFatalFailure()) return;
                step(*s.world);
                const Platform ground = *make_platform(s.ground);
                for (uint32_t i = 0; i < s.world->crowd.count; ++i) {
                    const Vec3 place = s.world->crowd.motion.position[i];
                    least = std::min(least, room_at(ground, on_ground(place)));
                    ASSERT_NEAR(place.y, 0, 0.05f) << "in the water";
                    if (!had_room[i]) continue;
                    // On what it was on before, and on what is wanted.
                    ++on;
                    least_before = std::min(least_before, room_at(then, on_ground(place)));
                }
            }
            never_done += s.ground != wanted;
        }
    }
    std::printf(
        "%u changes: nobody nearer than %.2f m to the edge of the ground, nor than %.2f m to the wanted one "
        "who had room on it; %u not done in six seconds\n",
        changes, static_cast<double>(least), static_cast<double>(least_before), never_done);
    EXPECT_GT(on, 5000u);
    EXPECT_GT(least, 0.05f);
    EXPECT_GT(least_before, 0.05f);
    EXPECT_LT(never_done, changes / 4);
}

TEST(ChangedPlatform, CirclesThatNoLongerHoldAreReplacedAtOnce) {
    Stage s = stage(24, 4);
    for (int tick = 0; tick < 300; ++tick) step(*s.world);
    const std::vector<Vec2> wanted = turned_outline(s.ground, 0.75f, 0.5f);
    uint32_t lost = 0;
    for (int tick = 0; tick < 24; ++tick) carry(s, wanted), step(*s.world);
    const Platform then = *make_platform(wanted);
    for (const Wayfarer& way : s.world->crowd.wayfarers)
        lost += room_at(then, way.stride.centre) < way.stride.radius - 0.01f;
    EXPECT_EQ(lost, 0u);
}

TEST(ChangedPlatform, OutlinesAboutTwoHoldBoth) {
    for (uint32_t n = 0; n < 300; ++n) {
        auto some = [&](uint32_t k) {
            const RandomKey key{n, k, 0, Purpose::city};
            return turned_outline(
                even_outline(k_usual_platform, 3 + static_cast<int>(random_unit(key) * 13.9f)),
                random_between(key, 0.3f, 3, 1), random_between(key, -3, 3, 2));
        };
        const std::vector<Vec2> a = some(0), b = some(1), both = outline_about(a, b);
        const Result<Platform> platform = make_platform(both);
        ASSERT_TRUE(platform) << platform.error().message;
        for (const std::vector<Vec2>* outline : {&a, &b})
            for (const Vec2 p : *outline) EXPECT_GT(room_at(*platform, p), -0.01f);
    }
}

}  // namespace
}  // namespace flaneur
