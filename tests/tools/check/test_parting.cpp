// Two runs of which one is disturbed part at that tick, in that walker and that field.
#include <gtest/gtest.h>

#include <bit>

#include "sim/sim.h"
#include "tests/sim/small_grounds.h"
#include "tools/flaneur/check/parting.h"

namespace flaneur {
namespace {

constexpr uint32_t k_people = 30;

std::unique_ptr<World> some_world() {
    Ground ground = square(60);
    index_ground(ground);
    WorldOptions options;
    options.walkers = k_people;
    options.threads = 1;
    options.kinds = {Kind{standard_body(1.75f)}};
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

// Steps both until they differ; `disturb` is called after each step.
template <class Disturb>
std::pair<Parting, Parting> partings(const Disturb& disturb) {
    const auto here = some_world(), there = some_world();
    const StateFields fields = state_fields(*here);
    const CommonFields common = common_fields(fields, fields);
    const StatePair pair{fields, fields, common};
    StateDigest a, b;
    for (;;) {
        digest_state(*here, a), digest_state(*there, b);
        if (are_different(pair, a, b) || here->tick == 200) break;
        step(*here), step(*there);
        disturb(*there);
    }
    return {parting_of(pair, here->tick, a, b),
            parting_of(pair, here->tick, k_people, state_words(*here), state_words(*there))};
}

TEST(Parting, ADisturbedFieldIsNamedWithBothValues) {
    float was = 0;
    const auto [by_digests, by_words] = partings([&](World& w) {
        if (w.tick != 77) return;
        float& number = w.gait.blocks[1].feet[k_right].phase[5];
        was = number;
        number += 0.25f;
    });
    for (const Parting& parting : {by_digests, by_words}) {
        EXPECT_EQ(parting.tick, 77U);
        EXPECT_EQ(told_first(parting), "walker 21, gait.right.phase");
        EXPECT_EQ(parting.walkers, std::vector<uint32_t>{21});
        ASSERT_EQ(parting.fields.size(), 1U);
    }
    const FieldDifference& d = by_words.fields[0];
    ASSERT_TRUE(d.here && d.there);
    EXPECT_EQ(told_word(d.field, *d.here), told_word({"", 'f'}, std::bit_cast<uint32_t>(was)));
    EXPECT_EQ(told_word(d.field, *d.there), told_word({"", 'f'}, std::bit_cast<uint32_t>(was + 0.25f)));
    EXPECT_FALSE(by_digests.fields[0].here);
}

TEST(Parting, TheFirstFieldIsWhatATickMakesFirst) {
    // In one and the same tick, in the order against the tick's.
    const auto [by_digests, by_words] = partings([](World& w) {
        if (w.tick != 5) return;
        w.poses[0].rising[3] += 1;
        w.gait.blocks[0].load[9] += 1;
        w.crowd.motion.feet[9].lands += 1;
        w.crowd.decision.wanted[9].x += 1;
        w.crowd.decision.wanted[11].x += 1;
    });
    EXPECT_EQ(told_first(by_words), "walker 9, decision.wanted.x");
    EXPECT_EQ(by_words.walkers, (std::vector<uint32_t>{3, 9, 11}));
    EXPECT_EQ(by_words.fields[0].walkers, 2U);
    EXPECT_EQ(by_words.fields[1].field.name, "gait.load");
    EXPECT_EQ(by_words.fields[2].field.name, "motion.feet.lands");
    EXPECT_EQ(by_words.fields[3].field.name, "pose.rising");
    EXPECT_EQ(told_first(by_digests), "decision.wanted.x, among walkers 3 9 11");
    const std::string told = told_parting(by_words, k_people, {});
    EXPECT_NE(told.find("after tick 5, at 0.083 s: walker 9, decision.wanted.x"), std::string::npos) << told;
}

TEST(Parting, NothingDiffersInEqualRuns) {
    const auto [by_digests, by_words] = partings([](World&) {});
    EXPECT_EQ(by_digests.tick, 200U);
    EXPECT_TRUE(by_digests.fields.empty() && by_digests.walkers.empty());
    EXPECT_TRUE(by_words.fields.empty() && by_words.walkers.empty());
}

TEST(Parting, BuildsWithOtherFieldsAreComparedByThoseThatBothHave) {
    const StateFields here{{{"a", 'f'}, {"new", 'f'}, {"b", 'u'}}, {{"crowd.count", 'u'}}};
    const StateFields there{{{"b", 'u'}, {"a", 'f'}, {"old", 'f'}}, {{"crowd.count", 'u'}}};
    const CommonFields common = common_fields(here, there);
    EXPECT_FALSE(are_all(common));
    EXPECT_EQ(common.only_here, std::vector<std::string>{"new"});
    EXPECT_EQ(common.only_there, std::vector<std::string>{"old"});
    const StatePair pair{here, there, common};
    // Two walkers; hashes and digests of walkers differ, for fields do.
    StateDigest a{1, {10, 11, 12, 2}, {1, 2}}, b{2, {12, 10, 13, 2}, {3, 4}};
    EXPECT_FALSE(are_different(pair, a, b));
    b.fields[0] = 99;
    EXPECT_TRUE(are_different(pair, a, b));
    EXPECT_EQ(told_first(parting_of(pair, 3, a, b)), "b");
    const Parting parting = parting_of(pair, 3, 2, {1, 0, 5, 2, 0, 6, 2}, {5, 1, 0, 7, 2, 0, 2});
    EXPECT_EQ(told_first(parting), "walker 1, b");
    EXPECT_NE(told_parting(parting, 2, common).find("Fields there alone: "), std::string::npos);
}

}  // namespace
}  // namespace flaneur
