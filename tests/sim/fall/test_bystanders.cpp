// Those around one who falls: they look, some stop, some help, all go on; nobody walks over who lies there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "sim/base/isa.h"
#include "sim/base/spans.h"
#include "sim/state.h"
#include "tests/debt.h"
#include "tests/sim/allocations.h"
#include "tests/sim/fall/pushed_world.h"

namespace flaneur {
namespace {

constexpr uint32_t k_ticks_a_second = 60;

// One of those who are there is felled every `every` ticks.
void fell_one(World& w, uint32_t tick, uint32_t every) {
    if (tick % every != every / 2) return;
    const RandomKey key{w.seed, 0, tick, Purpose::fall};
    push_one(w, walkers(w)[random_bits(key) % walkers(w).size()], 2.4f, tick);
}

struct Told {
    int falls = 0, held = 0, watched = 0, glanced = 0, thanked = 0;
    float longest = 0;        // seconds that one was down
    float stays = 0;          // seconds that one minded others, at most
    float apart = 0;          // metres between palms that hold each other
    float nearest = 9;        // metres from legs that came by to who lay there
    float head_turns = 0;     // rad/s of necks and arms of who minds
    float rises[2] = {0, 0};  // seconds from the knees up, mean, alone and helped
};

Told watched(float helpers, uint32_t seconds, uint64_t seed, uint32_t people = 40) {
    Told told;
    auto w = world_on(square(20), people, seed, 2, helpers);
    std::map<uint32_t, uint32_t> down, minding, kneels;
    std::map<std::pair<uint32_t, uint32_t>, bool> was_far;  // who was, from whom
    std::map<uint32_t, bool> helped;
    int count[2] = {0, 0};
    for (uint32_t t = 0; t < seconds * k_ticks_a_second; ++t) {
        if (t + 12 * k_ticks_a_second < seconds * k_ticks_a_second) fell_one(*w, t, 240);
        step(*w);
        std::map<uint32_t, uint32_t> still_down, still_minding, still_kneels;
        for (const Fall& f : w->falls.all) {
            if (f.phase == FallPhase::sways) continue;
            const uint32_t so_far = down.count(f.walker) ? down[f.walker] + 1 : 1;
            still_down[f.walker] = so_far;
            if (so_far == 1) ++told.falls, helped[f.walker] = false;
            told.longest = std::max(told.longest, static_cast<float>(so_far) * k_tick);
            if (f.held) helped[f.walker] = true;
            if (f.phase == FallPhase::rises && f.stage >= RiseStage::kneel)
                still_kneels[f.walker] = kneels[f.walker] + 1;
            if (f.phase == FallPhase::rises && f.stage > RiseStage::fours) continue;
            if (f.phase == FallPhase::falls) continue;
            const auto lies = balls_of(*w, f.walker, f.segments);
            for (const WalkerId id : walkers(*w)) {
                const Vec3 off = w->crowd.motion.position[id.index] - w->crowd.motion.position[f.walker];
                if (id.index == f.walker || has_fallen(*w, id) || length(off) > 4) continue;
                // Whom it fell on gets off as fast as can be; of all others it is asked.
                bool& far = was_far[{id.index, f.walker}];
                if (length(off) > 1.7f) far = true;
                const Bystander* b = own_of(w->bystanders.all, id.index);
                const bool helps = b && b->whom == f.walker && b->does >= Concern::comes;
                if (!far || helps) continue;
                const Segments own =
                    segments_of(w->gait.people[id.index / k_block], static_cast<int>(id.index % k_block));
                const auto legs = balls_of(*w, id.index, own);
                for (size_t a = 0; a < k_ball_count; ++a)
                    for (const size_t k : {12, 13, 14, 20, 21, 22})
                        told.nearest = std::min(
                            told.nearest, length(lies[a] - legs[k]) - f.segments.radius[a] - own.radius[k]);
            }
        }
        for (const auto& [walker, ticks] : kneels) {
            if (still_kneels.count(walker)) continue;
            const int is = helped[walker];
            told.rises[is] += static_cast<float>(ticks) * k_tick, ++count[is];
            told.held += is;
        }
        for (auto it = was_far.begin(); it != was_far.end();)
            it = still_down.count(it->first.second) ? std::next(it) : was_far.erase(it);
        for (const Bystander& b : w->bystanders.all) {
            still_minding[b.walker] = minding[b.walker] + 1;
            told.stays = std::max(told.stays, static_cast<float>(still_minding[b.walker]) * k_tick);
            told.glanced += b.does == Concern::glances && b.began + 1 == w->tick;
            told.watched += b.does == Concern::watches && b.began + 1 == w->tick;
            told.thanked += b.does == Concern::thanks && b.began + 1 == w->tick;
            if (!b.has_hold) continue;
            auto palm = [&](uint32_t walker, uint32_t side) {
                return palm_of(body_pose_of(w->poses, walker), w->gait.people[walker / k_block],
                               static_cast<int>(walker % k_block), static_cast<Side>(side));
            };
            told.apart = std::max(told.apart, length(palm(b.walker, b.hand) - palm(b.whom, b.side)));
        }
        down = still_down, minding = still_minding, kneels = still_kneels;
    }
    for (const int k : {0, 1}) told.rises[k] /= static_cast<float>(std::max(count[k], 1));
    EXPECT_TRUE(w->bystanders.all.empty() && w->crowd.called.empty() && w->crowd.downed.empty());
    std::printf(
        "%d falls, %d helped up; %d looked, %d stopped; down for %.1f s, palms %.1f mm apart, legs "
        "%.0f mm off, minded for %.1f s, from the knees up in %.2f s, helped in %.2f\n",
        told.falls, told.held, told.glanced, told.watched, wide(told.longest), 1e3 * wide(told.apart),
        1e3 * wide(told.nearest), wide(told.stays), wide(told.rises[0]), wide(told.rises[1]));
    return told;
}

TEST(Bystanders, SomeHelpAndAllGoOn) {
    Told all;
    for (uint64_t seed = 1; seed <= 3; ++seed) {
        const Told told = watched(1, 60, seed);
        all.falls += told.falls, all.held += told.held, all.watched += told.watched;
        all.glanced += told.glanced, all.thanked += told.thanked;
        EXPECT_LT(told.longest, 10);
        EXPECT_LT(told.stays, 15);
        EXPECT_LT(told.apart, 0.03f);
        // By themselves the old are slow as well: all who got up together tell what help saves.
        all.rises[0] += told.rises[0] * static_cast<float>(told.falls - told.held);
        all.rises[1] += told.rises[1] * static_cast<float>(told.held);
    }
    EXPECT_LT(all.rises[1] / static_cast<float>(all.held),
              0.95f * all.rises[0] / static_cast<float>(all.falls - all.held));
    EXPECT_GT(all.held, all.falls / 4);
    EXPECT_GT(all.glanced, all.falls);
    EXPECT_GT(all.watched, all.falls / 4);
    EXPECT_GT(all.thanked, all.held / 2);
}

TEST(Bystanders, NobodyMindsWhereNobodyIsTo) {
    const Told told = watched(0, 30, 4);
    EXPECT_GT(told.falls, 2);
    EXPECT_EQ(told.held + told.glanced + told.watched, 0);
}

TEST(Bystanders, NobodyWalksOverWhoLiesThere) {
    float nearest = 9;
    for (uint64_t seed = 1; seed <= 4; ++seed)
        nearest = std::min(nearest, watched(0.5f, 45, seed + 10, 25).nearest);
    // Who turns over or gets up may stretch a limb to whoever passes.
    expect_at_most("legs nearer than 5 cm to who lies, metres", 0.05 - wide(nearest), 0, 0.08);
}

TEST(Bystanders, AreTheSameOnAllThreadsAndInstructionSetsAndFromAState) {
    constexpr uint32_t k_last = 500, k_kept = 330;
    auto go = [](World& w, uint32_t from, std::vector<std::byte>* kept) {
        bool any = false;
        for (uint32_t t = from; t < k_last; ++t) {
            if (t == k_kept && kept) save_state(w, *kept);
            fell_one(w, t, 120);
            step(w);
            for (const Bystander& b : w.bystanders.all) any |= b.does >= Concern::offers;
        }
        EXPECT_TRUE(any);
        return hash_world(w);
    };
    std::vector<std::byte> kept;
    auto first = world_on(square(20), 40, 5, 1, 1);
    const uint64_t hash = go(*first, 0, &kept);
    for (const int threads : {2, 3})
        EXPECT_EQ(go(*world_on(square(20), 40, 5, threads, 1), 0, nullptr), hash);
    for (const std::string_view isa : isa_names()) {
        ASSERT_TRUE(use_isa(isa));
        EXPECT_EQ(go(*world_on(square(20), 40, 5, 2, 1), 0, nullptr), hash) << isa;
    }
    ASSERT_TRUE(use_isa("best"));
    auto again = world_on(square(20), 40, 5, 2, 1);
    ASSERT_TRUE(load_state(*again, kept));
    EXPECT_EQ(go(*again, k_kept, nullptr), hash);
}

TEST(Bystanders, AllocateNothing) {
    auto w = world_on(square(20), 40, 6, 1, 1);
    make_room_to_fall(*w, 40);
    for (int i = 0; i < 60; ++i) step(*w);
    const size_t before = allocations();
    for (uint32_t t = 0; t < 900; ++t) {
        fell_one(*w, t, 120);
        step(*w);
    }
    EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace flaneur
