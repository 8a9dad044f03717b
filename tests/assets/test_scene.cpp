#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <sstream>

#include "assets/scene.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

struct SceneFile : testing::Test {
    Result<Scene> load(const std::string& text) { return load_scene(folder.write("mine.json", text)); }
    TestFolder folder;
};

TEST(Scenes, BuiltInOnesAreSortedAndSound) {
    std::vector<std::string> names = scene_names();
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    EXPECT_EQ(std::count(names.begin(), names.end(), "district"), 1);
    for (const std::string& name : names) {
        Result<Scene> scene = load_scene(name);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->name, name);
    }
}

TEST_F(SceneFile, PeopleMayGoWhereOthersWereRecorded) {
    Result<Scene> scene = load(R"({ "trajectories": "lab/corridor.txt" })");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(is_recorded(*scene));
    EXPECT_EQ(scene->walkers, 0);
    EXPECT_EQ(scene->camera.kind, CameraChoice::Kind::overview);
    EXPECT_TRUE(scene->trajectories.ends_with("lab/corridor.txt"));
    EXPECT_NE(scene->trajectories, "lab/corridor.txt");
    EXPECT_FALSE(is_of(*scene, BuiltIn::district));
    scene = load(R"({ "trajectories": {"file": "/a.h5", "fps": 12.5, "enter": "step"} })");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->trajectories, "/a.h5");
    EXPECT_FLOAT_EQ(scene->reading.fps, 12.5f);
    EXPECT_EQ(scene->entering, Entering::step);
    const Result<Scene> again = parse_scene(scene_text(*scene), scene->name);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, *scene);
    const Scene made = scene_of_trajectories("x/corridor.sqlite");
    EXPECT_EQ(made.name, "corridor");
    const Result<Scene> told = parse_scene(scene_text(made), made.name);
    ASSERT_TRUE(told) << told.error().message;
    EXPECT_EQ(*told, made);
    for (const char* wrong :
         {R"({ "trajectories": {"fps": 25} })", R"({ "trajectories": {"file": "a.txt", "enter": "leap"} })",
          R"({ "trajectories": "a.txt", "walkers": 5 })", R"({ "trajectories": "a.txt", "city": "b.osm" })",
          R"({ "trajectories": "a.txt", "demand": "b.json" })", R"({ "trajectories": 3 })"})
        EXPECT_FALSE(load(wrong)) << wrong;
}

TEST_F(SceneFile, SetsWhatItSaysAndKeepsTheRest) {
    Result<Scene> scene =
        load(R"({ "walkers": 12, "time": "08:15", "seed": 18446744073709551615, "camera": "overview",
        "city": "maps/a.osm", "people": [{"character": "a.glb", "share": 2.5},
        {"character": "/b.glb"}, {"builtin": true, "share": 9}], "sun_height": 40.5, "weather": "overcast",
        "side": "left", "coming": false, "demand": "who/goes.json" })");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->name, "mine");
    EXPECT_EQ(scene->walkers, 12);
    EXPECT_EQ(scene->seed, ~uint64_t{0});
    EXPECT_FLOAT_EQ(scene->hour, 8.25f);
    EXPECT_EQ(scene->camera.kind, CameraChoice::Kind::overview);
    EXPECT_EQ(scene->city, folder / "maps/a.osm");
    EXPECT_EQ(scene->people, (std::vector<PeopleShare>{{folder / "a.glb", 2.5f}, {"/b.glb", 1}, {"", 9}}));
    EXPECT_EQ(scene->sun_height, 40.5f);
    EXPECT_FALSE(scene->sun_heading) << "the hour tells";
    EXPECT_TRUE(scene->is_overcast);
    EXPECT_EQ(scene->side, PassOn::left);
    EXPECT_TRUE(scene->stays);
    EXPECT_EQ(scene->demand, folder / "who/goes.json");
    EXPECT_EQ(scene->blocks, Scene().blocks);
}

TEST_F(SceneFile, OfACourseOrAYardTakesAsManyAsFindRoom) {
    const auto walkers = [&](const char* text) {
        const Result<Scene> scene = load(text);
        EXPECT_TRUE(scene) << text;
        return scene ? scene->walkers : -1;
    };
    EXPECT_EQ(walkers(R"({"built": "course"})"), k_course_walkers);
    EXPECT_EQ(walkers(R"({"built": "yard"})"), k_yard_walkers);
    EXPECT_EQ(walkers(R"({"built": "course", "walkers": 500})"), 500) << "who asks is told how many do";
    EXPECT_EQ(walkers("{}"), 500);
}

TEST(Places, KnowWhereOneDrivesOnTheLeft) {
    for (const MapPlace left : {MapPlace{51.52, -0.09},
                                {35.68, 139.7},
                                {-33.9, 151.2},
                                {1.29, 103.85},
                                {28.6, 77.2},
                                {-26.2, 28},
                                {22.28, 114.16},
                                {13.7, 100.5},
                                {-36.8, 174.8}})
        EXPECT_TRUE(is_driven_on_left(left)) << left.latitude << "," << left.longitude;
    for (const MapPlace right : {MapPlace{52.5, 13.4},
                                 {43.73, 7.42},
                                 {25.03, 121.56},
                                 {40.75, -73.98},
                                 {48.86, 2.35},
                                 {37.57, 126.98},
                                 {31.2, 121.5},
                                 {30, 31.2},
                                 {-23.5, -46.6}})
        EXPECT_FALSE(is_driven_on_left(right)) << right.latitude << "," << right.longitude;
}

TEST_F(SceneFile, IsRefusedByKeyAndRange) {
    for (const char* text : {R"({"walkers": -1})",
                             R"({"walkers": 1000001})",
                             R"({"walkers": 1.5})",
                             R"({"walkers": "ten"})",
                             R"({"walkers": 18446744073709551615})",
                             R"({"seed": -1})",
                             R"({"time": "24:00"})",
                             R"({"time": "8:00"})",
                             R"({"time": "ab:cd"})",
                             R"({"time": 8})",
                             R"({"seed": 1e30})",
                             R"({"blocks": 0})",
                             R"({"blocks": 33})",
                             R"({"camera": 3})",
                             R"({"city": null})",
                             R"({"people": "a.glb"})",
                             R"({"people": [1]})",
                             R"({"people": [{}]})",
                             R"({"people": [{"builtin": false}]})",
                             R"({"people": [{"builtin": true, "character": "a.glb"}]})",
                             R"({"people": [{"builtin": true, "share": 0}]})",
                             R"({"people": [{"builtin": 1}]})",
                             R"({"people": [{"character": "a.glb", "colour": "red"}]})",
                             R"({"sun_height": 91})",
                             R"({"sun_heading": -1})",
                             R"({"weather": "snow"})",
                             R"({"weather": 3})"}) {
        Result<Scene> scene = load(text);
        ASSERT_FALSE(scene) << text;
        std::string key(text + 2, std::string(text + 2).find('"'));
        EXPECT_NE(scene.error().message.find('"' + key + '"'), std::string::npos) << scene.error().message;
    }
    Result<Scene> unknown = load(R"({"walkers": 3, "wlakers": 3})");
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("wlakers"), std::string::npos);
}

TEST_F(SceneFile, ThatContradictsItselfIsRefused) {
    for (auto [text, says] :
         {std::pair{R"({"built": "asteroid", "city": "a.osm"})", "\"city\""},
          {R"({"built": "asteroid", "terrain": "a.tif"})", "\"terrain\""},
          {R"({"scale": 2, "city": "A.OSM.PBF"})", "\"scale\""},
          {R"({"scale": 2})", "\"scale\""},
          {R"({"blocks": 2, "built": "asteroid"})", "\"blocks\""},
          {R"({"blocks": 2, "city": "a.osm"})", "\"blocks\""},
          {R"({"camera": "street", "built": "asteroid"})", "\"camera\""},
          {R"({"camera": "eyes:3", "built": "asteroid"})", "\"camera\""},
          {R"({"platform": "-8,-5 8,-5 0,9"})", "\"platform\""},
          {R"({"habit": "stagger"})", "\"habit\""},
          {R"({"habit": "stagger", "built": "asteroid"})", "\"habit\""},
          {R"({"side": "left", "built": "planets"})", "\"side\""},
          {R"({"rock": "torus", "built": "planets"})", "\"rock\""},
          {R"({"built": "gallery", "creatures": 3})", "\"creatures\""},
          {R"({"helpers": 0.5, "built": "planets"})", "\"helpers\""},
          {R"({"walkers": 5, "pushes": ["2 5 120,0"]})", "5 is nobody"},
          {R"({"flat": true})", "\"flat\""},
          {R"({"look": "0,1,0", "built": "field"})", "\"look\""},
          {R"({"prams": 0, "built": "course"})", "\"prams\""},
          {R"({"pushes": ["1 * 9,9"], "built": "course", "flat": true})", "\"pushes\""},
          {R"({"steppers": 1})", "\"steppers_way\""},
          {R"({"steppers_way": "0,0 3,0"})", "\"steppers\""},
          {R"({"steppers": 1, "steppers_way": "0,0"})", "2 to 64 corners"},
          {R"({"steppers": 1, "steppers_way": "0,0 9,9", "built": "planets"})", "\"steppers\""},
          {R"({"drunks": 2, "built": "platform"})", "\"drunk\""},
          {R"({"habit": "ramble", "built": "course"})", "\"habit\""},
          {R"({"platform": "0,0 8,0 1,1 0,8", "built": "platform"})", "\"platform\""},
          {R"({"radius": 500})", "\"radius\""},
          {R"({"terrain": "a.tif", "city": "a.glb"})", "\"terrain\""}}) {
        Result<Scene> scene = load(text);
        ASSERT_FALSE(scene) << text;
        EXPECT_NE(scene.error().message.find(says), std::string::npos) << scene.error().message;
    }
    EXPECT_TRUE(load(R"({"built": "district", "city": "a.osm"})"));
    EXPECT_TRUE(load(R"({"walkers": 5, "pushes": ["2 4 120,0", "2 * 120,0"]})"));
    EXPECT_TRUE(load(R"({"scale": 2, "city": "a.glb"})"));
    EXPECT_EQ(load(R"({"built": "asteroid"})")->camera.kind, CameraChoice::Kind::overview);
    EXPECT_EQ(load(R"({"center": "52.5, 13.25", "city": "a.osm"})")->center->longitude, 13.25);
}

// A sentence says which key and shows the beginning of its value; a parser's stack is not for a file to fill.
TEST_F(SceneFile, IsRefusedInAShortSentenceHoweverDeepOrLong) {
    auto nested = [](size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
    auto in_quotes = [](const std::string& text) {
        std::ostringstream out;
        out << '"' << text << '"';
        return std::move(out).str();
    };
    auto scene_of = [](const std::string& key, const std::string& value) {
        std::ostringstream out;
        out << "{\"" << key << "\": " << value << "}";
        return std::move(out).str();
    };
    std::string longest(50'000, 'a'), text = in_quotes(longest);
    for (const std::string& value : {nested(200'000), nested(6), std::string(200'000, '['), text}) {
        for (const char* key : {"city", "walkers", "people", "idles", "built", "time"}) {
            Result<Scene> scene = load(scene_of(key, value));
            if (!scene) {
                EXPECT_LT(scene.error().message.size(), 300u);
            }
            EXPECT_TRUE(!scene || (value == text && key == std::string("city"))) << key;
        }
    }
    Result<Scene> scene = load(scene_of(longest, "1"));
    ASSERT_FALSE(scene);
    EXPECT_LT(scene.error().message.size(), (folder / "mine.json").size() + 520u);
    scene = load(R"({"\u001b[31mred\n": 1})");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().message.find_first_of("\x1b\n"), std::string::npos) << scene.error().message;
    EXPECT_FALSE(load("{\"seed\": 1}" + std::string(2 << 20, ' '))) << "two megabytes";
}

TEST_F(SceneFile, ThatIsNoFileIsNotWaitedFor) {
    ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder / "endless.json");
    std::filesystem::create_directory(folder / "folder.json");
    for (const char* name : {"pipe.json", "endless.json", "folder.json"}) {
        Result<Scene> scene = load_scene(folder / name);
        ASSERT_FALSE(scene) << name;
        EXPECT_NE(scene.error().message.find("Cannot read the scene"), std::string::npos);
    }
}

TEST_F(SceneFile, ThatIsNoJsonObjectIsRefused) {
    for (const char* text : {"", "{", "[]", "3", "{\"walkers\": }", "{\"walkers\": 1} x", "\xff\xfe"})
        EXPECT_FALSE(load(text)) << text;
    EXPECT_NE(load("{\n\n\"walkers\": }").error().message.find("line 3"), std::string::npos);
}

TEST(Scenes, UnknownOnesAreRefused) {
    EXPECT_FALSE(load_scene("atlantis"));
    EXPECT_FALSE(load_scene("nowhere.json"));
    EXPECT_FALSE(load_scene(""));
}

}  // namespace
}  // namespace flaneur
