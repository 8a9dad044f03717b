#include "tools/flaneur/window/settings/settings.h"

#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t k_most_bytes = 1 << 16, k_depth = 4, k_values = 100;

// One of two words.
Result<void> read_word(const Json& json, const char* key, const char* no, const char* yes, bool& to) {
    const auto at = json.find(key);
    if (at == json.end()) return {};
    const std::string word = at->is_string() ? at->get<std::string>() : at->dump();
    if (word != no && word != yes)
        return Error{std::string("says that ") + key + " is " + excerpt(word) + ", not " + no + " or " + yes};
    to = word == yes;
    return {};
}

// A number between these, or 0 where that may be.
template <class Number>
Result<void> read_number(const Json& json, const char* key, Number least, Number most, bool may_be_0,
                         Number& to) {
    const auto at = json.find(key);
    if (at == json.end()) return {};
    const double value = at->is_number() ? at->get<double>() : -1;
    const bool is_0 = may_be_0 && value == 0;
    if (!is_0 && !(value >= static_cast<double>(least) && value <= static_cast<double>(most)))
        return Error{std::string("says that ") + key + " is " +
                     excerpt(at->dump(-1, ' ', true, Json::error_handler_t::replace)) + ", not " +
                     (may_be_0 ? "0 or " : "") + std::to_string(least) + " to " + std::to_string(most)};
    to = static_cast<Number>(value);
    return {};
}

}  // namespace

float stepped_letters(float letters, int steps) {
    constexpr float k_sizes[] = {k_least_letters, 1.1f, 1.25f, 1.5f, 1.75f, 2, 2.5f, k_most_letters};
    constexpr float k_same = 0.005f;
    if (steps > 0) {
        for (const float size : k_sizes)
            if (size > letters + k_same && --steps == 0) return size;
        return k_most_letters;
    }
    for (size_t i = std::size(k_sizes); i-- > 0;)
        if (steps < 0 && k_sizes[i] < letters - k_same && ++steps == 0) return k_sizes[i];
    return steps < 0 ? k_least_letters : letters;
}

std::string settings_file() {
    const std::string folder = user_folder("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? "" : folder + "/settings.json";
}

Result<Settings> parse_settings(std::string_view text) {
    if (Result<void> checked = check_json(text, k_depth, k_values); !checked) return checked.error();
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return Error{"is no JSON object"};
    Settings s;
    for (const Result<void>& read :
         {read_number(json, "letters", k_least_letters, k_most_letters, true, s.letters),
          read_word(json, "theme", "dark", "light", s.is_light),
          read_number(json, "fps", k_least_fps, k_most_fps, true, s.fps),
          read_number(json, "pace", k_least_pace, k_most_pace, false, s.pace),
          read_word(json, "look", "plain", "inverted", s.inverts_look),
          read_word(json, "wheel", "plain", "inverted", s.inverts_wheel)})
        if (!read) return read.error();
    return s;
}

std::string told(const Settings& s) {
    Json json;
    json["letters"] = Json::parse(plainly(s.letters));  // as short as it is
    json["theme"] = s.is_light ? "light" : "dark";
    json["fps"] = s.fps;
    json["pace"] = Json::parse(plainly(s.pace));
    json["look"] = s.inverts_look ? "inverted" : "plain";
    json["wheel"] = s.inverts_wheel ? "inverted" : "plain";
    return json.dump(4) + "\n";
}

Result<Settings> read_settings(const std::string& file) {
    std::error_code unknown;
    if (file.empty() || !std::filesystem::exists(file, unknown)) return Settings();
    return read_parsed(file, k_most_bytes, parse_settings, "The settings are as usual");
}

Result<void> keep_settings(const std::string& file, const Settings& settings) {
    return write_file(file, told(settings));
}

}  // namespace flaneur
