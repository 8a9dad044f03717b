// Groups on small grounds: who is in them, and that chance, threads and saved states have no part in what
// they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

WorldOptions some_people(uint32_t walkers, uint64_t seed, int threads) {
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = threads};
    options.kinds = {{.body = standard_body(1.78f), .share = 4, .age = 34},
                     {.body = standard_body(1.66f), .share = 4, .age = 31, .woman = true},
                     {.body = standard_body(1.67f), .share = 1, .age = 68, .woman = true},
                     {.body = standard_body(1.16f), .share = 0.7f, .age = 5.6f},
                     {.body = standard_body(1.38f), .share = 0.7f, .age = 9, .woman = true}};
    options.groups = k_usual_groups;
    return options;
}

std::unique_ptr<World> on_a_square(WorldOptions options, float size = 50) {
    Ground ground = square(size);
    index_ground(ground);
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

float age_of(const World& w, uint32_t i) { return w.kinds[w.crowd.identity.body[i]].age; }

TEST(Groups, AreAsManyAsAskedForAndNoChildIsAlone) {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const auto w = on_a_square(some_people(300, seed, 1), 120);
        float in[5] = {};
        for (const WalkerId id : w->crowd.slots.living) {
            const Group* g = group_of(w->company, w->crowd, id.index);
            in[g ? g->count : 1] += 1 / 300.0f;
            if (age_of(*w, id.index) < k_never_alone) {
                EXPECT_NE(g, nullptr);
            }
            if (!g || age_of(*w, id.index) >= k_never_alone) continue;
            bool has_adult = false;
            for (uint32_t k = 0; k < g->count; ++k)
                has_adult |= age_of(*w, g->members[k].index) >= age_of(*w, id.index) + 20;
            EXPECT_TRUE(has_adult);
        }
        for (uint32_t size = 1; size <= k_most_company; ++size)
            EXPECT_NEAR(in[size], k_usual_groups[size - 1], 0.04f) << size << " of seed " << seed;
    }
}

TEST(Groups, AreTheSameOnAnyNumberOfThreadsAndFromASavedState) {
    WorldOptions options = some_people(120, 4, 1);
    options.acquaintances = 0.3f;
    const auto one = on_a_square(options);
    options.threads = 3;
    const auto three = on_a_square(options);
    std::vector<std::byte> saved;
    for (uint32_t tick = 0; tick < 900; ++tick) {
        step(*one), step(*three);
        if (tick == 600) save_state(*one, saved);
    }
    ASSERT_EQ(hash_world(*one), hash_world(*three));
    ASSERT_TRUE(load_state(*three, saved));
    for (uint32_t tick = 601; tick < 900; ++tick) step(*three);
    EXPECT_EQ(hash_world(*one), hash_world(*three));
}

TEST(Groups, AllocateNothing) {
    WorldOptions options = some_people(80, 5, 1);
    options.acquaintances = 0.5f;
    const auto w = on_a_square(options);
    for (uint32_t tick = 0; tick < 60; ++tick) step(*w);
    const auto before = allocations();
    for (uint32_t tick = 0; tick < 900; ++tick) step(*w);
    EXPECT_EQ(allocations(), before);
}

TEST(Groups, StayTogetherAndDoNotPressIntoEachOther) {
    float farthest = 0, deepest = -1;
    uint64_t apart = 0, all = 0;
    for (const uint64_t seed : {1u, 2u}) {
        const auto w = on_a_square(some_people(90, seed, 2));
        for (uint32_t tick = 0; tick < 60 * 60; ++tick) {
            step(*w);
            deepest = std::max(deepest, deepest_overlap(w->crowd));
            for (const Group& g : w->company.groups)
                for (uint32_t k = 0; k < g.count; ++k) {
                    const uint32_t i = g.members[k].index;
                    if (k == g.leader || w->company.bearings[i].runs_until > w->tick) continue;
                    const float far = length(on_ground(w->crowd.motion.position[i] -
                                                       w->crowd.motion.position[g.members[g.leader].index]));
                    farthest = std::max(farthest, far);
                    apart += far > 3, ++all;
                }
        }
    }
    std::printf("farthest %.2f m, %.4f of the time beyond 3 m, overlap %.3f m\n", wide(farthest),
                double(apart) / double(all), wide(deepest));
    EXPECT_LT(double(apart) / double(all), 0.03);
    EXPECT_LE(deepest, k_most_overlap + 1e-3f);
}

TEST(Meetings, BeginAndEnd) {
    uint32_t begun = 0, shaken = 0, talked = 0, of_three = 0, ended = 0;
    for (const uint64_t seed : {1u, 2u}) {
        WorldOptions options = some_people(50, seed, 2);
        options.groups = {1, 0, 0, 0};
        options.acquaintances = 0.6f;
        const auto w = on_a_square(options, 60);
        std::vector<Group> before;
        for (uint32_t tick = 0; tick < 100 * 60; ++tick) {
            step(*w);
            for (size_t n = 0; n < w->company.groups.size(); ++n) {
                const Group& g = w->company.groups[n];
                const Group was = n < before.size() ? before[n] : Group{};
                begun += g.count > 0 && was.count == 0;
                ended += g.count == 0 && was.count > 0;
                const bool is_new = g.count > 0 && g.stage != was.stage;
                shaken += is_new && g.stage == Encounter::greets && g.shakes_hands != 0;
                talked += is_new && g.stage == Encounter::talks;
                of_three += g.count == 3 && was.count == 2;
            }
            before = w->company.groups;
            ASSERT_LE(deepest_overlap(w->crowd), k_most_overlap + 1e-3f);
        }
        for (const Called& called : w->crowd.called)
            EXPECT_NE(w->crowd.fellows[called.walker].group, k_no_group) << "nobody is forgotten there";
    }
    std::printf("%u begun, %u ended, %u with a handshake, %u talked, %u of three\n", begun, ended, shaken,
                talked, of_three);
    EXPECT_GT(begun, 10u);
    EXPECT_GT(talked, begun / 2);
    EXPECT_GT(ended, begun / 3);
    EXPECT_GT(shaken, 0u);
}

}  // namespace
}  // namespace flaneur
