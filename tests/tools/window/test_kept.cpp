#include <gtest/gtest.h>
#include <imgui.h>
#include <stdlib.h>

#include "tests/folder.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/kept/kept.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

CameraChoice place(float x) { return {CameraChoice::Kind::fixed, 0, {x, 1.7f, 0.1f}, {x + 1, 1.5f, 2}}; }

Bookmark bookmark(const char* name, CameraChoice choice, float fov) {
    Bookmark b{choice, fov, {}};
    std::snprintf(b.name, sizeof b.name, "%s", name);
    return b;
}

TEST(Kept, IsReadAsItWasTold) {
    Kept kept;
    kept.bookmarks[0] = bookmark("the \"corner\"", place(12.3456f), 0);
    CameraChoice map;
    map.kind = CameraChoice::Kind::map, map.middle = {3, -4}, map.across = 120, map.bearing = 30;
    kept.bookmarks[8] = bookmark("", map, fov_of(40));
    CameraChoice follow;
    follow.kind = CameraChoice::Kind::follow, follow.walker = 12;
    kept.runs = {{"one", {{0, "Mark 1", place(-5), 0}, {361, "two meet", follow, fov_of(28)}}}, {"none", {}}};
    const Result<Kept> read = parse_kept(told(kept));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, kept);
    EXPECT_EQ(*parse_kept("{}"), Kept());
    EXPECT_EQ(*parse_kept(R"({"later": [1]})"), Kept());
}

TEST(Kept, RefusesWhatIsNone) {
    for (const char* text :
         {"", "[]", "{", R"({"bookmarks": 3})", R"({"bookmarks": [3]})", R"({"bookmarks": [{"number": 10}]})",
          R"({"bookmarks": [{"number": 1}]})", R"({"bookmarks": [{"number": 1, "camera": "sideways"}]})",
          R"({"bookmarks": [{"number": 1, "camera": "street", "fov": 900}]})", R"({"runs": [{"run": "a"}]})",
          R"({"runs": [{"run": "a", "marks": [{"tick": -1, "camera": "street"}]}]})"})
        EXPECT_FALSE(parse_kept(text)) << text;
    EXPECT_FALSE(parse_kept(std::string(100'000, '[')));
    const TestFolder folder;
    EXPECT_EQ(*read_kept(folder / "nowhere"), Kept());
    EXPECT_EQ(*read_kept(""), Kept());
    const std::string file = folder.write("kept.json", "{");
    const Result<Kept> read = read_kept(file);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find(file), std::string::npos) << read.error().message;
}

// A window of a scene, as it is opened; files are in a folder of the test's own.
struct Opened {
    explicit Opened(int walkers = 20, uint64_t seed = 1) {
        show.loaded = loaded_scene("corner", walkers, 1, seed);
        Options options;
        options.scene = load_scene("corner").value();
        options.scene.walkers = walkers, options.scene.seed = seed;
        begin_cameras(options.scene, v);
        start_changes(options, show, v);
        begin_run(v.time, *show.loaded.world);
        v.is_loading = false;
        recall(show, v);
    }
    void act(std::span<const Action> actions, const char* name) {
        for (const Action& action : actions)
            if (std::string(action.name) == name) return action.act(show, v);
        FAIL() << name;
    }
    Show show;
    Viewer v;
};

class KeptScene : public testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();
        setenv("XDG_STATE_HOME", folder.path.c_str(), 1);
    }
    void TearDown() override {
        unsetenv("XDG_STATE_HOME");
        ImGui::DestroyContext();
    }
    TestFolder folder;
};

TEST_F(KeptScene, IsThereAgain) {
    {
        Opened window;
        window.v.camera.eye = {1, 2, 3}, window.v.camera.target = {4, 2, 3};
        take_off(window.v);
        window.act(bookmark_actions(), "Keep this camera as 2");
        for (int i = 0; i < 90; ++i) make_tick(window.show, window.v);
        window.act(time_actions(), "Mark this moment");
        keep_what_is_kept(window.v);
    }
    Opened again;
    ASSERT_TRUE(again.v.cameras.bookmarks[1]);
    EXPECT_EQ(again.v.cameras.bookmarks[1]->choice.eye, (Vec3{1, 2, 3}));
    ASSERT_EQ(again.v.time.marks.size(), 1u);
    EXPECT_EQ(again.v.time.marks[0].tick, 90u);
    again.act(time_actions(), "To the next mark");
    EXPECT_EQ(again.v.choice, again.v.time.marks[0].choice) << "with its camera";
    double now = 0;
    while (go_on(again.show, again.v, ++now)) {
    }
    EXPECT_EQ(again.show.loaded.world->tick, 90u);

    Opened other(20, 2);
    EXPECT_TRUE(other.v.cameras.bookmarks[1]) << "the city is the same";
    EXPECT_TRUE(other.v.time.marks.empty()) << "the run is another";
    EXPECT_TRUE(Opened(21).v.time.marks.empty());
    other.act(time_actions(), "Mark this moment");
    keep_what_is_kept(other.v);
    Opened last;
    EXPECT_EQ(last.v.time.marks.size(), 1u) << "each run has its own";
    last.v.time.marks.clear();
    last.v.cameras.bookmarks[1].reset();
    keep_what_is_kept(last.v);
    EXPECT_TRUE(Opened().v.time.marks.empty());
    EXPECT_FALSE(Opened().v.cameras.bookmarks[1]);
    EXPECT_EQ(Opened(20, 2).v.time.marks.size(), 1u);
}

TEST_F(KeptScene, IsNotOfARunThatWasChangedByHand) {
    {
        Opened window;
        window.v.change.late = 60;
        window.act(time_actions(), "Mark this moment");
        keep_what_is_kept(window.v);
    }
    EXPECT_TRUE(Opened().v.time.marks.empty());
}

TEST(Kept, IsOfACityAndARun) {
    setenv("XDG_STATE_HOME", "/somewhere", 1);
    Scene scene;
    const std::string file = kept_file(scene), run = run_name(scene, 1);
    EXPECT_TRUE(file.starts_with("/somewhere/flaneur/scenes/")) << file;
    Scene other = scene;
    other.name = "called otherwise", other.size = {10, 10}, other.fov = 1, other.camera = place(1);
    EXPECT_EQ(kept_file(other), file);
    EXPECT_EQ(run_name(other, 1), run);
    EXPECT_NE(run_name(other, 2), run);
    other.mix.children = 2;
    EXPECT_EQ(kept_file(other), file);
    EXPECT_NE(run_name(other, 1), run);
    other.mix = {}, other.walkers = 3;
    EXPECT_EQ(kept_file(other), file);
    EXPECT_NE(run_name(other, 1), run);
    other.blocks = 7;
    EXPECT_NE(kept_file(other), file);
    unsetenv("XDG_STATE_HOME");
}

}  // namespace
}  // namespace flaneur
