#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "tools/flaneur/window/actions.h"

namespace flaneur {
namespace {

TEST(Actions, HaveNamesAndKeysOfTheirOwn) {
    std::set<std::string> names;
    std::set<std::pair<int, int>> keys;
    for (const ActionGroup& group : action_groups())
        for (const Action& action : group.actions) {
            ASSERT_NE(action.act, nullptr) << action.name;
            EXPECT_TRUE(names.insert(action.name).second) << action.name << " is there twice";
            EXPECT_EQ(action.key != 0, *action.keys != 0)
                << action.name << ": a key that is not told, or none";
            const bool is_own = action.key == 0 || keys.insert({action.key, action.mods}).second;
            EXPECT_TRUE(is_own) << action.keys << " does two things";
        }
    EXPECT_GT(names.size(), 20u);
}

TEST(Actions, AreFoundByWhatOneTypes) {
    EXPECT_GT(match("", "Stop or go"), 0);
    EXPECT_GT(match("stop", "Stop or go"), match("sog", "Stop or go"));
    EXPECT_GT(match("sog", "Stop or go"), match("tpr", "Stop or go"));
    EXPECT_GT(match("DENS", "Layer: density"), 0);
    EXPECT_GT(match("layer dens", "Layer: density"), 0);
    EXPECT_EQ(match("stopp", "Stop or go"), 0);
    EXPECT_EQ(match("og s", "Stop or go"), 0);
}

TEST(Actions, ClickWithoutAMouse) {
    const Action* click = nullptr;
    for (const ActionGroup& group : action_groups())
        for (const Action& action : group.actions)
            if (std::string(action.keys) == "K") click = &action;
    ASSERT_TRUE(click);
    Show show;
    Viewer v;
    v.layout.wish.window = {800, 600};
    click->act(show, v);
    take_events(v.events.mouse, v.events.pointer);
    EXPECT_EQ(v.events.pointer.x, 400);
    EXPECT_EQ(v.events.pointer.y, 300);
    EXPECT_FALSE(v.events.pointer.is_down[0]) << "one sees first what would be clicked";
    click->act(show, v);
    take_events(v.events.mouse, v.events.pointer);
    EXPECT_TRUE(v.events.pointer.is_down[0]);
    take_events(v.events.mouse, v.events.pointer);
    EXPECT_FALSE(v.events.pointer.is_down[0]);
}

}  // namespace
}  // namespace flaneur
