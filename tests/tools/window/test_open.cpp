#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/folder.h"
#include "tools/flaneur/window/open/complete.h"
#include "tools/flaneur/window/open/pictures.h"
#include "tools/flaneur/window/open/plan.h"
#include "tools/flaneur/window/open/recent.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

using Words = std::vector<std::string>;

TEST(Opening, AMapComesInPlaceOfThePlaceAndItsPeopleStay) {
    TestFolder folder;
    const std::string map = folder.write("town.osm", "<osm/>");
    const Words before = {"--scene",   "square", "--walkers", "70", "--camera=street", "--start",
                          "--quality", "low",    "--scale",   "2",  "--frames",        "9"};
    const Result<ShowWish> wish = wish_for_file(before, map);
    ASSERT_TRUE(wish) << wish.error().message;
    EXPECT_EQ(wish->words, (Words{"--walkers", "70", "--quality", "low", "--city", map}));
    EXPECT_EQ(wish->options.scene.city, map);
    EXPECT_EQ(wish->options.scene.walkers, 70);
    EXPECT_EQ(wish->file, map);
}

TEST(Opening, ASceneComesInPlaceOfAll) {
    TestFolder folder;
    const std::string scene = folder.write("mine.json", R"({"walkers": 12, "blocks": 1})");
    const Words before = {"--city", "x.osm", "--walkers=70", "--character", "me.glb", "--device", "llvm"};
    const Result<ShowWish> wish = wish_for_file(before, scene);
    ASSERT_TRUE(wish) << wish.error().message;
    EXPECT_EQ(wish->words, (Words{"--device", "llvm", "--scene", scene}));
    EXPECT_EQ(wish->options.scene.walkers, 12);
    const Result<ShowWish> square = wish_for_scene(before, "square");
    ASSERT_TRUE(square) << square.error().message;
    EXPECT_EQ(square->words, (Words{"--device", "llvm", "--scene", "square"}));
    EXPECT_TRUE(square->file.empty());
}

TEST(Opening, ACourseIsLaidOutAnewWithThosePeople) {
    const Words before = {"--scene=stepper", "--device", "llvm", "--seed", "3", "--camera", "follow:1"};
    const Result<ShowWish> flat = wish_for_course(before, true, 9, 7);
    ASSERT_TRUE(flat) << flat.error().message;
    EXPECT_TRUE(flat->options.scene.flat);
    EXPECT_EQ(flat->options.scene.walkers, 9);
    EXPECT_EQ(flat->options.scene.seed, 7u);
    EXPECT_EQ(flat->options.device, "llvm");
    const Result<ShowWish> round = wish_for_course(flat->words, false, 110, 7);
    ASSERT_TRUE(round) << round.error().message;
    EXPECT_FALSE(round->options.scene.flat);
    EXPECT_EQ(round->options.scene.walkers, k_course_walkers) << "who find room";
}

TEST(Opening, ACharacterJoinsThePeople) {
    TestFolder folder;
    const std::string me = folder.write("me.vrm", "no matter what"),
                      you = folder.write("you:2.vrm", "as well");
    const Result<ShowWish> one = wish_for_file({"--walkers", "9", "--camera", "follow:3"}, me);
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_EQ(one->options.scene.people, (std::vector<PeopleShare>{{"", 1}, {me, 1}}));
    EXPECT_EQ(one->options.scene.walkers, 9);
    const Result<ShowWish> two = wish_for_file(one->words, you);
    ASSERT_TRUE(two) << two.error().message;
    EXPECT_EQ(two->options.scene.people, (std::vector<PeopleShare>{{"", 1}, {me, 1}, {you, 1}}));
    EXPECT_FALSE(wish_for_file(two->words, me)) << "nobody joins twice";
    EXPECT_NE(two->told.find("one in 3"), std::string::npos) << two->told;
}

TEST(Opening, HeightsGoUnderAMapAlone) {
    TestFolder folder;
    const std::string map = folder.write("town.osm", "<osm/>"), heights = folder.write("N43E007.hgt", "");
    for (const std::vector<std::string>& words : {std::vector<std::string>{}, {"--scene", "square"}}) {
        const Result<ShowWish> alone = wish_for_file(words, heights);
        ASSERT_FALSE(alone);
        EXPECT_EQ(alone.error().message.find("--"), std::string::npos) << "as a window says it";
        EXPECT_NE(alone.error().message.find("open an .osm"), std::string::npos) << alone.error().message;
    }
    const Result<ShowWish> wish = wish_for_file({"--city", map, "--terrain", "old.hgt"}, heights);
    ASSERT_TRUE(wish) << wish.error().message;
    EXPECT_EQ(wish->options.scene.terrain, heights);
}

TEST(Opening, OtherFilesAreRefusedByName) {
    TestFolder folder;
    for (const std::string& path :
         {folder.write("notes.txt", "hello"), folder / "nowhere.osm", folder.path.string()})
        EXPECT_FALSE(wish_for_file({}, path)) << path;
    const Result<ShowWish> bad = wish_for_file({}, folder.write("bad.json", "{\"walkers\": -3}"));
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message.find("bad.json"), std::string::npos) << bad.error().message;
}

TEST(Recent, KeepsOrderAndBound) {
    Words paths;
    for (int i = 0; i < 30; ++i) remember(paths, "/maps/" + std::to_string(i) + ".osm");
    EXPECT_EQ(paths.size(), k_most_recent);
    EXPECT_EQ(paths.front(), "/maps/29.osm");
    remember(paths, "/maps/25.osm");
    EXPECT_EQ(paths.size(), k_most_recent);
    EXPECT_EQ(paths.front(), "/maps/25.osm");
    EXPECT_EQ(std::count(paths.begin(), paths.end(), "/maps/25.osm"), 1);
    remember(paths, "relative.osm");
    remember(paths, "/a\nb.osm");
    EXPECT_EQ(paths.front(), "/maps/25.osm");
    TestFolder folder;
    const std::string file = folder / "deep/down/recent";
    EXPECT_TRUE(read_recent(file).empty());
    keep_recent(file, paths);
    EXPECT_EQ(read_recent(file), paths);
}

TEST(Recent, MakesWhatItCanOfABrokenFile) {
    TestFolder folder;
    using namespace std::string_literals;
    std::string text = "/a.osm\n/a.osm\nnot a path\n\x01\x02\n/b.osm\n/c\0d"s;
    for (int i = 0; i < 100; ++i) text += "\n/more/" + std::to_string(i);
    const Words read = read_recent(folder.write("recent", text));
    ASSERT_GE(read.size(), 2u);
    EXPECT_EQ(read[0], "/a.osm");
    EXPECT_EQ(read[1], "/b.osm");
    EXPECT_EQ(read.size(), k_most_recent);
    EXPECT_TRUE(read_recent(folder.path.string()).empty());
    EXPECT_TRUE(read_recent("").empty());
    keep_recent(folder.path.string(), read);  // cannot be written: nothing happens
    keep_recent("", read);
}

TEST(Complete, OffersFoldersAndWhatCanBeOpened) {
    TestFolder folder;
    std::filesystem::create_directory(folder.path / "towns");
    std::filesystem::create_directory(folder.path / ".hidden");
    for (const char* name : {"berlin.osm", "bern.osm.pbf", "notes.txt", "me.GLB", "mine.json"})
        static_cast<void>(folder.write(name, ""));
    const std::string at = folder / "";
    EXPECT_EQ(completions(at), (Words{at + "towns/", at + "berlin.osm", at + "bern.osm.pbf", at + "me.GLB",
                                      at + "mine.json"}));
    EXPECT_EQ(completions(at + "be"), (Words{at + "berlin.osm", at + "bern.osm.pbf"}));
    EXPECT_EQ(completed(at + "be", completions(at + "be")), at + "ber");
    EXPECT_EQ(completed(at + "t", completions(at + "t")), at + "towns/");
    EXPECT_EQ(completions(at + ".h"), Words{at + ".hidden/"});
    EXPECT_EQ(completed("x", {}), "x");
    EXPECT_TRUE(completions(folder / "nowhere/x").empty());
    EXPECT_EQ(completions(at, 2).size(), 2u);
    setenv("HOME", folder.path.c_str(), 1);
    EXPECT_EQ(completions("~/bern"), Words{"~/bern.osm.pbf"});
    EXPECT_EQ(full_path("~/a/../b.osm"), folder / "b.osm");
}

TEST(Complete, TabGoesAsFarAsTwoFilesAgree) {
    TestFolder folder;
    for (const char* name : {"town_north.osm", "town_south.osm", "village.osm"})
        static_cast<void>(folder.write(name, ""));
    Show show;
    Viewer v;
    PathPrompt& prompt = v.opening.prompt;
    prompt.is_open = true;
    const std::string at = folder / "";
    prompt.looked_for = at, prompt.found = completions(at);  // before the last letter was typed
    std::snprintf(prompt.typed, sizeof prompt.typed, "%st", at.c_str());
    EXPECT_TRUE(press_in_opening(GLFW_KEY_TAB, 0, show, v));
    EXPECT_EQ(prompt.becomes, at + "town_");
    EXPECT_EQ(prompt.found, (Words{at + "town_north.osm", at + "town_south.osm"})) << "and they are listed";
}

TEST(Complete, KnowsTheFolderAbove) {
    EXPECT_EQ(folder_above("/a/b/"), "/a/");
    EXPECT_EQ(folder_above("/a/b/town"), "/a/") << "of the folder that is listed";
    EXPECT_EQ(folder_above("/a/"), "/");
    EXPECT_EQ(folder_above("/"), "");
    EXPECT_EQ(folder_above("/town"), "");
    EXPECT_EQ(folder_above(""), std::filesystem::current_path().parent_path().string() + "/");
}

TEST(Complete, TheFolderAboveIsChosenButNotTyped) {
    TestFolder folder;
    static_cast<void>(folder.write("town.osm", ""));
    Show show;
    Viewer v;
    PathPrompt& prompt = v.opening.prompt;
    prompt.is_open = true;
    const std::string at = folder / "", above = folder.path.parent_path().string() + "/";
    std::snprintf(prompt.typed, sizeof prompt.typed, "%s", at.c_str());
    press_in_opening(GLFW_KEY_TAB, 0, show, v);
    EXPECT_EQ(prompt.becomes, at + "town.osm") << "Tab completes among what is here";
    press_in_opening(GLFW_KEY_DOWN, 0, show, v);
    EXPECT_EQ(prompt.rows, (Words{above, at + "town.osm"}));
    press_in_opening(GLFW_KEY_ENTER, 0, show, v);
    EXPECT_EQ(prompt.becomes, above);
    EXPECT_TRUE(prompt.is_open);
}

TEST(Opening, EveryBuiltInSceneHasAPicture) {
    const std::vector<RgbaImage> pictures = scene_pictures();
    const std::vector<std::string> names = scene_names();
    ASSERT_EQ(pictures.size(), names.size());
    for (size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(pictures[i].width, 416u) << names[i] << ": tools/scene_pictures draws them";
        EXPECT_EQ(pictures[i].height, 234u) << names[i];
    }
}

TEST(Complete, BeginsWhereTheLastFileWasOrHere) {
    TestFolder folder;
    Show show;
    Viewer v;
    v.opening.recent = {folder / "town.osm"};
    ask_for_path(show, v);
    EXPECT_EQ(v.opening.prompt.typed, folder / "");
    v.opening.recent = {folder / "gone/town.osm"};
    ask_for_path(show, v);
    EXPECT_EQ(v.opening.prompt.typed, std::filesystem::current_path().string() + "/");
}

}  // namespace
}  // namespace flaneur
