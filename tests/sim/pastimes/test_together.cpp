// Groups of a small square who sit down side by side, talk and get up, over many ticks and seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/fields.h"
#include "sim/pastimes/pastimes.h"
#include "sim/pastimes/seated.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr Vec3 k_where[] = {{-9, 0, -4}, {-3, 0, -4}, {3, 0, -4}, {9, 0, -4}};

std::unique_ptr<World> with_groups(uint64_t seed, uint32_t seats_a_bench, int threads = 1) {
    Ground ground = square(50);
    WorldOptions options{.walkers = 40, .seed = seed, .threads = threads};
    for (uint32_t b = 0; b < 4; ++b) {
        ground.obstacles.push_back({k_where[b], 0, {0.8f, 0.3f}});
        options.destinations.push_back({DestinationKind::bench, k_where[b] + Vec3{0, 0, 0.8f}, {0, 1}, 1});
        for (uint32_t n = 0; n < seats_a_bench; ++n)
            options.pastime_places.seats.push_back(
                {k_where[b] + Vec3{-0.6f + 0.6f * static_cast<float>(n), 0.46f, 0.21f},
                 {0, 1},
                 0.44f,
                 b,
                 n % 2});
    }
    index_ground(ground);
    options.kinds = {{.body = standard_body(1.78f), .share = 2, .age = 34},
                     {.body = standard_body(1.64f), .share = 2, .age = 33, .woman = true},
                     {.body = standard_body(1.3f), .share = 1, .age = 8}};
    options.groups = {0.1f, 0.5f, 0.4f, 0};
    options.pastimes = {.sitting = 1};
    auto made = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
}

bool is_with(const Pastime& p) {
    return p.what == Staying::sits && p.with != k_nobody && p.phase != StayPhase::over;
}

struct Watched {
    uint32_t parties = 0, threes = 0, sat_ticks = 0, talking = 0, faces = 0, looks = 0, children = 0;
    uint32_t longest_alone = 0;  // ticks that one of a group stayed after another had got up
    float off_seat = 0;
};

void watch_groups(World& w, uint32_t ticks, Watched& seen) {
    std::vector<uint32_t> alone(w.crowd.capacity, 0);
    std::set<std::pair<uint32_t, uint32_t>> begun;
    for (uint32_t n = 0; n < ticks; ++n) {
        step(w);
        for (const Pastime& p : w.pastimes->all) {
            if (!is_with(p)) continue;
            const Group* g = group_of(w.company, w.crowd, p.walker);
            ASSERT_TRUE(g);
            EXPECT_EQ(g->members[g->leader].index, p.with);
            if (p.with == p.walker && p.phase == StayPhase::comes && begun.emplace(p.walker, p.began).second)
                ++seen.parties, seen.threes += g->count == 3;
            uint32_t sit = 0, stay = 0;
            for (uint32_t k = 0; k < g->count; ++k) {
                const Pastime* own = own_of(w.pastimes->all, g->members[k].index);
                sit += own && is_with(*own);
                stay += own && is_with(*own) && own->phase == StayPhase::stays;
            }
            // Nobody is left standing while the others stay.
            alone[p.walker] = sit < g->count && p.phase == StayPhase::stays ? alone[p.walker] + 1 : 0;
            seen.longest_alone = std::max(seen.longest_alone, alone[p.walker]);
            if (p.phase != StayPhase::stays) continue;
            ++seen.sat_ticks;
            const Someone who{w.gait.people[p.walker / k_block], static_cast<int>(p.walker % k_block)};
            const Seat& seat = w.pastimes->places.seats[p.place];
            const Vec3 hip = joint_pose(w.poses, p.walker, left_upper_leg).position;
            seen.off_seat = std::max(seen.off_seat, std::fabs(hip.y - seat.edge.y - seat_of(who)));
            if (stay < g->count) continue;
            EXPECT_EQ(g->does, Together::sits);
            seen.talking += g->speech == Speech::speech;
            const bool is_child = who.person.height[who.lane] < 1.4f;
            bool beside_grown = false;
            for (uint32_t k = 0; k < g->count; ++k) {
                const Pastime* own = own_of(w.pastimes->all, g->members[k].index);
                const uint32_t apart = own->place > p.place ? own->place - p.place : p.place - own->place;
                EXPECT_LT(apart, g->count) << "side by side";
                const float tall = w.gait.people[own->walker / k_block].height[own->walker % k_block];
                beside_grown |= apart == 1 && tall > 1.4f;
            }
            seen.children += is_child;
            if (is_child) {
                EXPECT_TRUE(beside_grown);
            }
            // Whose head it turns to.
            if (p.whom == k_nobody || p.heed < 1 || w.company.bearings[p.walker].gazes == 0) continue;
            const Vec3 ahead = rotate(joint_pose(w.poses, p.walker, head).rotation, {0, 0, 1});
            const Vec3 to =
                joint_pose(w.poses, p.whom, head).position - joint_pose(w.poses, p.walker, head).position;
            ++seen.looks;
            seen.faces +=
                dot(normalize_or(on_ground(ahead), {0, 1}), normalize_or(on_ground(to), {0, 1})) > 0.75f;
        }
    }
}

TEST(Together, GroupsSitSideBySideTalkAndGetUpTogether) {
    Watched seen;
    for (const uint64_t seed : {1u, 2u, 3u}) {
        auto world = with_groups(seed, 3);
        watch_groups(*world, 9000, seen);
        for (const WalkerId id : world->crowd.slots.living) {
            const Journey& j = world->crowd.journeys[id.index];
            EXPECT_FALSE(!own_of(world->crowd.called, id.index) && j.stuck > 3) << id.index;
        }
    }
    std::printf(
        "%u groups sat, %u of three, %.0f s in all, %.0f %% talking, heads turned to others %.0f %%; "
        "alone at most %.1f s, off seats %.1f mm\n",
        seen.parties, seen.threes, wide(static_cast<float>(seen.sat_ticks) * k_tick),
        100.0 * seen.talking / std::max(seen.sat_ticks, 1u), 100.0 * seen.faces / std::max(seen.looks, 1u),
        wide(static_cast<float>(seen.longest_alone) * k_tick), wide(seen.off_seat * 1000));
    EXPECT_GT(seen.parties, 5u);
    EXPECT_GT(seen.threes, 0u);
    EXPECT_GT(seen.children, 0u);
    EXPECT_GT(seen.talking, seen.sat_ticks / 5);
    EXPECT_GT(seen.faces, seen.looks * 8 / 10);
    EXPECT_LT(seen.longest_alone, 6 * 60u);
    EXPECT_LT(seen.off_seat, 0.02f);
}

TEST(Together, NobodySitsWhereThereAreTooFewSeatsForAll) {
    auto world = with_groups(4, 1);
    for (int n = 0; n < 5000; ++n) {
        step(*world);
        for (const Pastime& p : world->pastimes->all) EXPECT_FALSE(is_with(p));
    }
}

// One falls: the others get up, and nobody waits for ever.
// Whether one of a group that sat was taken away, and if so, whether the others got up.
std::optional<bool> others_get_up(uint64_t seed) {
    auto world = with_groups(seed, 3);
    uint32_t fallen = k_nobody, lead = k_nobody, tick = 0;
    for (int n = 0; n < 9000; ++n) {
        step(*world);
        for (const Pastime& p : world->pastimes->all)
            if (fallen == k_nobody && is_with(p) && p.phase == StayPhase::stays && p.with != p.walker)
                fallen = p.walker, lead = p.with, tick = world->tick;
        if (fallen == k_nobody) continue;
        if (world->tick == tick + 60) forget_pastime(*world->pastimes, world->crowd, fallen);
        if (world->tick > tick + 60 + 60 * 20) {
            const Pastime* own = own_of(world->pastimes->all, lead);
            return !(own && is_with(*own));
        }
    }
    return std::nullopt;
}

TEST(Together, AllGetUpWhenOneHasGone) {
    std::optional<bool> all_up;
    for (uint64_t seed = 1; seed <= 6 && !all_up; ++seed) all_up = others_get_up(seed);
    ASSERT_TRUE(all_up) << "nobody sat";
    EXPECT_TRUE(*all_up);
}

TEST(Together, AreTheSameForAnyNumberOfThreadsAndAllocateNothing) {
    auto one = with_groups(2, 3, 1), four = with_groups(2, 3, 4);
    std::vector<std::byte> kept;
    for (int n = 0; n < 600; ++n) step(*one), step(*four);
    const size_t before = allocations();
    bool sat = false;
    for (int n = 600; n < 4500; ++n) {
        step(*one);
        for (const Pastime& p : one->pastimes->all) sat |= is_with(p) && p.phase == StayPhase::stays;
    }
    EXPECT_EQ(allocations(), before);
    for (int n = 600; n < 4500; ++n) {
        step(*four);
        if (n == 3000) save_state(*four, kept);
    }
    EXPECT_TRUE(sat);
    EXPECT_EQ(hash_world(*one), hash_world(*four));
    ASSERT_TRUE(load_state(*four, kept));
    while (four->tick < one->tick) step(*four);
    EXPECT_EQ(hash_world(*one), hash_world(*four));
}

}  // namespace
}  // namespace flaneur
