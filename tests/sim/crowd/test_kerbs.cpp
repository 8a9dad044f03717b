// People and creatures at a crossing with lamps, over many of them: who waits where, who goes when.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr float k_on_it = 1;  // metres beyond a kerb, where one has begun to cross

Crossings one_crossing(uint64_t seed) {
    Crossings c;
    c.all.emplace_back().half_length = 4;
    const uint8_t ruled[] = {1};
    set_lamps(c, ruled, seed);
    return c;
}

// People on both pavements who have errands on both.
std::unique_ptr<World> busy_street(uint64_t seed, float jaywalkers, uint32_t walkers = 30, int threads = 1) {
    Ground ground = street();
    index_ground(ground);
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = threads};
    options.kinds = {{.body = standard_body(1.75f), .share = 2, .age = 30},
                     {.body = standard_body(1.65f), .share = 1, .age = 74, .woman = true}};
    for (const float x : {-14.0f, -7.0f, 7.0f, 14.0f})
        for (const float z : {-6.5f, 6.5f})
            options.destinations.push_back(
                {DestinationKind::square, {x, 0.12f, z}, {0, z < 0 ? -1.0f : 1.0f}, 1});
    options.crossings = one_crossing(seed);
    options.jaywalkers = jaywalkers;
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

// What somebody does at the crossing, tick by tick.
struct Passer {
    bool on = false;       // the carriageway
    bool counted = false;  // as one who crosses
    uint32_t kerb = 0;     // over which it came
    Light entered = Light::red;
};

struct Tally {
    uint32_t green = 0, red = 0, waited = 0, late = 0, hurried = 0;
    std::vector<float> starts, old_starts, apart, backs, paces, old_paces;  // seconds; metres; m/s
    float deepest = -9;
    uint32_t stuck = 0;
};

void watch(World& w, uint32_t ticks, Tally& seen) {
    const Crossing& crossing = w.crowd.kerbs.map->crossings.all[0];
    const LampPlan& plan = w.crowd.kerbs.map->crossings.plans[0];
    const uint32_t count = w.crowd.count;
    std::vector<Passer> passers(count);
    std::vector<uint8_t> stands(count, 0), waited(count, 0);
    for (uint32_t t = 0; t < ticks; ++t) {
        const uint32_t tick = w.tick;
        const Lamp lamp = lamp_at(plan, tick);
        step(w);
        seen.deepest = std::max(seen.deepest, deepest_overlap(w.crowd));
        for (uint32_t i = 0; i < count; ++i) {
            const Vec2 at = on_ground(w.crowd.motion.position[i]);
            const OnCrossing on = on_crossing(crossing, at);
            const bool is_on = std::fabs(on.over) < crossing.half_length - 0.05f &&
                               std::fabs(on.aside) < crossing.half_width + k_kerb_margin;
            const float speed = length(w.crowd.motion.velocity[i]);
            const bool is_old = w.kinds[w.crowd.identity.body[i]].age > 65;
            seen.stuck += w.tick - w.crowd.journeys[i].closest_tick > 20 * 60 &&
                          tick >= w.crowd.journeys[i].pause_until;
            Passer& p = passers[i];
            if (is_on && !p.on)
                p = {.on = true, .counted = false, .kerb = on.over > 0 ? 1u : 0u, .entered = lamp.light};
            p.on = is_on;
            if (p.on && !p.counted && beyond_kerb(crossing, p.kerb, on) > k_on_it) {
                p.counted = true;
                ++(p.entered == Light::green ? seen.green : seen.red);
            }
            if (p.counted && p.on && p.entered == Light::green) {
                seen.late += lamp_of_drivers(plan, tick).light == Light::green;
                if (std::fabs(on.over) < 1) (is_old ? seen.old_paces : seen.paces).push_back(speed);
            }
            const KerbWait& wait = w.crowd.kerbs.waits[i];
            const bool is_waiting = wait.kerb != k_no_kerb;
            if (is_waiting && !waited[i]) ++seen.waited;
            waited[i] = is_waiting;
            if (is_waiting && lamp.light == Light::red && speed < 0.1f && length(wait.to - at) < 0.3f)
                stands[i] = 1;
            if (stands[i] != 0 && lamp.light == Light::green && speed > 0.25f && !is_waiting) {
                (is_old ? seen.old_starts : seen.starts).push_back(static_cast<float>(lamp.since) * k_tick);
                stands[i] = 0;
            }
            // Has gone off elsewhere.
            if (!is_waiting && lamp.light == Light::red) stands[i] = 0;
        }
        if (lamp.light != Light::red || lamp.left != 1) continue;
        for (uint32_t i = 0; i < count; ++i) {
            const KerbWait& wait = w.crowd.kerbs.waits[i];
            const Vec2 at = on_ground(w.crowd.motion.position[i]);
            if (stands[i] == 0 || wait.kerb == k_no_kerb || length(wait.to - at) > 0.3f) continue;
            seen.backs.push_back(-beyond_kerb(crossing, wait.kerb, on_crossing(crossing, at)));
            float nearest = 9;
            for (uint32_t k = 0; k < count; ++k)
                if (k != i && stands[k] != 0)
                    nearest = std::min(nearest, length(at - on_ground(w.crowd.motion.position[k])));
            if (nearest < 2) seen.apart.push_back(nearest);
        }
    }
}

float share_of(std::vector<float> values, float share) {
    if (values.empty()) return -1;
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(share * static_cast<float>(values.size() - 1))];
}

void tell(const char* who, const Tally& s) {
    std::printf(
        "%s: %u on green, %u on red, %u waited; on it as others drive %u ticks; overlap %.3f; stuck %u\n"
        "  starts %.2f %.2f %.2f s (old %.2f %.2f %.2f); apart %.2f %.2f %.2f m; back %.2f %.2f %.2f m; "
        "pace %.2f (old %.2f) m/s\n",
        who, s.green, s.red, s.waited, s.late, s.deepest, s.stuck, share_of(s.starts, 0),
        share_of(s.starts, 0.5f), share_of(s.starts, 1), share_of(s.old_starts, 0),
        share_of(s.old_starts, 0.5f), share_of(s.old_starts, 1), share_of(s.apart, 0),
        share_of(s.apart, 0.5f), share_of(s.apart, 1), share_of(s.backs, 0), share_of(s.backs, 0.5f),
        share_of(s.backs, 1), share_of(s.paces, 0.5f), share_of(s.old_paces, 0.5f));
}

TEST(Kerbs, PeopleWaitAtRedAndAreOverBeforeOthersDrive) {
    Tally seen;
    for (uint64_t seed = 1; seed <= 6; ++seed) watch(*busy_street(seed, 0), 100 * 60, seen);
    tell("kerbs", seen);
    EXPECT_GT(seen.green, 60u);
    // Who has stepped off the pavement round those who wait, and sets out from there.
    EXPECT_LE(seen.red, seen.green / 40);
    EXPECT_EQ(seen.late, 0u);
    EXPECT_EQ(seen.stuck, 0u);
    EXPECT_LE(seen.deepest, k_most_overlap + 1e-3f);
    EXPECT_GT(seen.waited, 40u);
    // 0.6 to 0.9 m apart, and 0.3 to 1 m off the kerb.
    EXPECT_GT(share_of(seen.apart, 0.25f), 0.45f);
    EXPECT_GT(share_of(seen.apart, 0.5f), 0.58f);
    EXPECT_LT(share_of(seen.apart, 0.5f), 0.9f);
    EXPECT_GT(share_of(seen.backs, 0.05f), 0.28f);
    EXPECT_LT(share_of(seen.backs, 0.8f), 1.1f);
    EXPECT_GE(share_of(seen.starts, 0.1f), 0.3f);
    EXPECT_LE(share_of(seen.starts, 0.9f), 3.2f);
    EXPECT_GE(share_of(seen.old_starts, 0.05f), 1.8f);
    EXPECT_LE(share_of(seen.old_starts, 0.9f), 3);
    EXPECT_GT(share_of(seen.paces, 0.5f), 1.35f);
    EXPECT_LT(share_of(seen.paces, 0.5f), 1.55f);
    EXPECT_GT(share_of(seen.old_paces, 0.5f), 1.05f);
    EXPECT_LT(share_of(seen.old_paces, 0.5f), 1.35f);
}

TEST(Kerbs, AsManyGoOnRedAsTheSceneSays) {
    for (const float share : {0.1f, 0.5f, 1.0f}) {
        Tally seen;
        for (uint64_t seed = 1; seed <= 4; ++seed) watch(*busy_street(seed, share), 60 * 60, seen);
        const float went = static_cast<float>(seen.red) / static_cast<float>(seen.red + seen.waited);
        std::printf("kerbs: of those who come to red %.2f go on, where %.2f do\n", went, share);
        // A third of them are old, and half as likely to.
        EXPECT_GT(went, share == 1 ? 0.95f : 0.4f * share);
        EXPECT_LE(went, 1.3f * share);
    }
}

TEST(Kerbs, CreaturesNeverEnterOnRed) {
    uint32_t crossed = 0;
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        const auto world = busy_street(seed, 1, 6);
        World& w = *world;
        ASSERT_TRUE(set_loose(w, 3));
        const Crossings crossings = w.crowd.kerbs.map->crossings;
        std::vector<uint8_t> was_on(3, 1);
        for (uint32_t tick = 0; tick < 90 * 60; ++tick) {
            const Light light = lamp_at(crossings.plans[0], w.tick).light;
            step(w);
            for (uint32_t n = 0; n < 3; ++n) {
                const Vec3 at = w.crowd.motion.position[w.herd.goes_as[n]];
                const OnCrossing on = on_crossing(crossings.all[0], on_ground(at));
                const bool is_on = std::fabs(on.over) < 3.8f && std::fabs(on.aside) < 2;
                if (is_on && was_on[n] == 0) {
                    ++crossed;
                    EXPECT_EQ(light, Light::green) << seed << ": at tick " << tick;
                }
                was_on[n] = is_on;
            }
        }
    }
    std::printf("kerbs: creatures went over %u times\n", crossed);
    EXPECT_GT(crossed, 3u);
}

TEST(Kerbs, AreTheSameOnEveryNumberOfThreadsAndFromAState) {
    const auto one = busy_street(3, 0.1f, 40, 1), three = busy_street(3, 0.1f, 40, 3),
               late = busy_street(3, 0.1f, 40, 2);
    std::vector<std::byte> bytes;
    size_t waiting = 0;
    for (int tick = 0; tick < 40 * 60; ++tick) {
        step(*one), step(*three);
        ASSERT_EQ(hash_world(*one), hash_world(*three)) << tick;
        for (const KerbWait& wait : one->crowd.kerbs.waits) waiting += wait.kerb != k_no_kerb;
        if (tick == 20 * 60) save_state(*one, bytes);
    }
    EXPECT_GT(waiting, 1000u);
    ASSERT_TRUE(load_state(*late, bytes));
    while (late->tick < one->tick) step(*late);
    EXPECT_EQ(hash_world(*one), hash_world(*late));
}

TEST(Kerbs, ATickAllocatesNothing) {
    const auto world = busy_street(2, 0.1f);
    for (int tick = 0; tick < 300; ++tick) step(*world);
    const size_t before = allocations();
    for (int tick = 0; tick < 1200; ++tick) step(*world);
    EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace flaneur
