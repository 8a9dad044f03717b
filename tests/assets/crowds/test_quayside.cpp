// The square by the river: who is drunk stays on the quay, and nobody else staggers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "assets/quayside.h"
#include "sim/ways/platform.h"
#include "sim/world.h"

namespace flaneur {
namespace {

TEST(Quayside, DrunksStaggerWhileOthersStrollAndCreaturesAmongThem) {
    const auto city = std::make_shared<const City>(build_quayside(1));
    const Result<Platform> platform = make_platform(k_quay_platform);
    ASSERT_TRUE(platform);
    for (const uint64_t seed : {1u, 2u}) {
        WorldOptions options{.walkers = 80, .platform = k_quay_platform, .drunk = 0.85f, .drunks = 3};
        options.seed = seed;
        options.threads = 2;
        options.destinations = city->destinations;
        auto made = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
        ASSERT_TRUE(made) << made.error().message;
        World& w = **made;
        ASSERT_TRUE(set_loose(w, 2));
        float least = 9, way[2] = {}, wide[2] = {};
        uint32_t down = 0;
        for (uint32_t i = 0; i < 80; ++i) wide[i < 3] = std::max(wide[i < 3], drunk_of(w, i));
        EXPECT_EQ(wide[0], 0);
        EXPECT_EQ(wide[1], 0.85f);
        std::vector<Vec3> from = w.crowd.motion.position;
        std::vector<uint8_t> has_been_down(80, 0);
        for (int tick = 0; tick < 120 * 60; ++tick) {
            step(w);
            for (uint32_t i = 0; i < 80; ++i) {
                const Vec3 at = w.crowd.motion.position[i];
                if (i < 3) least = std::min(least, room_at(*platform, on_ground(at)));
                way[i < 3] += length(w.crowd.motion.velocity[i]) / 60;
                ASSERT_NE(w.crowd.motion.under[i].kind, Surface::water);
                ASSERT_GT(at.y, k_quay_height - 0.05f);
                ASSERT_LT(at.z, 24);
                if (at.y < k_quay_height + 0.05f && i >= 3) has_been_down[i] = 1;
            }
        }
        for (const uint8_t was : has_been_down) down += was;
        std::printf(
            "quayside: drunks are %.2f m off the platform at most, go %.0f m each; others %.0f m; %u were on "
            "the "
            "quay\n",
            -least, way[1] / 3, way[0] / 77, down);
        // Whoever comes their way moves them aside.
        EXPECT_GT(least, -1.5f);
        EXPECT_GT(way[1] / 3, 60);
        EXPECT_GT(way[0] / 77, 50);
        EXPECT_GT(down, 8u);
    }
}

}  // namespace
}  // namespace flaneur
