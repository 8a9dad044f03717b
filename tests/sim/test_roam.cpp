// People on a compound: their feet stay where they are put, on its surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/world.h"
#include "tests/sim/allocations.h"

namespace flaneur {
namespace {

Ground level_stage() {
    Ground ground;
    ground.vertices = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    ground.indices = {0, 1, 2, 0, 2, 3};
    ground.kinds.assign(2, Surface::plaza);
    index_ground(ground);
    return ground;
}

std::unique_ptr<World> roaming(Compound compound, uint32_t walkers, int threads) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = threads;
    auto world = make_world(std::make_shared<Ground>(level_stage()), options);
    EXPECT_TRUE(world) << world.error().message;
    Result<void> set = set_down(**world, std::move(compound));
    EXPECT_TRUE(set) << set.error().message;
    return std::move(*world);
}

Vec3 on_surface(const World& w, size_t walker, Vec3 p) {
    return set_onto(w.roam->frames[walker], w.crowd.motion.position[walker], w.crowd.motion.heading[walker],
                    {p, {}})
        .position;
}

TEST(Roam, FeetStayOnTheSurfaceAndWhereTheyArePut) {
    constexpr float k_radius = 12;
    constexpr uint32_t k_walkers = 12;
    Compound ball;
    ball.spheres.push_back({{1, 2, 3}, k_radius});
    auto w = roaming(ball, k_walkers, 1);
    std::vector<Vec3> before(2 * k_walkers);
    std::vector<uint8_t> stood(2 * k_walkers, 0);
    float slide = 0, off = 0, way = 0;
    for (int tick = 0; tick < 600; ++tick) {
        step(*w);
        for (size_t i = 0; i < k_walkers; ++i) {
            way += w->roam->walkers.moved[i];
            for (Side side : {k_left, k_right}) {
                size_t n = 2 * i + static_cast<size_t>(side);
                bool stands = w->gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0;
                Sole s = sole(w->poses, w->gait, i, side);
                Vec3 ball_of_foot = on_surface(*w, i, s.ball);
                bool is_flat = stands && std::fabs(s.heel.y) < 0.002f && std::fabs(s.ball.y) < 0.002f;
                if (is_flat && stood[n]) slide = std::max(slide, length(ball_of_foot - before[n]));
                if (is_flat) off = std::max(off, std::fabs(length(ball_of_foot - Vec3{1, 2, 3}) - k_radius));
                before[n] = ball_of_foot;
                stood[n] = is_flat;
            }
        }
    }
    EXPECT_GT(way / k_walkers, 9) << "metres in ten seconds";
    EXPECT_LT(slide, 0.003f) << "metres in a tick, its settling included";
    EXPECT_LT(off, 0.03f) << "metres: the plane under a walker touches the ball in its middle";
}

TEST(Roam, IsTheSameOnAnyNumberOfThreads) {
    Compound c;
    c.spheres = {{{0, 0, 0}, 6}, {{5, 4, 0}, 5}};
    c.capsules.push_back({{0, 0, 0}, {-8, 2, 3}, 2});
    auto one = roaming(c, 80, 1), three = roaming(c, 80, 3);
    uint64_t start = hash_world(*one);
    for (int tick = 0; tick < 120; ++tick) step(*one), step(*three);
    EXPECT_EQ(hash_world(*one), hash_world(*three));
    EXPECT_NE(hash_world(*one), start);
}

TEST(Roam, StepAllocatesNothingAndTheHashKnowsItsWalkers) {
    Compound ball;
    ball.spheres.push_back({{0, 0, 0}, 9});
    auto w = roaming(ball, 70, 2);
    step(*w);
    size_t before = allocations();
    for (int tick = 0; tick < 60; ++tick) step(*w);
    EXPECT_EQ(allocations() - before, 0u);
    uint64_t hash = hash_world(*w);
    w->roam->walkers.pace[3] += 0.1f;
    EXPECT_NE(hash_world(*w), hash);
}

TEST(Roam, NothingToWalkOnIsRefused) {
    WorldOptions options;
    options.walkers = 3;
    auto world = make_world(std::make_shared<Ground>(level_stage()), options);
    ASSERT_TRUE(world);
    EXPECT_FALSE(set_down(**world, {}));
    // A ball on which there is room for some of them.
    Compound small;
    small.spheres.push_back({{0, 0, 0}, 1.5f});
    const Result<void> full = set_down(**world, small, 30);
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("find room"), std::string::npos) << full.error().message;
}

}  // namespace
}  // namespace flaneur
