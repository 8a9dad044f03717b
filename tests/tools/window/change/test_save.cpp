#include <gtest/gtest.h>

#include "assets/scene.h"
#include "tests/folder.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

TEST(Saving, CompletesANameAndTellsIt) {
    const TestFolder folder;
    Show show;
    show.loaded = loaded_scene("corner", 12);
    Options options;
    options.scene = load_scene("corner").value();
    options.scene.walkers = 12;
    Viewer v;
    start_changes(options, show, v);
    for (const char* name : {"plan", "evening.json", "v1.2"}) {
        const std::string typed = folder / name, path = typed.ends_with(".json") ? typed : typed + ".json";
        const Result<std::string> told = save_scene(show, v, typed);
        ASSERT_TRUE(told) << told.error().message;
        EXPECT_NE(told->find("Wrote " + path + ";"), std::string::npos) << *told;
        const Result<Scene> scene = load_scene(path);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->walkers, 12);
    }
    for (const std::string& typed : {std::string(), folder.path.string() + "/"}) {
        const Result<std::string> told = save_scene(show, v, typed);
        ASSERT_FALSE(told);
        EXPECT_NE(told.error().message.find("needs a name"), std::string::npos) << told.error().message;
    }
}

}  // namespace
}  // namespace flaneur
