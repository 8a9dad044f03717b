// The window's switches of what makes bodies: they reach what is drawn, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/tools/loaded.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/ask/techniques.h"
#include "tools/flaneur/window/command.h"
#include "tools/flaneur/window/time/beside.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

struct Watched {
    Show show;
    Viewer viewer;
};
std::unique_ptr<Watched> watched() {
    auto w = std::make_unique<Watched>();
    w->show.loaded = loaded_scene("corner", 30, 1);
    return w;
}

// Of everybody, a third of a tick after the one before.
std::vector<JointTransform> drawn(Watched& w) {
    follow_switches(w.viewer.techniques, w.show);
    const Show& show = w.show;
    if (!show.draws_whole) catch_up(w.show.without, *show.loaded.world);
    PeopleFrame people;
    extract_people(*show.loaded.world, show.loaded.characters, people, 0.3f, {},
                   show.draws_whole ? nullptr : &show.without);
    return people.palette;
}

bool are_same(const std::vector<JointTransform>& a, const std::vector<JointTransform>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST(TechniqueSwitches, ChangeWhatIsDrawnAndNotTheWalk) {
    auto w = watched(), alone = watched();
    for (int t = 0; t < 200; ++t) {
        w->viewer.techniques.on.feet = t < 100;
        follow_switches(w->viewer.techniques, w->show);
        step(w->show);
        step(alone->show);
    }
    EXPECT_EQ(hash_world(*w->show.loaded.world), hash_world(*alone->show.loaded.world));
    EXPECT_EQ(w->show.without.tick + 1, w->show.loaded.world->tick);
    const auto without = drawn(*w), whole = drawn(*alone);
    EXPECT_FALSE(are_same(without, whole));
    w->viewer.techniques.is_split = true;
    EXPECT_TRUE(are_same(drawn(*w), whole)) << "the left half";
    w->viewer.techniques.is_split = false;
    EXPECT_TRUE(are_same(drawn(*w), without)) << "the right half";
    w->viewer.techniques.on = {};
    EXPECT_TRUE(are_same(drawn(*w), whole));
}

TEST(TechniqueSwitches, BeforeAndAfterTakesThePlaceOfAnotherRun) {
    auto w = watched();
    Viewer& v = w->viewer;
    v.time.first_seed = w->show.loaded.world->seed;
    EXPECT_EQ(size_of_one(v, {1000, 500}).width, 1000);
    EXPECT_EQ(why_no_command(v, *w->show.loaded.world), "");
    v.time.beside = std::make_unique<Beside>();
    split_techniques(w->show, v);
    EXPECT_FALSE(v.time.beside);
    EXPECT_TRUE(has_two(v));
    EXPECT_LT(size_of_one(v, {1000, 500}).width, 501);
    EXPECT_NE(why_no_command(v, *w->show.loaded.world), "");
    split_techniques(w->show, v);
    EXPECT_FALSE(has_two(v));
}

TEST(TechniqueSwitches, CurvesSayWhatTheyAreOf) {
    Techniques on;
    EXPECT_EQ(told_off(on), "");
    EXPECT_EQ(told_of_curves(on), "Curves: the walk, all techniques on.");
    on.feet = on.look = false;
    EXPECT_EQ(told_off(on), "without feet, look");
    EXPECT_EQ(told_of_curves(on),
              "Curves: the walk, all techniques on; bodies are drawn without feet, look.");
}

}  // namespace
}  // namespace flaneur
