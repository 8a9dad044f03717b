#include <gtest/gtest.h>

#include "tests/folder.h"
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
    std::vector<int> told;
    for (int picture = 0; picture < 8; ++picture) told.push_back(next_tap(keys));
    EXPECT_EQ(told, (std::vector<int>{7, 0, 7, 0, 8, 0, 0, 0}));
    keys.taps = {9};
    EXPECT_EQ(next_tap(keys), 9) << "at once after a rest";
}

}  // namespace
}  // namespace flaneur
