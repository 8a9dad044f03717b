// Creatures of six legs among people, on streets, kerbs and steps: see test_creature.cpp for legs and
// trunks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

std::unique_ptr<World> world_on(Ground ground, uint64_t seed, int threads = 1) {
    index_ground(ground);
    WorldOptions options{.walkers = 12, .seed = seed, .threads = threads};
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    const Result<void> set = set_loose(**world, 3);
    EXPECT_TRUE(set) << set.error().message;
    return std::move(*world);
}

float off_the_ground(const World& w, const CreatureLeg& leg) {
    constexpr float k_look = 0.05f;
    const auto hit = raycast(*w.ground, leg.foot + leg.normal * k_look, -leg.normal, 2 * k_look);
    return hit ? std::fabs(hit->distance - k_look) : k_look;
}

TEST(Herd, WalksAmongPeopleWithItsFeetOnTheGround) {
    float off = 0, slid = 0, turned = 0, nearest = 10, way = 0;
    uint32_t on_kerbs = 0;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        const auto world = world_on(seed % 2 == 0 ? steps() : street(), seed);
        World& w = *world;
        ASSERT_EQ(people_count(w), 12u);
        for (uint32_t tick = 0; tick < 3600; ++tick) {
            const std::vector<Creature> before = w.herd.creatures;
            step(w);
            for (uint32_t n = 0; n < 3; ++n) {
                const Creature &was = before[n], &is = w.herd.creatures[n];
                turned = std::max(turned, arccos(std::min(dot(was.up, is.up), 1.0f)) / k_tick);
                way += w.herd.walkers.moved[n];
                float low = 1e9f, high = -1e9f;
                for (int leg = 0; leg < k_creature_legs; ++leg) {
                    const CreatureLeg &a = was.legs[leg], &b = is.legs[leg];
                    if (a.swing == 1 && b.swing == 1) slid = std::max(slid, length(a.foot - b.foot));
                    if (b.swing < 1) continue;
                    off = std::max(off, off_the_ground(w, b));
                    low = std::min(low, b.foot.y), high = std::max(high, b.foot.y);
                }
                on_kerbs += high - low > 0.1f;
                const uint32_t own = w.herd.goes_as[n];
                for (uint32_t i = 0; i < w.crowd.count; ++i)
                    if (i != own)
                        nearest = std::min(nearest,
                                           length(w.crowd.motion.position[i] - w.crowd.motion.position[own]) -
                                               w.crowd.identity.radius[i]);
            }
        }
    }
    std::printf(
        "herd: feet %.4f m off, slide %.4f; up turns %.2f rad/s; %.2f m from the nearest; %.0f m in all; "
        "%u times on two levels\n",
        off, slid, turned, nearest, way, on_kerbs);
    EXPECT_LT(off, 0.005f);
    EXPECT_EQ(slid, 0);
    EXPECT_LT(turned, 2.05f);
    EXPECT_GT(nearest, k_widest_radius - 0.05f);
    EXPECT_GT(way, 150);
    EXPECT_GT(on_kerbs, 100u);
}

TEST(Herd, IsTheSameOnEveryNumberOfThreadsAndFromAState) {
    const auto one = world_on(street(), 5, 1), three = world_on(street(), 5, 3),
               late = world_on(street(), 5, 2);
    std::vector<std::byte> bytes;
    for (int tick = 0; tick < 600; ++tick) {
        step(*one), step(*three);
        if (tick == 299) save_state(*one, bytes);
    }
    ASSERT_TRUE(load_state(*late, bytes));
    for (int tick = 300; tick < 600; ++tick) step(*late);
    EXPECT_EQ(one->linkages.places, three->linkages.places);
    EXPECT_EQ(one->linkages.places, late->linkages.places);
    EXPECT_EQ(hash_world(*one), hash_world(*three));
    EXPECT_EQ(hash_world(*one), hash_world(*late));
}

TEST(Herd, StaysWhereOthersLeave) {
    Ground ground = street();
    index_ground(ground);
    Leaving leaving;
    leaving.fill(1);
    WorldOptions options{.capacity = 40, .walkers = 12, .seed = 3, .threads = 1, .leaving = leaving};
    for (const float x : {-30.0f, 0.0f, 30.0f})
        options.destinations.push_back({DestinationKind::edge, {x, 0.12f, 6}, {0, 1}});
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_TRUE(set_loose(**world, 2));
    for (int tick = 0; tick < 7200; ++tick) step(**world);
    EXPECT_GT(coming_count(**world).left, 5u);
    for (const uint32_t i : (*world)->herd.goes_as) EXPECT_TRUE(is_there((*world)->crowd, i));
}

}  // namespace
}  // namespace flaneur
