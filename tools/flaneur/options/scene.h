// The part of the command line that says what scene it is about. Private to tools/flaneur/options*.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/flaneur/options/options.h"

namespace flaneur {

// What the command line says about the scene, on top of the one it names.
struct SceneWords {
    std::string scene = "district";
    std::optional<std::string> city, terrain, quality;
    std::vector<PeopleShare> people;
    std::vector<std::string> idles;
    std::optional<MapPlace> center;
    std::optional<float> radius, scale;
    std::optional<int> walkers;
    std::optional<uint64_t> seed;
    std::optional<float> hour;
    std::optional<bool> is_overcast;
    std::optional<PassOn> side;
    bool stays = false;
    std::optional<std::string> demand;
    std::optional<CameraChoice> camera;
    std::optional<float> fov;
    std::optional<Size> size;
    std::optional<WorkViews> views;
    std::optional<Techniques> techniques;
    std::string replay;         // a recording, or trajectories, whose scene it is; empty: `scene` is named
    TrajectoryReading reading;  // of trajectories
    Entering entering = Entering::fade;
};

// An option whose text one of the parse_ functions takes apart. What they refuse with begins with the text.
template <class T, class To>
CLI::Option* add_parsed(CLI::App& app, const char* name, Result<T> (*parse)(const std::string&), To& to,
                        const char* description, const char* type, const char* shown) {
    return app
        .add_option_function<std::string>(
            name,
            [=, &to](const std::string& text) {
                Result<T> value = parse(text);
                if (!value) {
                    std::string option = *name == '-' ? std::string(name) + " " : "";
                    throw CLI::ValidationError(option + value.error().message,
                                               CLI::ExitCodes::ValidationError);
                }
                to = *value;
            },
            description)
        ->type_name(type)
        ->default_str(shown);
}

// Options that fill `words`, and some of `options` itself: --character; what is drawn of a map; where; who
// walks there and when; all of these.
CLI::Option* add_characters(CLI::App& app, SceneWords& words, const char* description, const char* type);
void add_map_options(CLI::App& app, SceneWords& words);
void add_place_options(CLI::App& app, SceneWords& words);
void add_walking_options(CLI::App& app, SceneWords& words, Options& options);
void add_scene_options(CLI::App& app, SceneWords& words, Options& options);
// For commands that take characters.
CLI::Option* add_force(CLI::App& app, Options& options);
void add_camera_option(CLI::App& app, SceneWords& words);

// Reads the scene that is named, and puts what `words` say over it. Refuses what does not go together.
Result<void> settle_scene(const SceneWords& words, Options& options);

}  // namespace flaneur
