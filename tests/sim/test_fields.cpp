// The fields of a state by name: whatever is changed in a state, exactly its walker and field are named.
#include <gtest/gtest.h>

#include <set>

#include "sim/fields.h"
#include "sim/sim.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr uint32_t k_people = 40;

// People with canes and prams among them.
std::unique_ptr<World> some_world(int threads = 1) {
    Kind plain{standard_body(1.75f)}, cane = plain, pram = plain;
    cane.body.cane = standard_cane(1.75f);
    pram.body.pram = standard_pram(plain.body);
    WorldOptions options;
    options.walkers = k_people;
    options.threads = threads;
    options.kinds = {plain, cane, pram};
    Ground ground = square(60);
    index_ground(ground);
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    for (int i = 0; i < 30; ++i) step(**world);
    return std::move(*world);
}

struct Difference {
    std::set<std::string> fields;
    std::set<uint32_t> walkers;
};

Difference difference_of(const World& a, const World& b) {
    const StateFields fields = state_fields(a);
    const std::vector<uint32_t> words_a = state_words(a), words_b = state_words(b);
    StateDigest digest_a, digest_b;
    digest_state(a, digest_a), digest_state(b, digest_b);
    Difference by_words, by_digests;
    const size_t row = fields.walkers.size();
    for (size_t i = 0; i < words_a.size(); ++i) {
        if (words_a[i] == words_b[i]) continue;
        const bool is_crowd = i >= row * k_people;
        by_words.fields.insert(is_crowd ? fields.crowd[i - row * k_people].name
                                        : fields.walkers[i % row].name);
        if (!is_crowd) by_words.walkers.insert(static_cast<uint32_t>(i / row));
    }
    for (size_t i = 0; i < digest_a.fields.size(); ++i)
        if (digest_a.fields[i] != digest_b.fields[i])
            by_digests.fields.insert(i < row ? fields.walkers[i].name : fields.crowd[i - row].name);
    for (uint32_t i = 0; i < k_people; ++i)
        if (digest_a.walkers[i] != digest_b.walkers[i]) by_digests.walkers.insert(i);
    EXPECT_EQ(by_words.fields, by_digests.fields);
    EXPECT_EQ(by_words.walkers, by_digests.walkers);
    EXPECT_EQ(digest_a.hash, hash_world(a));
    EXPECT_EQ(by_words.fields.empty(), hash_world(a) == hash_world(b));
    return by_words;
}

TEST(Fields, AreNamedOnceAndEqualOnAnyNumberOfThreads) {
    const auto one = some_world(1), three = some_world(3);
    const StateFields fields = state_fields(*one);
    std::set<std::string> names;
    for (const auto* list : {&fields.walkers, &fields.crowd})
        for (const StateField& field : *list) EXPECT_TRUE(names.insert(field.name).second) << field.name;
    for (const char* name : {"who.radius", "motion.position.z", "journey.goal.polygon", "gait.left.from.x",
                             "gait.right_hold.weight", "person.girth.3", "pose.rotation.left_foot.w",
                             "cane.tip.y", "pram.now.wheel", "idle.play.phase", "crowd.next_path"})
        EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_EQ(state_words(*one).size(), fields.walkers.size() * k_people + fields.crowd.size());
    EXPECT_TRUE(difference_of(*one, *three).fields.empty());
}

TEST(Fields, WhateverIsChangedIsNamed) {
    const auto was = some_world(), is = some_world();
    ASSERT_FALSE(is->gait.canes.empty());
    ASSERT_FALSE(is->gait.prams.empty());
    Cane& cane = is->gait.canes[0];
    Pram& pram = is->gait.prams[0];
    Crowd& crowd = is->crowd;
    struct Change {
        const char* field;
        uint32_t walker;
        void* place;
    };
    const std::vector<Change> changes = {
        {"motion.turn_rate", 3, &crowd.motion.turn_rate[3]},
        {"decision.claim.heirs", 7, &crowd.decision.claim[7].heirs},
        {"journey.trip", 39, &crowd.journeys[39].trip},
        {"generation", 0, &crowd.slots.generation[0]},
        {"cane.share", cane.walker, &cane.share},
        {"pram.before.pitch", pram.walker, &pram.before.pitch},
        {"idle.stood", 20, &is->idles.stood[20]},
    };
    for (const Change& change : changes) {
        auto& byte = *static_cast<unsigned char*>(change.place);
        byte ^= 1;
        const Difference d = difference_of(*was, *is);
        EXPECT_EQ(d.fields, std::set<std::string>{change.field});
        EXPECT_EQ(d.walkers, std::set<uint32_t>{change.walker}) << change.field;
        byte ^= 1;
    }
    crowd.next_path += 1;
    EXPECT_EQ(difference_of(*was, *is).fields, std::set<std::string>{"crowd.next_path"});
    EXPECT_TRUE(difference_of(*was, *is).walkers.empty());
}

// Of each row of each block one lane.
template <class Block>
void change_rows(std::vector<Block>& blocks, const World& was, const World& is) {
    std::set<std::string> named;
    const size_t rows = sizeof(Block) / (4 * k_block);
    for (size_t row = 0; row < rows; ++row) {
        const auto walker = static_cast<uint32_t>(row * 7 % k_people);
        auto* const bytes = reinterpret_cast<unsigned char*>(&blocks[walker / k_block]);
        unsigned char& byte = bytes[(row * k_block + walker % k_block) * 4];
        byte ^= 1;
        const Difference d = difference_of(was, is);
        ASSERT_EQ(d.fields.size(), 1U) << row;
        EXPECT_EQ(d.walkers, std::set<uint32_t>{walker}) << row;
        named.merge(std::set(d.fields));
        byte ^= 1;
    }
    EXPECT_EQ(named.size(), rows);
}

TEST(Fields, NoRowOfABlockIsForgotten) {
    const auto was = some_world(), is = some_world();
    change_rows(is->gait.blocks, *was, *is);
    change_rows(is->gait.people, *was, *is);
    change_rows(is->poses, *was, *is);
}

TEST(Fields, WordsAreTold) {
    EXPECT_EQ(told_word({"a", 'f'}, 0x3fc00000), "1.5");
    EXPECT_EQ(told_word({"a", 'i'}, ~0U), "-1");
    EXPECT_EQ(told_word({"a", 'u'}, 7), "7");
    EXPECT_EQ(told_word({"a", 'F'}, k_absent), "none");
    EXPECT_EQ(told_word({"a", 'h'}, 0xabc), "abc");
}

}  // namespace
}  // namespace flaneur
