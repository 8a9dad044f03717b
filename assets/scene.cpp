#include "assets/scene.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "embedded/scenes.h"

namespace flaneur {

namespace {

using Json = nlohmann::json;

constexpr float k_unsaid = 1e9f;

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

// Reads the keys of one scene. The first thing that is wrong is kept; what follows changes nothing.
struct Reader {
    const Json& json;
    std::vector<std::string> known;
    std::string wrong;

    const Json* find(const char* key) {
        known.emplace_back(key);
        auto it = json.find(key);
        return it == json.end() || !wrong.empty() ? nullptr : &*it;
    }

    void text(const char* key, std::string& to) {
        const Json* value = find(key);
        if (!value) return;
        if (value->is_string()) {
            to = value->get<std::string>();
        } else {
            wrong = std::string("\"") + key + "\" must be a text in quotes, not " + value->dump();
        }
    }

    void flag(const char* key, bool& to) {
        const Json* value = find(key);
        if (!value) return;
        if (value->is_boolean()) {
            to = value->get<bool>();
        } else {
            wrong = std::string("\"") + key + "\" must be true or false, not " + value->dump();
        }
    }

    void texts(const char* key, std::vector<std::string>& to) {
        const Json* value = find(key);
        if (!value) return;
        auto is_text = [](const Json& item) { return item.is_string(); };
        if (value->is_array() && std::all_of(value->begin(), value->end(), is_text)) {
            to = value->get<std::vector<std::string>>();
        } else {
            wrong = std::string("\"") + key + "\" must be a list of texts, not " + value->dump();
        }
    }

    template <class T>
    void number(const char* key, T low, T high, T& to) {
        const Json* value = find(key);
        if (!value) return;
        constexpr bool whole = std::numeric_limits<T>::is_integer;
        bool fits = whole ? value->is_number_integer() : value->is_number();
        if (fits && whole && value->is_number_unsigned()) {
            fits = value->get<uint64_t>() >= static_cast<uint64_t>(low) &&
                   value->get<uint64_t>() <= static_cast<uint64_t>(high);
        } else if (fits && whole) {
            fits = low < T{1} && value->get<int64_t>() >= static_cast<int64_t>(low);  // it is negative
        } else if (fits) {
            fits = value->get<double>() >= static_cast<double>(low) &&
                   value->get<double>() <= static_cast<double>(high);
        }
        if (fits) {
            to = value->get<T>();
            return;
        }
        std::ostringstream sentence;
        sentence << '"' << key << "\" must be a " << (whole ? "whole " : "") << "number from " << low
                 << " to " << high << ", not " << value->dump();
        wrong = sentence.str();
    }
};

// Refuses keys that were not asked for. `what` may have them.
void refuse_unknown(Reader& reader, const std::string& what) {
    if (!reader.wrong.empty()) return;
    for (const auto& item : reader.json.items()) {
        if (std::find(reader.known.begin(), reader.known.end(), item.key()) == reader.known.end())
            reader.wrong =
                "\"" + item.key() + "\" is not known; " + what + " may have " + joined(reader.known);
    }
}

// [{"character": "robot.glb", "share": 1}, {"builtin": true, "share": 9}]
void read_people(Reader& scene, std::vector<PeopleShare>& to) {
    const Json* list = scene.find("people");
    if (!list) return;
    if (!list->is_array()) {
        scene.wrong = R"("people" must be a list such as [{"character": "robot.glb", "share": 1}, )"
                      R"({"builtin": true, "share": 9}], not )" +
                      list->dump();
        return;
    }
    for (const Json& item : *list) {
        PeopleShare people;
        bool builtin = false;
        std::string wrong;
        if (item.is_object()) {
            Reader reader{item, {}, {}};
            reader.text("character", people.character);
            reader.flag("builtin", builtin);
            reader.number("share", k_least_share, k_most_share, people.share);
            refuse_unknown(reader, "it");
            wrong = reader.wrong;
        }
        if (wrong.empty() && builtin == !people.character.empty())
            wrong = R"(it must have either "character": "FILE" or "builtin": true)";
        if (!wrong.empty()) {
            scene.wrong = "in \"people\", number " + std::to_string(to.size() + 1) + ": " + wrong;
            return;
        }
        to.push_back(people);
    }
}

Result<Scene> parse_scene(std::string_view text, const std::string& name) {
    auto refused = [&](const std::string& why) { return Error{"Scene " + name + ": " + why + "."}; };
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        size_t end = std::min(error.byte, text.size());
        auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n') + 1;
        return refused("this is not JSON, as line " + std::to_string(line) + " shows");
    }
    if (!json.is_object()) return refused("the JSON must be an object: { \"walkers\": 500 }");

    Scene scene;
    scene.name = name;
    Reader reader{json, {}, {}};
    reader.text("city", scene.city);
    reader.flag("asteroid", scene.asteroid);
    reader.text("terrain", scene.terrain);
    reader.number("scale", k_least_scale, k_most_scale, scene.scale);
    read_people(reader, scene.people);
    reader.texts("idles", scene.idles);
    reader.number("walkers", 0, k_max_walkers, scene.walkers);
    reader.number("seed", uint64_t{0}, std::numeric_limits<uint64_t>::max(), scene.seed);
    reader.number("blocks", 1, 32, scene.blocks);
    reader.text("camera", scene.camera);
    std::string time;
    reader.text("time", time);
    if (!time.empty()) {
        Result<float> hour = parse_time(time);
        if (!hour) return refused("\"time\": " + hour.error().message);
        scene.hour = *hour;
    }
    float height = k_unsaid, heading = k_unsaid;
    reader.number("sun_height", -90.0f, 90.0f, height);
    reader.number("sun_heading", 0.0f, 360.0f, heading);
    if (height != k_unsaid) scene.sun_height = height;
    if (heading != k_unsaid) scene.sun_heading = heading;
    std::string weather = "clear";
    reader.text("weather", weather);
    Result<bool> overcast = parse_weather(weather);
    if (!overcast) return refused("\"weather\": " + overcast.error().message);
    scene.is_overcast = *overcast;
    refuse_unknown(reader, "a scene");
    if (!reader.wrong.empty()) return refused(reader.wrong);
    return scene;
}

}  // namespace

Result<float> parse_time(const std::string& text) {
    auto digit = [&](size_t i) { return text[i] >= '0' && text[i] <= '9' ? text[i] - '0' : 99; };
    bool shaped = text.size() == 5 && text[2] == ':';
    int hours = shaped ? digit(0) * 10 + digit(1) : 99, minutes = shaped ? digit(3) * 10 + digit(4) : 99;
    if (hours > 23 || minutes > 59)
        return Error{"a time is written as 17:30, from 00:00 to 23:59, not " + text};
    return static_cast<float>(hours) + static_cast<float>(minutes) / 60;
}

Result<bool> parse_weather(const std::string& text) {
    if (text == "clear" || text == "overcast") return text == "overcast";
    return Error{"weather is clear or overcast, not " + text};
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : k_scene_files) names.emplace_back(file.name);
    return names;
}

Result<Scene> load_scene(const std::string& name_or_path) {
    for (const EmbeddedFile& file : k_scene_files) {
        if (file.name == name_or_path) return parse_scene(file.text, name_or_path);
    }
    std::filesystem::path path = name_or_path;
    if (!name_or_path.ends_with(".json")) {
        return Error{"There is no scene \"" + name_or_path + "\"; the built-in ones are " +
                     joined(scene_names()) + ", and FILE.json is read as one."};
    }
    std::ifstream file(path);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
        return Error{"Cannot read the scene " + name_or_path +
                     ": is it there, is it a file with anything in it, and may it be read?"};
    }
    Result<Scene> scene = parse_scene(text.str(), name_or_path);
    if (!scene) return scene;
    scene->name = path.stem().string();
    auto beside = [&](std::string& other) { other = (path.parent_path() / other).string(); };
    if (!scene->city.empty()) beside(scene->city);
    if (!scene->terrain.empty()) beside(scene->terrain);
    for (PeopleShare& people : scene->people) {
        if (!people.character.empty()) beside(people.character);
    }
    for (std::string& idle : scene->idles) beside(idle);
    return scene;
}

}  // namespace flaneur
