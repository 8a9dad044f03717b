#include <gtest/gtest.h>

#include <cmath>

#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/command.h"

namespace flaneur {
namespace {

Shown shown() {
    Shown s;
    s.choice.kind = CameraChoice::Kind::fixed;
    s.camera.eye = {1.5f, 1.7f, -0.1f};
    s.camera.target = {2, 1.25f, 3};
    s.camera.vertical_fov = k_fov;
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
    s.choice = {CameraChoice::Kind::follow, 12, {}, {}};  // told as where it was seen from
    s.camera.vertical_fov = fov_of(47.5);
    s.views = toggled(toggled({}, WorkView::density), WorkView::skeletons);
    EXPECT_EQ(command_of({"--camera", "overview", "--fov", "20", "--size=10x10", "--view", "lods",
                          "--close-after", "3", "--validate"},
                         s),
              "flaneur render --validate --camera 1.5,1.7,-0.1/2,1.25,3 --fov 47.5 --size 800x600 "
              "--view density,skeletons --frames 361 --out picture.png");
    EXPECT_EQ(command_of({"--camera"}, s), command_of({}, s));
}

TEST(Command, TellsWhatBodiesAreDrawnWithout) {
    Shown s = shown();
    s.techniques.feet = s.techniques.canes = false;
    const std::string all = command_of({"--without", "walls", "--seed", "3"}, s);
    EXPECT_NE(all.find(" --without feet,canes "), std::string::npos) << all;
    EXPECT_EQ(all.find("walls"), std::string::npos) << all;
    EXPECT_EQ(command_of({"--without", "walls"}, shown()), command_of({}, shown()));
    s = shown();
    s.limbs = LimbLead::curves;
    EXPECT_NE(command_of({}, s).find(" --without none "), std::string::npos) << "limbs go by curves there";
    s.techniques = usual_techniques(s.limbs);
    EXPECT_EQ(command_of({}, s), command_of({}, shown()));
}

TEST(Command, TellsMapsAndLensesToTheLastBit) {
    Shown s = shown();
    s.choice.kind = CameraChoice::Kind::map;
    s.choice.middle = {-12.34567f, 1e-3f}, s.choice.across = 217.3f, s.choice.bearing = -33.33333f;
    s.camera.vertical_fov = 0.14f;
    auto told = [&](const char* option) {
        const std::string all = command_of({}, s);
        const size_t at = all.find(option);
        if (at == std::string::npos) return std::string();
        const size_t from = all.find(' ', at) + 1;
        return all.substr(from, all.find(' ', from) - from);
    };
    EXPECT_EQ(*parse_camera(told("--camera")), s.choice);
    EXPECT_EQ(told("--fov"), "") << "a map has none";
    s.choice.kind = CameraChoice::Kind::fixed;
    for (float fov = 0.02f; fov < 2.6f; fov = std::nextafter(fov * 1.0371f, 3.0f)) {
        s.camera.vertical_fov = fov;
        EXPECT_EQ(*parse_fov(told("--fov")), fov);
    }
    s.camera.vertical_fov = k_fov;
    EXPECT_EQ(told("--fov"), "") << "the usual lens goes without saying";
    s.has_lens = true;
    EXPECT_EQ(*parse_fov(told("--fov")), k_fov) << "but not where a scene has another";
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

TEST(Command, SaysTheQualityThatWasChosen) {
    Shown s = shown();
    s.quality = "low";
    const std::string all = command_of({"--quality", "high", "--seed", "3"}, s);
    EXPECT_NE(all.find(" --quality low "), std::string::npos) << all;
    EXPECT_EQ(all.find("high"), std::string::npos) << all;
    EXPECT_NE(command_of({"--quality", "high"}, shown()).find("--quality high"), std::string::npos);
}

TEST(Command, MeasuresWhatIsSeen) {
    Shown s = shown();
    s.views = toggled({}, WorkView::density);
    s.techniques.feet = false;
    s.is_transparent = true;
    EXPECT_EQ(
        bench_command_of({"--walkers", "2000", "--view", "lods", "--frames", "9"}, s),
        "flaneur bench frame --walkers 2000 --camera 1.5,1.7,-0.1/2,1.25,3 --size 800x600 --warm-up 361");
}

TEST(Command, QuotesForAShell) {
    EXPECT_EQ(command_of({"--city", "my town's map.osm", ""}, shown()).substr(0, 48),
              "flaneur render --city 'my town'\\''s map.osm' '' ");
}

}  // namespace
}  // namespace flaneur
