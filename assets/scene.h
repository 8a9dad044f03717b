// A scene: what to simulate and from where to look. Built-in ones are the files of assets/scenes, compiled
// in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

// Some of the people of a scene.
struct PeopleShare {
    std::string character;  // a glTF or VRM file; empty: the built-in people
    float share = 1;        // of all walkers, against the others' shares: 0.001..1000
    bool operator==(const PeopleShare&) const = default;
};
inline constexpr float k_least_scale = 0.0001f, k_most_scale = 10'000;
inline constexpr float k_least_share = 0.001f, k_most_share = 1000;

struct Scene {
    std::string name = "district";
    std::string city;                 // an OpenStreetMap or glTF file; empty: the built-in district
    bool asteroid = false;            // people walk round the built-in asteroid, not in a city
    std::string terrain;              // an elevation file under an OpenStreetMap city; empty: level ground
    float scale = 1;                  // metres to a unit of a glTF city: 0.0001..10,000
    std::vector<PeopleShare> people;  // empty: the built-in people
    std::vector<std::string> idles;   // FILE or FILE:CLIP, glTF animations that those who stand play
    int walkers = 500;                // 0..100,000
    uint64_t seed = 1;
    int blocks = 4;                 // size of the built-in district
    std::string camera = "street";  // as --camera takes it
    float hour = 17.5f;             // of the day at the first tick, 0..24
    // Degrees above the horizon, and clockwise from north: where the sun stands, whatever the hour.
    std::optional<float> sun_height, sun_heading;
    bool is_overcast = false;
};

// A built-in scene's name, or a path to a .json file. Unknown names, keys and values out of range are
// refused. Relative paths in a file are relative to its folder.
Result<Scene> load_scene(const std::string& name_or_path);

// "17:30" as an hour of the day: 17.5. Refuses what is not HH:MM from 00:00 to 23:59.
Result<float> parse_time(const std::string& text);

// Whether "clear" or "overcast" is overcast. Refuses other weather.
Result<bool> parse_weather(const std::string& text);

// Names of the built-in scenes, sorted.
std::vector<std::string> scene_names();

inline constexpr int k_max_walkers = 100'000;

}  // namespace flaneur
