#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/folder.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/settings/panel_keys.h"
#include "tools/flaneur/window/settings/settings.h"

namespace flaneur {
namespace {

TEST(Settings, AreReadAsTheyWereKept) {
    TestFolder folder;
    const std::string file = folder / "deep/settings.json";
    EXPECT_EQ(*read_settings(file), Settings()) << "there is no file";
    EXPECT_EQ(*read_settings(""), Settings());
    for (const Settings& s : {Settings(), Settings{1.3f, true, 30, 0.25f, true, false},
                              Settings{3, false, 240, 3.7f, false, true}}) {
        ASSERT_TRUE(keep_settings(file, s));
        const Result<Settings> read = read_settings(file);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, s);
    }
    EXPECT_FALSE(keep_settings(folder.path.string(), {}));
}

TEST(Settings, OfEarlierAndLaterVersionsCount) {
    EXPECT_EQ(*parse_settings("{}"), Settings());
    const Result<Settings> some = parse_settings(R"({"theme": "light", "wallpaper": [1, 2]})");
    ASSERT_TRUE(some) << some.error().message;
    EXPECT_TRUE(some->is_light);
}

TEST(Settings, ThatAreBrokenAreRefusedByName) {
    TestFolder folder;
    for (const char* text :
         {"", "hello", "[]", "{\"letters\": 9}", "{\"letters\": \"big\"}", "{\"letters\": 0.5}",
          "{\"fps\": 5}", "{\"fps\": 1e99}", "{\"pace\": 0}", "{\"theme\": \"pink\"}", "{\"look\": 3}",
          "{\"theme\": ", "{\"a\":[[[[[[[[[[1]]]]]]]]]]}"}) {
        const std::string file = folder.write("settings.json", text);
        const Result<Settings> read = read_settings(file);
        ASSERT_FALSE(read) << text;
        EXPECT_NE(read.error().message.find(file), std::string::npos) << read.error().message;
    }
}

TEST(PanelKeys, NoTapIsLostAndEachIsOnePictureLong) {
    PanelKeys keys;
    EXPECT_EQ(next_tap(keys), 0);
    keys.taps = {7, 7, 8};
    std::vector<int> told(8);
    for (int& tap : told) tap = next_tap(keys);
    EXPECT_EQ(told, (std::vector<int>{7, 0, 7, 0, 8, 0, 0, 0}));
    keys.taps = {9};
    EXPECT_EQ(next_tap(keys), 9) << "at once after a rest";
}

TEST(Settings, LettersGrowAndShrinkByUsualSizes) {
    EXPECT_FLOAT_EQ(stepped_letters(1, 1), 1.1f);
    EXPECT_FLOAT_EQ(stepped_letters(1.1f, 1), 1.25f);
    EXPECT_FLOAT_EQ(stepped_letters(1.3f, 1), 1.5f);
    EXPECT_FLOAT_EQ(stepped_letters(1.3f, -1), 1.25f);
    EXPECT_FLOAT_EQ(stepped_letters(1.25f, -2), 1);
    EXPECT_FLOAT_EQ(stepped_letters(1, -1), 1);
    EXPECT_FLOAT_EQ(stepped_letters(2.5f, 3), 3);
}

TEST(Settings, LettersHaveKeysAndStopWhereThereIsNoRoom) {
    Show show;
    Viewer v;
    v.layout.wish.window = {640, 480}, v.layout.wish.scale = 1;
    auto press = [&](int key, int mods) {
        v.presses = {{key, mods, false}};
        act_on_presses(show, v);
    };
    press(GLFW_KEY_EQUAL, GLFW_MOD_CONTROL);
    EXPECT_FLOAT_EQ(v.settings.letters, 1.1f) << "from what is shown on";
    press(GLFW_KEY_KP_ADD, GLFW_MOD_CONTROL);
    EXPECT_FLOAT_EQ(v.settings.letters, 1.25f);
    press(GLFW_KEY_EQUAL, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
    EXPECT_FLOAT_EQ(v.settings.letters, 1.5f) << "where + is above =";
    for (int i = 0; i < 9; ++i) press(GLFW_KEY_EQUAL, GLFW_MOD_CONTROL);
    EXPECT_FLOAT_EQ(v.settings.letters, 2) << "640 x 480 has no room for more";
    EXPECT_NE(v.note.find("no room"), std::string::npos) << v.note;
    press(GLFW_KEY_KP_SUBTRACT, GLFW_MOD_CONTROL);
    EXPECT_FLOAT_EQ(v.settings.letters, 1.75f);
    press(GLFW_KEY_KP_0, GLFW_MOD_CONTROL);
    EXPECT_EQ(v.settings.letters, 0);
    EXPECT_EQ(v.clock.rate, 1) << "of time these are other keys";
}

}  // namespace
}  // namespace flaneur
