// Who comes: shares of people that are changed while others walk, undone and saved.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/loaded.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

struct Sorts {
    int all = 0, children = 0, old = 0, canes = 0, prams = 0, phones = 0;
};
Sorts sorts_of(const Show& show) {
    Sorts sorts;
    const World& world = *show.loaded.world;
    for (const WalkerId id : walkers(world)) {
        const PersonOptions& person = show.loaded.characters[world.crowd.identity.body[id.index]].person;
        ++sorts.all;
        sorts.children += person.age < 14, sorts.old += person.age >= 65, sorts.canes += person.stick;
        sorts.prams += person.pram, sorts.phones += person.phone;
    }
    return sorts;
}

Options options_of(const PeopleMix& mix, int people) {
    Options options;
    options.scene = load_scene("corner").value();
    options.scene.walkers = people;
    options.scene.mix = mix;
    options.threads = 1;
    return options;
}

struct Opened {
    Options options;
    Show show;
    Viewer viewer;
};
std::unique_ptr<Opened> opened(const PeopleMix& mix, int people) {
    auto o = std::make_unique<Opened>();
    o->options = options_of(mix, people);
    Result<Loaded> loaded = load(o->options);
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().message);
    o->show.loaded = std::move(*loaded);
    start_changes(o->options, o->show, o->viewer);
    begin_run(o->viewer.time, *o->show.loaded.world);
    return o;
}

TEST(WhoComes, ASceneSaysHowManyOfEachSort) {
    const Sorts usual = sorts_of(opened({}, 300)->show);
    const Sorts none =
        sorts_of(opened({.children = 0, .old = 0, .canes = 0, .prams = 0, .phones = 0}, 300)->show);
    EXPECT_EQ(none.all, 300);
    EXPECT_EQ(none.children + none.old + none.canes + none.prams + none.phones, 0);
    const Sorts many = sorts_of(opened({.children = 4, .prams = 5}, 300)->show);
    EXPECT_GT(many.children, 2 * usual.children);
    EXPECT_GT(many.prams, 2 * usual.prams);
    EXPECT_GT(usual.children, 0);
    EXPECT_GT(usual.prams, 0);
}

TEST(WhoComes, AsUsualIsAsEver) {
    auto o = opened({}, 60);
    const World& world = *o->show.loaded.world;
    for (size_t i = 0; i < world.kinds.size(); ++i) {
        EXPECT_EQ(world.kinds[i].share, o->show.loaded.parts[i].share);
        EXPECT_EQ(world.folk[i].share, world.kinds[i].share);
    }
}

TEST(WhoComes, ThoseWhoComeObeyAndThoseWhoAreThereStay) {
    auto o = opened({}, 100);
    const Sorts before = sorts_of(o->show);
    Design next = current(o->viewer.change.designs);
    next.mix.children = 10;
    next.mix.prams = 0;
    want(o->viewer, next);
    ASSERT_TRUE(carry_on(o->show, o->viewer));
    const Sorts same = sorts_of(o->show);
    EXPECT_EQ(same.children, before.children);
    EXPECT_EQ(same.prams, before.prams);
    next.people = 200;
    want(o->viewer, next);
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(carry_on(o->show, o->viewer));
    const Sorts after = sorts_of(o->show);
    ASSERT_EQ(after.all, 200);
    EXPECT_EQ(after.prams, before.prams);
    EXPECT_GT(after.children - before.children, 40);
    undo_last(o->show, o->viewer);
    undo_last(o->show, o->viewer);
    ASSERT_TRUE(carry_on(o->show, o->viewer));
    EXPECT_EQ(o->show.loaded.world->folk[0].share, o->show.loaded.parts[0].share);
}

TEST(WhoComes, IsSavedInTheScene) {
    auto o = opened({}, 20);
    Design next = current(o->viewer.change.designs);
    next.mix = {.children = 2, .old = 0.5f, .canes = 3, .prams = 0, .phones = 1.5f};
    next.who = {{"", 3}, {"robot.glb", 1}};
    want(o->viewer, next);
    o->viewer.change.scene.fov = fov_of(47.3);
    const Scene saved = changed_scene(o->show, o->viewer, "");
    const Result<Scene> read = parse_scene(scene_text(saved), "it");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->mix, next.mix);
    EXPECT_EQ(read->people, next.who);
    EXPECT_EQ(read->fov, saved.fov);
    EXPECT_FALSE(parse_scene(R"({"prams": -1})", "it"));
    EXPECT_FALSE(parse_scene(R"({"children": 11})", "it"));
}

TEST(WhoComes, PartsOfFilesCountAgainstEachOther) {
    Character plain;
    const std::vector<Character> characters(3, plain);
    const std::vector<PeopleShare> parts = {{"", 0.25f}, {"", 0.75f}, {"robot.glb", 1}};
    const std::vector<float> shares = shares_of({{"", 3}, {"robot.glb", 1}, {"", 1}}, {}, characters, parts);
    EXPECT_EQ(shares, (std::vector<float>{1, 3, 1}));
    EXPECT_EQ(shares_of({}, {}, {plain, plain}, {parts[0], parts[1]}), (std::vector<float>{0.25f, 0.75f}));
}

}  // namespace
}  // namespace flaneur
