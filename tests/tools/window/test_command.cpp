#include <gtest/gtest.h>

#include "tools/flaneur/window/command.h"

namespace flaneur {
namespace {

Shown shown() {
    Shown s;
    s.choice.kind = CameraChoice::Kind::fixed;
    s.camera.eye = {1.5f, 1.7f, -0.1f};
    s.camera.target = {2, 1.25f, 3};
    s.size = {800, 600};
    s.tick = 361;
    return s;
}

TEST(Command, DrawsWhatIsSeen) {
    EXPECT_EQ(
        command_of({"--walkers", "2000", "--seed=7"}, shown()),
        "flaneur render --walkers 2000 --seed=7 --camera 1.5,1.7,-0.1/2,1.25,3 --size 800x600 --frames 361 "
        "--out picture.png");
}

TEST(Command, ReplacesWhatIsSeenOtherwise) {
    Shown s = shown();
    s.choice = {CameraChoice::Kind::follow, 12, {}, {}};
    s.views = toggled(toggled({}, WorkView::density), WorkView::skeletons);
    EXPECT_EQ(
        command_of(
            {"--camera", "overview", "--size=10x10", "--view", "lods", "--close-after", "3", "--validate"},
            s),
        "flaneur render --validate --camera follow:12 --view density,skeletons --size 800x600 --frames 361 "
        "--out picture.png");
    EXPECT_EQ(command_of({"--camera"}, s), command_of({}, s));
}

TEST(Command, NamesASceneThatHoldsWhatWasChanged) {
    Shown s = shown();
    s.scene = "out/view-361.json";
    EXPECT_EQ(
        command_of({"--scene", "corner", "--time=21:00", "--walkers", "9", "--threads", "2"}, s),
        "flaneur render --threads 2 --scene out/view-361.json --camera 1.5,1.7,-0.1/2,1.25,3 --size 800x600 "
        "--frames 361 --out picture.png");
    s.scene.clear();
    s.is_overcast = true;
    EXPECT_EQ(command_of({"--weather", "clear", "--walkers", "9"}, s).substr(0, 51),
              "flaneur render --walkers 9 --weather overcast --cam");
}

TEST(Command, QuotesForAShell) {
    EXPECT_EQ(command_of({"--city", "my town's map.osm", ""}, shown()).substr(0, 48),
              "flaneur render --city 'my town'\\''s map.osm' '' ");
}

}  // namespace
}  // namespace flaneur
