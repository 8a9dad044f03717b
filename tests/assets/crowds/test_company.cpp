// People of the district who are with each other: how many, how fast, how far from each other, hand in hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "assets/cities.h"
#include "assets/population.h"
#include "sim/base/math.h"
#include "sim/deeds/bend.h"
#include "sim/state.h"
#include "sim/world.h"

namespace flaneur {
namespace {

std::vector<Kind> street_people() {
    std::vector<Kind> kinds;
    for (const PersonOptions& p : draw_population(24, 1))
        kinds.push_back({.body = standard_body(p.height), .share = 1, .age = p.age, .woman = p.woman});
    return kinds;
}

std::unique_ptr<World> peopled(const std::shared_ptr<const City>& city, uint64_t seed, uint32_t walkers,
                               const GroupShares& groups, int threads = 2) {
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = threads};
    options.kinds = street_people();
    options.destinations = city->destinations;
    options.crossings = city->crossings;
    options.leaving = k_usual_leaving;
    options.capacity = walkers;
    options.groups = groups;
    auto made = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
}

std::shared_ptr<const City> district(uint64_t seed) {
    return std::make_shared<const City>(generate_district({.seed = seed, .blocks = 3}));
}

// Of one size of groups.
struct Tally {
    uint64_t people = 0, ticks = 0, walking = 0, parted = 0, leads = 0, narrow = 0;
    double speed = 0, abreast = 0, beside = 0;
    uint64_t abreast_count = 0;
    float longest_lead = 0, farthest = 0;
};

float age_of(const World& w, uint32_t i) { return w.kinds[w.crowd.identity.body[i]].age; }

Vec3 touch(const World& w, uint32_t i, Side side) {
    const Someone who{w.gait.people[i / k_block], static_cast<int>(i % k_block)};
    return palm_of(body_pose_of(w.poses, i), who, side).place;
}

TEST(Company, WalksAsPeopleDo) {
    Tally by_size[5];
    float deepest = -1, worst_grip = 0, grip_sum = 0;
    uint64_t grips = 0, in_ring = 0, group_ticks = 0, waits = 0, come = 0, speaks = 0, hold_ticks = 0;
    for (const uint64_t seed : {1u, 2u}) {
        const auto city = district(seed);
        auto world = peopled(city, seed, 300, k_usual_groups);
        World& w = *world;
        std::vector<float> lead_for(w.crowd.capacity, 0);
        for (const WalkerId id : w.crowd.slots.living) {
            const Group* g = group_of(w.company, w.crowd, id.index);
            ++by_size[g ? g->count : 1].people;
            if (age_of(w, id.index) < k_never_alone) {
                EXPECT_TRUE(g);
            }
        }
        for (uint32_t tick = 0; tick < 90 * 60; ++tick) {
            step(w);
            deepest = std::max(deepest, deepest_overlap(w.crowd));
            for (const WalkerId id : w.crowd.slots.living) {
                const uint32_t i = id.index;
                const Bearing& b = w.company.bearings[i];
                if (b.holds != k_nobody) ++hold_ticks;
                if (b.holds != k_nobody && b.grip >= 1) {
                    const float off = length(touch(w, i, own_side(b)) - touch(w, b.holds, others_side(b)));
                    worst_grip = std::max(worst_grip, off), grip_sum += off, ++grips;
                }
                const Group* g = group_of(w.company, w.crowd, i);
                const float v = length(w.crowd.motion.velocity[i]);
                if (!g && v > 0.3f) by_size[1].speed += v, ++by_size[1].walking;
                if (!g || g->members[g->leader].index != i) continue;
                Tally& t = by_size[g->count];
                ++t.ticks, ++group_ticks;
                in_ring += g->does == Together::ring || g->does == Together::row;
                waits += g->waits != 0, speaks += g->speech == Speech::speech, come += g->expects > 0;
                t.parted += g->parted_since != k_never;
                if (g->does != Together::walks || v < 0.6f || g->expects > 0) continue;
                t.speed += v, ++t.walking;
                t.narrow += g->narrow > 0.5f;
                if (g->count != 2) continue;
                const uint32_t other = g->members[1 - g->leader].index;
                if (w.company.bearings[other].runs_until > w.tick) continue;
                const Vec2 off = on_ground(w.crowd.motion.position[other] - w.crowd.motion.position[i]);
                const Vec2 way = w.crowd.motion.velocity[i] / v;
                if (g->narrow < 0.1f && w.company.bearings[other].holds == k_nobody)
                    t.abreast += length(off), t.beside += std::fabs(cross(way, off)), ++t.abreast_count;
                const bool leads = std::fabs(dot(way, off)) > 0.5f && g->narrow < 0.1f;
                t.leads += leads;
                lead_for[i] = leads ? lead_for[i] + k_tick : 0;
                t.longest_lead = std::max(t.longest_lead, lead_for[i]);
                t.farthest = std::max(t.farthest, length(off));
            }
        }
        std::printf("seed %d: %u came, %u left\n", int(seed), w.coming.came, w.coming.left);
    }
    uint64_t all = 0;
    for (const Tally& t : by_size) all += t.people;
    for (int n = 1; n <= 4; ++n) {
        const Tally& t = by_size[n];
        std::printf("%d: %.3f of people, %.2f m/s, narrow %.3f, parted %.4f of the time", n,
                    double(t.people) / double(all), t.speed / double(t.walking),
                    double(t.narrow) / double(t.walking), double(t.parted) / double(t.ticks));
        if (n == 2)
            std::printf(", %.2f m apart, %.2f beside, lead %.3f of the time, %.1f s at most, farthest %.1f",
                        t.abreast / double(t.abreast_count), t.beside / double(t.abreast_count),
                        double(t.leads) / double(t.walking), double(t.longest_lead), double(t.farthest));
        std::printf("\n");
    }
    std::printf(
        "stand %.2f, wait %.3f, speak %.2f, expect %.3f; hands %.4f m mean, %.4f most, %.2f of the time; "
        "overlap %.3f\n",
        double(in_ring) / double(group_ticks), double(waits) / double(group_ticks),
        double(speaks) / double(group_ticks), double(come) / double(group_ticks),
        grips ? double(grip_sum) / double(grips) : 0, double(worst_grip),
        double(grips) / double(std::max<uint64_t>(hold_ticks, 1)), double(deepest));
    // Moussaid et al. 2010, Zanlungo et al. 2014: bands about what they found.
    for (uint32_t n = 1; n <= k_most_company; ++n)
        EXPECT_NEAR(double(by_size[n].people) / double(all), double(k_usual_groups[n - 1]), 0.03);
    auto speed = [&](int n) { return by_size[n].speed / double(by_size[n].walking); };
    EXPECT_TRUE(speed(1) > 1.15 && speed(1) < 1.45 && speed(2) > 1.05 && speed(2) < 1.3);
    EXPECT_TRUE(speed(3) > 0.95 && speed(3) < speed(2) && speed(4) > 0.9 && speed(4) < speed(2));
    const Tally& pairs = by_size[2];
    EXPECT_NEAR(pairs.beside / double(pairs.abreast_count), 0.75, 0.1);
    EXPECT_LT(double(pairs.leads) / double(pairs.walking), 0.1);
    EXPECT_LT(pairs.longest_lead, 15);
    EXPECT_LT(pairs.farthest, 12);
    for (int n = 2; n <= 4; ++n) EXPECT_LT(double(by_size[n].parted) / double(by_size[n].ticks), 0.03);
    EXPECT_GT(double(grips) / double(std::max<uint64_t>(hold_ticks, 1)), 0.6);
    EXPECT_LE(deepest, k_most_overlap + 1e-3f);
    EXPECT_LE(worst_grip, 0.01f);
}

}  // namespace
}  // namespace flaneur
