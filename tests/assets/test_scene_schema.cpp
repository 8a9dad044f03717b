// The JSON schema of scene files and their reader say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "assets/scene.h"

namespace flaneur {
namespace {

using Json = nlohmann::json;

// Whether a schema lets a value through: the part of draft 7 that the scene's schema is written in. Anything
// else fails the test.
bool lets_through(const Json& schema, const Json& value);

bool has_type(const std::string& type, const Json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    EXPECT_EQ(type, "integer");
    return value.is_number() && value.get<double>() == std::floor(value.get<double>());
}

bool lets_text_through(const std::string& word, const Json& of, const std::string& value) {
    if (word == "pattern") return std::regex_search(value, std::regex(of.get<std::string>()));
    return value.size() >= of.get<size_t>();  // minLength
}

bool lets_list_through(const std::string& word, const Json& of, const Json& value) {
    auto is_good = [&](const Json& item) { return lets_through(of, item); };
    if (word == "items") return std::all_of(value.begin(), value.end(), is_good);
    return std::any_of(value.begin(), value.end(), is_good);  // contains
}

bool lets_object_through(const std::string& word, const Json& of, const Json& schema, const Json& value) {
    if (word == "required")
        return std::all_of(of.begin(), of.end(),
                           [&](const Json& key) { return value.contains(key.get<std::string>()); });
    for (const auto& [key, item] : value.items()) {
        if (word == "properties" && of.contains(key) && !lets_through(of[key], item)) return false;
        if (word == "additionalProperties" && !schema["properties"].contains(key)) return false;
    }
    return true;
}

bool lets_word_through(const std::string& word, const Json& of, const Json& schema, const Json& value) {
    auto lets = [&](const Json& one) { return lets_through(one, value); };
    if (word == "type") return has_type(of, value);
    if (word == "minimum") return !value.is_number() || value.get<long double>() >= of.get<long double>();
    if (word == "exclusiveMinimum")
        return !value.is_number() || value.get<long double>() > of.get<long double>();
    if (word == "maximum") return !value.is_number() || value.get<long double>() <= of.get<long double>();
    if (word == "enum") return std::find(of.begin(), of.end(), value) != of.end();
    if (word == "const") return value == of;
    if (word == "not") return !lets(of);
    if (word == "allOf") return std::all_of(of.begin(), of.end(), lets);
    if (word == "oneOf") return std::count_if(of.begin(), of.end(), lets) == 1;
    if (word == "pattern" || word == "minLength")
        return !value.is_string() || lets_text_through(word, of, value.get<std::string>());
    if (word == "items" || word == "contains") return !value.is_array() || lets_list_through(word, of, value);
    if (word == "required" || word == "properties" || word == "additionalProperties")
        return !value.is_object() || lets_object_through(word, of, schema, value);
    const std::set<std::string> only_told = {"$schema", "title", "description", "default", "examples"};
    EXPECT_TRUE(only_told.count(word)) << word;
    return true;
}

bool lets_through(const Json& schema, const Json& value) {
    if (schema.is_boolean()) return schema.get<bool>();
    for (const auto& [word, of] : schema.items())
        if (!lets_word_through(word, of, schema, value)) return false;
    return true;
}

struct SceneSchema : testing::Test {
    Json schema = Json::parse(scene_schema());
    Json& keys = schema["properties"];
    void expect_agreement(const Json& scene) const {
        EXPECT_EQ(bool(parse_scene(scene.dump(), "it")), lets_through(schema, scene)) << scene.dump();
    }
};

// What might stand anywhere: everybody's examples, limits and a little beyond, and other things.
std::vector<Json> things(const Json& keys) {
    std::vector<Json> all = {nullptr, true, false,     Json::array(), Json::object(),
                             "",      "x",  {"a.glb"}, {"a.glb", ""}, {1}};
    for (double v : {0.0, 0.5, 1.0, 1.5, 2.0, -1.0, -0.5, 12.0, 1e9, 1e19, 1e30, -1e30}) all.emplace_back(v);
    for (const char* text : {"00:00",
                             "23:59",
                             "24:00",
                             "8:00",
                             "dusk",
                             "Dusk",
                             "12:60",
                             "1x1",
                             "8192x8192",
                             "8193x1",
                             "1x0",
                             "0x5",
                             "01x5",
                             "999x8000",
                             "5X5",
                             "5x",
                             "street",
                             "Street",
                             "follow:",
                             "follow:0",
                             "follow:999999",
                             "follow:1000000",
                             "follow:0000000012",
                             "follow:-1",
                             "eyes:0",
                             "eyes:",
                             "eyes:1000000",
                             "map",
                             "map:",
                             "map:1,2",
                             "map:1,-2.5,200",
                             "map:1,2,5",
                             "map:1,2,4.9",
                             "map:1,2,20000.0",
                             "map:1,2,20000.1",
                             "map:1,2,2e2",
                             "map:1,2,200,-360",
                             "map:1,2,200,361",
                             "map:1,2,200,90,1",
                             "1,2,3",
                             "1,2,3/4,5",
                             "1,2,3/4,5,6",
                             "-.5,2.,1e1/4,5,6E-1",
                             "1,2,3/4,5,6/7,8,9",
                             "+1,2,3/4,5,6",
                             "1e,2,3/4,5,6",
                             "nan,0,0/1,1,1",
                             " street",
                             "street ",
                             "clear",
                             "snow",
                             "low",
                             "best",
                             "skeletons",
                             "a.osm",
                             "A.OSM.GZ",
                             "a.pbf"})
        all.emplace_back(text);
    all.emplace_back(std::string("a\0b.osm", 7));
    for (const auto& list :
         std::vector<std::vector<std::string>>{{"skeletons"},
                                               {"skeletons", "skeletons"},
                                               {"bones"},
                                               {"wireframe", "normals"},
                                               {"normals", "overdraw"},
                                               {"wireframe", "overdraw"},
                                               {"wireframe", "trails", "lods", "density", "gizmos"},
                                               {"lods", "speed"},
                                               {"walkable", "density"}})
        all.emplace_back(list);
    for (const char* item : {"1",
                             "{}",
                             R"({"builtin": true})",
                             R"({"builtin": false})",
                             R"({"character": "a.glb"})",
                             R"({"character": ""})",
                             R"({"character": 3})",
                             R"({"character": "a.glb", "builtin": true})",
                             R"({"character": "a.glb", "builtin": false})",
                             R"({"builtin": true, "share": 0.001})",
                             R"({"builtin": true, "share": 0.0009})",
                             R"({"builtin": true, "share": 1000})",
                             R"({"builtin": true, "share": 1001})",
                             R"({"builtin": 1})",
                             R"({"builtin": true, "colour": "red"})",
                             R"({"what": "bench", "at": "1,2,3"})",
                             R"({"what": "bench", "at": "1,2,3", "turn": 360})",
                             R"({"what": "bench", "at": "1,2,3", "turn": 361})",
                             R"({"what": "bench", "at": "1,2", "turn": 3})",
                             R"({"what": "bench", "at": "1,2,3", "to": "1,2,4"})",
                             R"({"what": "wall", "at": "1,2,3", "to": "1,2,4"})",
                             R"({"what": "wall", "at": "1,2,3"})",
                             R"({"what": "barrier", "at": "1,2,3", "to": "1,2,4", "turn": 1})",
                             R"({"what": "entrance", "at": "1,2,3"})",
                             R"({"what": "entrance", "at": "1,2,3", "turn": 1})",
                             R"({"what": "sofa", "at": "1,2,3"})",
                             R"({"at": "1,2,3"})",
                             R"({"what": "tree"})",
                             R"({"what": "lamp", "at": "-.5,2.,1e1", "name": "x"})"})
        all.push_back(Json::array({Json::parse(item)}));
    for (const Json& key : keys) {
        all.push_back(key["examples"][0]);
        if (key.contains("default")) all.push_back(key["default"]);
        for (const char* bound : {"minimum", "maximum"}) {
            if (!key.contains(bound)) continue;
            all.push_back(key[bound]);
            for (double off : {-1.0, 1.0, -1e-6, 1e-6}) all.emplace_back(key[bound].get<double>() + off);
        }
    }
    return all;
}

TEST_F(SceneSchema, StandsBesideTheScenes) {
    std::ifstream file(FLANEUR_SOURCE_DIR "/assets/scenes/scene.schema.json");
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), scene_schema())
        << "write it anew: flaneur scenes --schema > assets/scenes/scene.schema.json";
}

TEST_F(SceneSchema, AgreesWithTheReaderAboutEveryValueOfEveryKey) {
    size_t good = 0, bad = 0;
    for (const auto& [key, rules] : keys.items()) {
        for (const Json& thing : things(keys)) {
            Json scene = {{key, thing}};
            expect_agreement(scene);
            (lets_through(schema, scene) ? good : bad) += 1;
        }
    }
    EXPECT_GT(good, 100u);
    EXPECT_GT(bad, 1000u);
    expect_agreement({{"wlakers", 3}});
    for (const Json& thing : things(keys)) expect_agreement(thing);
}

TEST_F(SceneSchema, AgreesWithTheReaderAboutKeysThatGoTogether) {
    for (const auto& [a, rules] : keys.items()) {
        for (const auto& [b, others] : keys.items()) {
            if (a == b) continue;
            for (const char* city : {"a.osm.pbf", "a.OSM", "a.glb"}) {
                Json scene = {{a, rules["examples"][0]}, {b, others["examples"][0]}};
                if (scene.contains("city")) scene["city"] = city;
                expect_agreement(scene);
            }
        }
    }
    expect_agreement({{"built", "district"}, {"city", "a.osm"}});
}

TEST_F(SceneSchema, SaysWhatHoldsWithoutAKey) {
    Json usual = Json::object();
    for (const auto& [key, rules] : keys.items())
        if (rules.contains("default")) usual[key] = rules["default"];
    ASSERT_GE(usual.size(), 10u);
    Scene plain;
    plain.name = "it";
    usual["city"] = plain.city = "a.glb";  // whose scale is told
    usual.erase("blocks");
    Result<Scene> scene = parse_scene(usual.dump(), "it");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(*scene, plain);
}

TEST_F(SceneSchema, HasAnExampleOfEachKeyThatChangesTheScene) {
    Scene plain;
    plain.name = "it";
    for (const auto& [key, rules] : keys.items()) {
        Json one = {{key, rules["examples"][0]}};
        plain.city = key == "scale"                                           ? "a.glb"
                     : key == "terrain" || key == "center" || key == "radius" ? "a.osm"
                                                                              : "";
        if (!plain.city.empty()) one["city"] = plain.city;
        // These need their place.
        plain.built = key == "platform" || key == "drunks"  ? BuiltIn::platform
                      : key == "creatures" || key == "rock" ? BuiltIn::asteroid
                      : key == "flat" || key == "look"      ? BuiltIn::course
                                                            : BuiltIn::district;
        const bool is_elsewhere = plain.built != BuiltIn::district;
        if (is_elsewhere) one["built"] = k_built_in_names[static_cast<size_t>(plain.built)];
        plain.camera.kind = is_elsewhere ? CameraChoice::Kind::overview : CameraChoice::Kind::street;
        plain.habit = key == "limbs" ? Habit::ramble : Habit::wander;
        if (key == "limbs") one["habit"] = "ramble";
        // And these each other.
        for (const auto& [a, b] :
             {std::pair{"steppers", "steppers_way"}, {"steppers_way", "steppers"}, {"drunks", "drunk"}})
            if (key == a) one[b] = keys[b]["examples"][0];
        plain.lamps = key == "jaywalkers";
        if (plain.lamps) one["lamps"] = true;
        Result<Scene> scene = parse_scene(one.dump(), "it");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(*scene == plain, key == "$schema") << key;
    }
}

TEST_F(SceneSchema, CannotSayWhatTheReaderKnowsOfPlaces) {
    for (const char* camera : {"1,2,3/1,2,3", "2e6,0,0/1,1,1"}) {
        Json scene = {{"camera", camera}};
        EXPECT_TRUE(lets_through(schema, scene));
        EXPECT_FALSE(parse_scene(scene.dump(), "it"));
    }
}

// "| `key` | kind and range | default | meaning |" for each key, in docs/scenes.md.
TEST_F(SceneSchema, IsWhatTheManualSays) {
    std::ifstream manual(FLANEUR_SOURCE_DIR "/docs/scenes.md");
    std::set<std::string> told;
    auto expect_row = [&](const Json& rules, const std::string& key, const std::string& row) {
        std::vector<std::string> words;
        for (const char* number : {"minimum", "maximum"})
            if (rules.contains(number)) words.push_back(rules[number].dump());
        if (rules.contains("default")) words.push_back("| `" + rules["default"].dump() + "` |");
        for (const Json& word :
             rules.value("enum", rules.value("items", Json::object()).value("enum", Json::array())))
            words.push_back("`" + word.dump() + "`");
        for (const std::string& word : words)
            EXPECT_NE(row.find(word), std::string::npos) << word << " in " << row;
        told.insert(key);
    };
    for (std::string row; std::getline(manual, row);) {
        if (!row.starts_with("| `")) continue;
        std::string key = row.substr(3, row.find('`', 3) - 3);
        Json& of_people = keys["people"]["items"]["properties"];
        Json& of_added = keys["added"]["items"]["properties"];
        if (keys.contains(key)) {
            expect_row(keys[key], key, row);
        } else {
            Json& of = of_added.contains(key) ? of_added : of_people;
            ASSERT_TRUE(of.contains(key)) << row;
            expect_row(of[key], key, row);
        }
    }
    EXPECT_EQ(told.size(), keys.size() + 3 + 4);
}

}  // namespace
}  // namespace flaneur
