#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

#include "tests/folder.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {
namespace {

Result<std::variant<std::monostate, Options>> parse(std::vector<std::string> words) {
    words.insert(words.begin(), "flaneur");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    return parse_options(static_cast<int>(argv.size()), argv.data());
}

Options parsed(const std::vector<std::string>& words) {
    auto result = parse(words);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::get<Options>(*result) : Options();
}

TEST(Options, TheCommandLineOverridesTheScene) {
    Options plain = parsed({"sim", "--scene", "corner"});
    Options changed = parsed(
        {"sim", "--scene", "corner", "--walkers", "7", "--time", "23:30", "--seed", "18446744073709551615"});
    EXPECT_EQ(plain.command, Command::sim);
    EXPECT_EQ(plain.scene.walkers, 40);
    EXPECT_EQ(changed.scene.walkers, 7);
    EXPECT_EQ(changed.scene.seed, ~uint64_t{0});
    EXPECT_FLOAT_EQ(changed.scene.hour, 23.5f);
    EXPECT_TRUE(plain.scene.sun_height && !plain.scene.is_overcast);
    EXPECT_FALSE(changed.scene.sun_height || changed.scene.sun_heading) << "the hour tells where the sun is";
    EXPECT_TRUE(parsed({"sim", "--weather", "overcast"}).scene.is_overcast);
    EXPECT_FALSE(parse({"sim", "--weather", "fog"}));
    EXPECT_EQ(changed.scene.blocks, plain.scene.blocks);
    EXPECT_EQ(parsed({"sim", "--scene", "asteroid"}).scene.built, BuiltIn::asteroid);
    EXPECT_EQ(parsed({"sim", "--scene", "asteroid", "--city", "a.glb"}).scene.built, BuiltIn::district);
    EXPECT_FLOAT_EQ(parsed({"sim", "--city", "a.glb", "--scale", "0.01"}).scene.scale, 0.01f);
}

TEST(Options, TheCommandLineOverridesHowASceneIsLookedAt) {
    TestFolder folder;
    std::string file = folder.write("mine.json", R"({"camera": "follow:3", "size": "20x10", "quality": "low",
        "view": ["trails"]})");
    Options plain = parsed({"render", "--scene", file, "--out", "a.png"});
    EXPECT_EQ(plain.scene.camera.walker, 3u);
    EXPECT_EQ(plain.scene.size, (Size{20, 10}));
    EXPECT_EQ(plain.scene.quality, "low");
    EXPECT_TRUE(plain.scene.views[WorkView::trails]);
    Options changed = parsed({"render", "--scene", file, "--out", "a.png", "--camera", "overview", "--size",
                              "4x3", "--quality", "high", "--view", "speed"});
    EXPECT_EQ(changed.scene.camera.kind, CameraChoice::Kind::overview);
    EXPECT_EQ(changed.scene.size, (Size{4, 3}));
    EXPECT_EQ(changed.scene.quality, "high");
    EXPECT_FALSE(changed.scene.views[WorkView::trails]);
    EXPECT_TRUE(changed.scene.views[WorkView::speed]);
}

// It is not the command line's fault.
TEST(Options, ASceneIsToBlameForItsOwnCamera) {
    TestFolder folder;
    std::string file = folder.write("mine.json", R"({"walkers": 5, "camera": "follow:5"})");
    auto refused = parse({"render", "--out", "a.png", "--scene", file});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("camera of the scene"), std::string::npos)
        << refused.error().message;
    EXPECT_EQ(refused.error().message.find("--camera"), std::string::npos) << refused.error().message;
    EXPECT_TRUE(parse({"render", "--out", "a.png", "--scene", file, "--walkers", "6"}));
    for (const char* command : {"view", "bench frame"}) {
        std::vector<std::string> words{"--scene", file};
        std::istringstream in(command);
        words.insert(words.begin(), std::istream_iterator<std::string>(in), {});
        EXPECT_FALSE(parse(words)) << command;
    }
}

TEST(Options, NobodyAsksForTheCameraOfWhatIsNotDrawn) {
    TestFolder folder;
    std::string file = folder.write("mine.json", R"({"walkers": 20, "camera": "follow:12"})");
    EXPECT_TRUE(parse({"sim", "--scene", file, "--walkers", "5"}));
    EXPECT_TRUE(parse({"bench", "crowd", "--scene", file, "--walkers", "5"}));
    EXPECT_TRUE(parse({"gait", "--scene", file, "--crowd", "10"}));
    EXPECT_TRUE(parse({"city", "--check", "--scene", file, "--walkers", "5"}));
    EXPECT_FALSE(parse({"render", "--out", "a.png", "--scene", file, "--walkers", "5"}));
}

TEST(Options, AnotherCityIsNotWhatTheSceneSaysOfItsOwn) {
    TestFolder folder;
    std::string map = folder.write(
        "map.json",
        R"({"about": "A", "city": "a.osm", "terrain": "a.tif", "center": "52,13", "radius": 500})");
    std::string model = folder.write("model.json", R"({"city": "a.glb", "scale": 0.01})");
    Options own = parsed({"sim", "--scene", map}), other = parsed({"sim", "--scene", map, "--city", "b.osm"});
    EXPECT_EQ(own.scene.terrain, folder / "a.tif");
    EXPECT_EQ(own.scene.about, "A");
    EXPECT_EQ(other.scene.about, "");
    EXPECT_EQ(other.scene.terrain, "");
    EXPECT_FALSE(other.scene.center);
    EXPECT_EQ(other.scene.radius, 0);
    EXPECT_EQ(parsed({"sim", "--scene", map, "--city", "b.osm", "--terrain", "b.tif"}).scene.terrain,
              "b.tif");
    EXPECT_FLOAT_EQ(parsed({"sim", "--scene", model}).scene.scale, 0.01f);
    EXPECT_FLOAT_EQ(parsed({"sim", "--scene", model, "--city", "b.glb"}).scene.scale, 1);
}

TEST(Options, ViewsForWorkGoTogetherWhereTheyCan) {
    Options options = parsed({"render", "--view", "trails,speed,wireframe", "--out", "a.png"});
    EXPECT_TRUE(options.scene.views[WorkView::trails] && options.scene.views[WorkView::speed]);
    EXPECT_FALSE(options.scene.views[WorkView::lods]);
    WorkViews changed = toggled(options.scene.views, WorkView::normals);
    EXPECT_TRUE(changed[WorkView::normals] && changed[WorkView::trails]);
    EXPECT_FALSE(changed[WorkView::wireframe]);
    EXPECT_FALSE(toggled(changed, WorkView::normals)[WorkView::normals]);
    for (const char* text : {"trails,", "", "bones", "lods,speed", "wireframe,overdraw", "density,walkable"})
        EXPECT_FALSE(parse({"render", "--out", "a.png", "--view", text})) << text;
}

TEST(Options, BodiesAreDrawnWithoutWhatIsNamed) {
    Options options = parsed({"render", "--without", "feet,walls", "--out", "a.png"});
    EXPECT_FALSE(options.techniques.feet || options.techniques.walls);
    EXPECT_TRUE(options.techniques.pelvis && options.techniques.holds);
    EXPECT_EQ(told_without(options.techniques, LimbLead::gait), "feet,walls");
    EXPECT_EQ(parsed({"view"}).techniques, Techniques{});
    EXPECT_EQ(told_without({}, LimbLead::gait), "");
    for (const TechniqueInfo& technique : k_techniques)
        EXPECT_EQ(told_without(*parse_without(std::string(technique.name)), LimbLead::gait), technique.name);
    EXPECT_EQ(parsed({"view", "--scene", "walker-curves"}).techniques, usual_techniques(LimbLead::curves));
    EXPECT_EQ(parsed({"view", "--scene", "walker-curves", "--without", "none"}).techniques, Techniques{});
    EXPECT_EQ(told_without({}, LimbLead::curves), "none");
    EXPECT_EQ(told_without(usual_techniques(LimbLead::curves), LimbLead::curves), "");
    for (const char* text : {"feet,", "", "feat", "none,feet"}) EXPECT_FALSE(parse_without(text)) << text;
    EXPECT_NE(parse_without("pelvsi").error().message.find("Did you mean pelvis?"), std::string::npos);
}

TEST(Options, EveryCharacterCountsAndOfOtherOptionsTheLast) {
    Options options =
        parsed({"render", "--character", "a.glb",     "--character", "b.glb",     "--idle", "c.glb:Wave",
                "--idle", "d.glb",       "--walkers", "1",           "--walkers", "2",      "--out",
                "a.png",  "--out",       "b.png",     "--size",      "10x20",     "--size", "30x40"});
    EXPECT_EQ(options.scene.people, (std::vector<PeopleShare>{{"a.glb"}, {"b.glb"}}));
    EXPECT_EQ(options.scene.idles, (std::vector<std::string>{"c.glb:Wave", "d.glb"}));
    EXPECT_FALSE(options.force);
    EXPECT_EQ(options.scene.walkers, 2);
    EXPECT_EQ(options.out, "b.png");
    EXPECT_EQ(options.scene.size.width, 30);
    EXPECT_EQ(options.scene.size.height, 40);
}

TEST(Options, FramesMeanTicksForRenderAndACountElsewhere) {
    EXPECT_EQ(parsed({"render", "--out", "a.png", "--frames", "3:9:2"}).ticks.last, 9u);
    EXPECT_EQ(parsed({"view", "--frames", "5"}).close_after, 5u);
    EXPECT_EQ(parsed({"bench", "pose", "--frames", "5"}).bench_frames, 5u);
    EXPECT_EQ(parsed({"bench", "pose"}).load, BenchLoad::pose);
    EXPECT_FALSE(parse({"bench"}));
    EXPECT_FALSE(parse({"bench", "pose", "--frames", "0"}));
}

TEST(Options, WalkersAreZeroToAMillion) {
    EXPECT_TRUE(parse({"sim", "--walkers", "0"}));
    EXPECT_TRUE(parse({"sim", "--walkers", "1000000"}));
    for (const char* text : {"-1", "1000001", "10000000", "99999999999", "x", "1.5", ""})
        EXPECT_FALSE(parse({"sim", "--walkers", text})) << text;
}

TEST(Options, GaitMeasuresOneWalkAtATime) {
    EXPECT_EQ(parsed({"gait"}).gait.speed, 0);  // as such people like
    Options stairs = parsed({"gait", "--stairs", "down", "--sex", "woman", "--age", "70", "--check"});
    EXPECT_EQ(stairs.gait.stairs, "down");
    EXPECT_EQ(stairs.gait.sex, Sex::woman);
    EXPECT_TRUE(stairs.gait.check);
    EXPECT_EQ(parsed({"gait", "--crowd", "70"}).scene.walkers, 70);
    EXPECT_TRUE(parse({"gait", "--slope", "-8", "--svg", "a.svg"}));
    for (auto words : {std::vector<std::string>{"--turn", "90", "--kerb", "0.1"},
                       {"--crowd", "5", "--stairs", "up"},
                       {"--leap", "1", "--stairs", "up"},
                       {"--turn", "90", "--svg", "a.svg"},
                       {"--stairs", "round"},
                       {"--speed", "0"}}) {
        words.insert(words.begin(), "gait");
        EXPECT_FALSE(parse(words)) << words[1];
    }
}

TEST(Ticks, OneOrARange) {
    Result<TickRange> one = parse_ticks("600"), range = parse_ticks("0:600"), stepped = parse_ticks("1:10:4");
    ASSERT_TRUE(one && range && stepped);
    EXPECT_EQ(count(*one), 1u);
    EXPECT_EQ(one->first, 600u);
    EXPECT_EQ(count(*range), 601u);
    EXPECT_EQ(count(*stepped), 3u);  // 1, 5, 9
    for (const char* text : {"", ":", "1:", ":1", "1:0", "0:9:0", "0:9:-1", "-1", "0:1:1:1", "a", "1 ",
                             "4294967296", "0:10000001"})
        EXPECT_FALSE(parse_ticks(text)) << text;
}

TEST(Walkers, OneNumberOrARange) {
    Result<WalkerRange> one = parse_walkers("1e3"), range = parse_walkers("100:1e6");
    ASSERT_TRUE(one && range);
    EXPECT_TRUE(is_single(*one));
    EXPECT_EQ(one->first, 1000u);
    EXPECT_FALSE(is_single(*range));
    EXPECT_EQ(range->first, 100u);
    EXPECT_EQ(range->last, 1'000'000u);
    for (const char* text :
         {"", ":", "1:", ":1", "5:5", "9:1", "0:9", "1:1000001", "1000001", "1.5", "-1", "a", "1:2:3", "nan"})
        EXPECT_FALSE(parse_walkers(text)) << text;
}

TEST(People, AFileOrTheBuiltInOnesAndTheirShare) {
    EXPECT_EQ(*parse_people("a.glb"), (PeopleShare{"a.glb", 1}));
    EXPECT_EQ(*parse_people("a.glb:2.5"), (PeopleShare{"a.glb", 2.5f}));
    EXPECT_EQ(*parse_people("c:a.glb"), (PeopleShare{"c:a.glb", 1}));
    EXPECT_EQ(*parse_people("c:a.glb:3"), (PeopleShare{"c:a.glb", 3}));
    EXPECT_EQ(*parse_people("builtin:9"), (PeopleShare{"", 9}));
    for (const char* text : {"", ":3", "a.glb:0", "a.glb:-1", "a.glb:1e9", "a.glb:nan"})
        EXPECT_FALSE(parse_people(text)) << text;
}

TEST(Size, WidthByHeight) {
    Result<Size> size = parse_size("8192x1");
    ASSERT_TRUE(size);
    EXPECT_EQ(size->width, 8192);
    EXPECT_EQ(size->height, 1);
    for (const char* text : {"", "x", "12", "0x5", "5x0", "8193x5", "-5x5", "5x5x5", "5X5", " 5x5"})
        EXPECT_FALSE(parse_size(text)) << text;
}

TEST(CameraOption, NamesWalkersAndPoints) {
    EXPECT_EQ(parse_camera("overview")->kind, CameraChoice::Kind::overview);
    EXPECT_EQ(parse_camera("street")->kind, CameraChoice::Kind::street);
    EXPECT_EQ(parse_camera("follow:12")->walker, 12u);
    Result<CameraChoice> fixed = parse_camera("0,1.7,-2e1/10,1.5,0");
    ASSERT_TRUE(fixed);
    EXPECT_EQ(fixed->kind, CameraChoice::Kind::fixed);
    EXPECT_EQ(fixed->eye, (Vec3{0, 1.7f, -20}));
    EXPECT_EQ(fixed->target, (Vec3{10, 1.5f, 0}));
    for (const char* text :
         {"", "Street", "follow", "follow:", "follow:-1", "follow:x", "1,2,3", "1,2/3,4", "1,2,3/4,5",
          "1,2,3/1,2,3", "nan,0,0/1,1,1", "inf,0,0/1,1,1", "1,2,3/4,5,6/7,8,9"})
        EXPECT_FALSE(parse_camera(text)) << text;
}

}  // namespace
}  // namespace flaneur
