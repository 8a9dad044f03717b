// Leaps from body to body: the pull of bodies, flights that end on feet as they were planned to, and people
// and creatures who leap for minutes on several small worlds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"

namespace flaneur {
namespace {

Ground level_stage() {
    Ground ground;
    ground.vertices = {{-40, 0, -40}, {-40, 0, 40}, {40, 0, 40}, {40, 0, -40}};
    ground.indices = {0, 1, 2, 0, 2, 3};
    ground.kinds.assign(2, Surface::plaza);
    index_ground(ground);
    return ground;
}

struct Bodies {
    Compound compound;
    Gravity gravity;
};

void add(Bodies& all, Vec3 middle, float radius) {
    all.compound.spheres.push_back({middle, radius});
    const Vec3 surface[] = {middle + Vec3{radius, 0, 0}};
    add_body(all.gravity, std::span(&middle, 1), surface, k_usual_pull);
}

// Balls by chance, each some metres over another one.
Bodies balls(uint64_t seed, uint32_t count) {
    Bodies all;
    add(all, {}, 8);
    for (uint32_t n = 1, attempt = 0; n < count && attempt < 1000; ++attempt) {
        const RandomKey key{seed, n, attempt, Purpose::city};
        const auto& others = all.compound.spheres;
        const Sphere& on = others[static_cast<size_t>(random_unit(key) * 0.999f * static_cast<float>(n))];
        const Vec3 way =
            normalize_or({random_normal(key, 1), random_normal(key, 2), random_normal(key, 3)}, {0, 1, 0});
        const float radius = random_between(key, 4, 8, 4), gap = random_between(key, 4.2f, 5.5f, 5);
        const Vec3 middle = on.centre + way * (on.radius + gap + radius);
        const bool has_room = std::ranges::all_of(
            others, [&](const Sphere& s) { return length(s.centre - middle) > s.radius + radius + 4; });
        if (has_room) add(all, middle, radius), ++n;
    }
    return all;
}

TEST(Leap, PullsAsNewtonHasIt) {
    Bodies one;
    add(one, {1, 2, 3}, 5);
    for (const float far : {5.0f, 8.0f, 20.0f}) {
        const Pull pull = pull_at(one.gravity, Vec3{1, 2 + far, 3});
        EXPECT_NEAR(pull.all.y, -k_usual_pull * 25 / (far * far), 1e-4f);
        EXPECT_EQ(pull.body, 0u);
    }
    add(one, {1, 22, 3}, 5);
    EXPECT_NEAR(pull_at(one.gravity, {1, 12, 3}).all.y, 0, 1e-5f) << "midway";
    EXPECT_EQ(pull_at(one.gravity, {1, 12.1f, 3}).body, 1u);
    // A row of points pulls towards its middle line, a grid in a box of triangles inwards.
    Compound c;
    c.capsules.push_back({{-6, 0, 0}, {6, 0, 0}, 3});
    const Pull side = pull_at(gravity_of(c, 5), {0, 0, 3});
    EXPECT_NEAR(side.all.x, 0, 0.01f);
    EXPECT_LT(side.all.z, -4);
    Compound box;
    for (const float x : {-4.0f, 4.0f})
        for (const float y : {-3.0f, 3.0f})
            for (const float z : {-5.0f, 5.0f}) box.vertices.push_back({x, y, z});
    box.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                   2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    index_compound(box);
    const Gravity grid = gravity_of(box, 5);
    EXPECT_GT(grid.points.size(), 400u);
    for (const Vec3 out : {Vec3{5, 0, 0}, Vec3{0, -4, 0}, Vec3{0, 0, 6}}) {
        const Vec3 all = pull_at(grid, out).all;
        EXPECT_GT(dot(-all, normalize_or(out, {})), 0.97f * length(all));
    }
}

TEST(Leap, EndsWhereAndWhenItWasPlannedTo) {
    uint32_t planned = 0, wanted = 0;
    float longest = 0, hardest = 0;
    for (uint32_t seed = 0; seed < 300; ++seed) {
        const Bodies all = balls(seed, 2);
        const Sphere &a = all.compound.spheres[0], &b = all.compound.spheres[1];
        const RandomKey key{seed, 1, 0, Purpose::spawn};
        Vec3 up = normalize_or(b.centre - a.centre, {0, 1, 0});
        // Not quite below the other one.
        up = normalize_or(
            up + Vec3{random_normal(key, 0), random_normal(key, 1), random_normal(key, 2)} * 0.12f, up);
        const Vec3 ahead = normalize_or(cross(up, {0.3f, 0.5f, -0.8f}), {1, 0, 0});
        Flyer f{a.centre + up * a.radius, up, ahead, 0.95f};
        if (!body_overhead(all.compound, all.gravity, f)) continue;
        ++wanted;
        const auto leap =
            plan_leap(all.compound, all.gravity, f, false, k_tick, [](const Flyer&, int) { return true; });
        if (!leap) continue;
        ++planned;
        Leap flight = *leap;
        flight.seconds = 0;
        uint32_t ticks = 0;
        while (!fly_on(all.compound, all.gravity, f, flight, k_tick)) {
            ASSERT_LT(++ticks, 60 * k_longest_flight);
            ASSERT_NEAR(dot(f.up, f.ahead), 0, 1e-3f);
        }
        EXPECT_EQ(flight.place, leap->place);
        EXPECT_NEAR(length(f.position - b.centre), b.radius, 1e-3f);
        EXPECT_GT(dot(f.up, normalize_or(f.position - b.centre, {})), 0.95f);
        EXPECT_NEAR(flight.seconds, leap->lasts, 1e-3f);
        longest = std::max(longest, flight.seconds), hardest = std::max(hardest, flight.landing);
    }
    std::printf("%u of %u leaps found a way, %.2f s at most, landing at %.2f m/s at most\n", planned, wanted,
                static_cast<double>(longest), static_cast<double>(hardest));
    EXPECT_GT(planned, wanted * 2 / 3);
    EXPECT_GT(wanted, 100u);
}

std::unique_ptr<World> leaping(const Bodies& bodies, uint32_t walkers, uint32_t creatures, uint64_t seed,
                               int threads = 2) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = threads;
    options.seed = seed;
    auto world = make_world(std::make_shared<Ground>(level_stage()), options);
    EXPECT_TRUE(world) << world.error().message;
    Result<void> set = set_down(**world, bodies.compound, creatures, bodies.gravity);
    EXPECT_TRUE(set) << set.error().message;
    return std::move(*world);
}

float off_surface(const Bodies& all, Vec3 p) {
    float least = 1e9f;
    for (const Sphere& s : all.compound.spheres)
        least = std::min(least, std::fabs(length(p - s.centre) - s.radius));
    return least;
}

struct Tale {
    uint32_t leaps = 0, landings = 0, creature_leaps = 0;
    float longest = 0, off = 0, turn = 0, slide = 0, far = 0, hurry = 0, deepest = 0;
};

void watch(const Bodies& all, World& w, uint32_t ticks, Tale& tale) {
    const size_t count = w.roam->walkers.position.size(), people = w.crowd.count;
    std::vector<Vec3> feet(2 * people), place(count);
    std::vector<uint8_t> stood(2 * people, 0);
    std::vector<float> aloft(count, 0);
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        const SurfaceWalkers before = w.roam->walkers;
        step(w);
        const SurfaceWalkers& s = w.roam->walkers;
        for (size_t i = 0; i < count; ++i) {
            const bool flies = s.leaps[i].stage == LeapStage::flies,
                       flew = before.leaps[i].stage == LeapStage::flies;
            if (flies && !flew) {
                ++tale.leaps;
                if (i >= people) ++tale.creature_leaps;
                place[i] = s.leaps[i].place;
            }
            if (!flies && flew) {
                ++tale.landings;
                EXPECT_LT(length(s.position[i] - place[i]), 1e-3f) << i << " at tick " << w.tick;
            }
            aloft[i] = flies ? aloft[i] + k_tick : 0;
            tale.longest = std::max(tale.longest, aloft[i]);
            if (!flies) tale.off = std::max(tale.off, off_surface(all, s.position[i]));
            tale.far = std::max(tale.far, off_surface(all, s.position[i]));
            tale.turn = std::max(tale.turn, arccos(std::min(dot(before.up[i], s.up[i]), 1.0f)) / k_tick);
            tale.hurry = std::max(tale.hurry, length(s.position[i] - before.position[i]) / k_tick);
            for (size_t j = 0; j < i; ++j)
                if (!flies && s.leaps[j].stage != LeapStage::flies)
                    tale.deepest = std::max(
                        tale.deepest, s.radius[i] + s.radius[j] - length(s.position[i] - s.position[j]));
        }
        for (size_t i = 0; i < people; ++i)
            for (const Side side : {k_left, k_right}) {
                const size_t n = 2 * i + static_cast<size_t>(side);
                const Sole sole_now = sole(w.poses, w.gait, i, side);
                const bool stands = w.gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0 &&
                                    std::fabs(sole_now.heel.y) < 0.002f &&
                                    std::fabs(sole_now.ball.y) < 0.002f &&
                                    s.leaps[i].stage != LeapStage::flies;
                const Vec3 ball = set_onto(w.roam->frames[i], w.crowd.motion.position[i],
                                           w.crowd.motion.heading[i], {sole_now.ball, {}})
                                      .position;
                if (stands && stood[n]) tale.slide = std::max(tale.slide, length(ball - feet[n]));
                feet[n] = ball, stood[n] = stands;
            }
    }
}

TEST(Leap, NobodyIsLostInTenMinutesOfManyWorlds) {
    Tale tale;
    for (const uint64_t seed : {1, 2, 3, 4, 5}) {
        const Bodies all = balls(seed, 5);
        auto w = leaping(all, 24, 2, seed);
        watch(all, *w, 60 * 120, tale);
    }
    std::printf(
        "%u leaps, %u by creatures, %u landings, %.2f s in the air at most, %.4f m off the ground, up turns "
        "%.2f rad/s, feet slide %.4f m a tick, %.2f m out at most, %.2f m/s, %.3f m into each other\n",
        tale.leaps, tale.creature_leaps, tale.landings, static_cast<double>(tale.longest),
        static_cast<double>(tale.off), static_cast<double>(tale.turn), static_cast<double>(tale.slide),
        static_cast<double>(tale.far), static_cast<double>(tale.hurry), static_cast<double>(tale.deepest));
    EXPECT_GT(tale.leaps, 100u);
    EXPECT_GT(tale.creature_leaps, 4u);
    EXPECT_GE(tale.landings + 20, tale.leaps);
    EXPECT_LE(tale.longest, k_longest_flight);
    EXPECT_LT(tale.off, 0.01f);
    EXPECT_LT(tale.turn, 3.6f);
    EXPECT_LT(tale.slide, 0.006f);
    EXPECT_LT(tale.far, 7);
    EXPECT_LT(tale.deepest, 0.08f);
}

TEST(Leap, IsTheSameOnAnyNumberOfThreadsAndFromASavedState) {
    const Bodies all = balls(3, 5);
    auto one = leaping(all, 40, 2, 3, 1), three = leaping(all, 40, 2, 3, 3);
    uint32_t in_air = 0;
    for (int tick = 0; tick < 1200; ++tick) {
        step(*one), step(*three);
        for (const Leap& leap : one->roam->walkers.leaps) in_air += leap.stage == LeapStage::flies;
    }
    EXPECT_GT(in_air, 100u);
    EXPECT_EQ(hash_world(*one), hash_world(*three));
    // Taken back into another world it goes on the same way, those in the air too.
    std::vector<std::byte> bytes;
    save_state(*one, bytes);
    auto other = leaping(all, 40, 2, 3, 1);
    ASSERT_TRUE(load_state(*other, bytes));
    step(*one), step(*other);
    const size_t before = allocations();
    for (int tick = 0; tick < 300; ++tick) step(*one), step(*other);
    EXPECT_EQ(allocations() - before, 0u);
    EXPECT_EQ(hash_world(*one), hash_world(*other));
}

TEST(Leap, WhoIsLedGoesWhereAskedAndLeapsWhenAsked) {
    for (const uint64_t seed : {1, 2, 3, 4}) {
        const Bodies all = balls(seed, 3);
        auto w = leaping(all, 12, 0, seed, 1);
        SurfaceWalkers& s = w->roam->walkers;
        drive(w->crowd, 4);
        // Towards the place below the next ball, and there up.
        const Vec3 home = all.compound.spheres[0].centre;
        const Vec3 goal = home + normalize_or(all.compound.spheres[1].centre - home, {0, 1, 0}) * 8;
        bool has_arrived = false, has_leapt = false;
        for (int tick = 0; tick < 60 * 60 && !has_leapt; ++tick) {
            const Vec3 way = goal - s.position[4];
            has_arrived = length(way) < 1.2f;
            s.wish[4] = has_arrived ? Vec3{} : normalize_or(way, {}) * 2.5f;
            if (has_arrived && tick % 60 == 0) ask_leap(s, 4);
            step(*w);
            has_leapt = length(s.position[4] - all.compound.spheres[1].centre) <
                            all.compound.spheres[1].radius + 0.01f &&
                        s.leaps[4].stage == LeapStage::absorbs;
        }
        EXPECT_TRUE(has_leapt || length(s.position[4] - home) > 8.1f) << "with seed " << seed;
        // Elsewhere it comes down where it was.
        let_go(w->crowd);
    }
    const Bodies one = balls(1, 1);
    auto w = leaping(one, 3, 0, 1, 1);
    for (int tick = 0; tick < 60; ++tick) step(*w);
    ask_leap(w->roam->walkers, 1);
    float highest = 0;
    Vec3 from;
    for (int tick = 0; tick < 240; ++tick) {
        step(*w);
        const float high = off_surface(one, w->roam->walkers.position[1]);
        if (w->roam->walkers.leaps[1].stage == LeapStage::crouches) from = w->roam->walkers.position[1];
        const bool has_landed = w->roam->walkers.leaps[1].stage == LeapStage::absorbs;
        EXPECT_TRUE(!has_landed || length(w->roam->walkers.position[1] - from) < 0.05f);
        highest = std::max(highest, high);
    }
    EXPECT_GT(highest, 0.35f);
    EXPECT_LT(highest, 0.7f);
}

}  // namespace
}  // namespace flaneur
