#include "tools/flaneur/options_scene.h"

#include <algorithm>

namespace flaneur {

CLI::Option* add_characters(CLI::App& app, SceneWords& words, const char* description, const char* type) {
    return app
        .add_option_function<std::vector<std::string>>(
            "--character",
            [&words](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    Result<PeopleShare> people = parse_people(text);
                    if (!people)
                        throw CLI::ValidationError(people.error().message, CLI::ExitCodes::ValidationError);
                    words.people.push_back(*people);
                }
            },
            description)
        ->type_name(type)
        ->allow_extra_args(false)
        ->take_all();
}

void add_place_options(CLI::App& app, SceneWords& words) {
    std::string names;
    for (const std::string& name : scene_names()) names += (names.empty() ? "" : ", ") + name;
    app.add_option("--scene", words.scene, "A built-in scene (" + names + ") or a .json file")
        ->type_name("NAME|FILE")
        ->capture_default_str()
        ->group("Scene");
    app.add_option("--city", words.city,
                   "An OpenStreetMap extract, .osm or .osm.pbf, or a glTF scene, .glb or .gltf")
        ->type_name("FILE")
        ->group("Scene");
    app.add_option("--terrain", words.terrain,
                   "Heights of the ground under it: an SRTM tile (.hgt, .hgt.zip) or a GeoTIFF (.tif)")
        ->type_name("FILE")
        ->group("Scene");
    app.add_option("--scale", words.scale, "Metres to a unit of a glTF city; without it, 1")
        ->type_name("M")
        ->check(CLI::Range(k_least_scale, k_most_scale).description(""))
        ->group("Scene");
    add_parsed(app, "--seed", parse_seed, words.seed,
               "Another seed makes other people, ways and, built in, another city", "S", "")
        ->group("Scene");
}

void add_walking_options(CLI::App& app, SceneWords& words, Options& options) {
    app.add_option("--walkers", words.walkers, "How many people, 0 to 100000")
        ->type_name("N")
        ->check(CLI::Range(0, k_max_walkers).description(""))
        ->group("Scene");
    add_parsed(app, "--time", parse_time, words.hour,
               "The time of day, which moves the sun and sends people elsewhere", "HH:MM", "17:30")
        ->group("Scene");
    add_parsed(app, "--weather", parse_weather, words.is_overcast, "clear or overcast", "WEATHER", "clear")
        ->group("Scene");
    app.add_option("--threads", options.threads, "Threads of the simulation; 0: one a core")
        ->type_name("N")
        ->check(CLI::Range(0, 256).description(""))
        ->capture_default_str()
        ->group("Scene");
}

void add_scene_options(CLI::App& app, SceneWords& words, Options& options) {
    add_place_options(app, words);
    add_characters(
        app, words,
        "A skinned humanoid, .glb, .gltf or .vrm, or builtin for the built-in people, and its share "
        "of the walkers; may be given several times",
        "FILE[:SHARE]")
        ->group("Scene");
    app.add_option(
           "--idle", words.idles,
           "An animation of a skinned humanoid, .glb or .gltf, that people who stand play; may be given "
           "several times")
        ->type_name("FILE[:CLIP]")
        ->allow_extra_args(false)
        ->take_all()
        ->group("Scene");
    add_walking_options(app, words, options);
}

void add_camera_option(CLI::App& app, SceneWords& words) {
    app.add_option(
           "--camera", words.camera,
           "overview, street, follow:ID, or EX,EY,EZ/TX,TY,TZ: where the eye is and what it looks at, metres")
        ->type_name("CAMERA");
}

Result<void> settle_scene(const SceneWords& words, Options& options) {
    Result<Scene> scene = load_scene(words.scene);
    if (!scene) return scene.error();
    options.scene = *scene;
    if (words.city) {
        options.scene.city = *words.city;
        options.scene.asteroid = false;
    }
    if (words.terrain) options.scene.terrain = *words.terrain;
    bool no_map = options.scene.city.empty() && options.command != Command::inspect;
    if (!options.scene.terrain.empty() && no_map)
        return Error{"--terrain " + options.scene.terrain +
                     " lies under an OpenStreetMap city only; give one with --city."};
    if (words.scale) options.scene.scale = *words.scale;
    if (!words.people.empty()) options.scene.people = words.people;
    if (!words.idles.empty()) options.scene.idles = words.idles;
    if (words.walkers) options.scene.walkers = *words.walkers;
    if (words.seed) options.scene.seed = *words.seed;
    if (words.hour) {
        options.scene.hour = *words.hour;
        options.scene.sun_height = options.scene.sun_heading = std::nullopt;
    }
    if (words.is_overcast) options.scene.is_overcast = *words.is_overcast;
    if (options.command == Command::gait) {
        const GaitOptions& gait = options.gait;
        int walks =
            (gait.turn != 0) + !gait.stairs.empty() + (gait.slope != 0) + (gait.kerb != 0) + (gait.crowd > 0);
        if (walks > 1)
            return Error{"gait measures one of --turn, --stairs, --slope, --kerb and --crowd at a time."};
        bool steady = gait.turn == 0 && gait.kerb == 0 && gait.crowd == 0;
        if (!steady && !gait.svg.empty())
            return Error{"--svg draws the curves of steady walking: on level ground, a slope or stairs."};
    }
    if (options.command == Command::gait) options.scene.walkers = std::max(options.gait.crowd, 1);
    if (options.command == Command::city && !options.check && !options.out.ends_with(".glb"))
        return Error{"city --out " + options.out + " is no .glb, which is what a city is written as."};
    if (words.camera) options.scene.camera = *words.camera;
    Result<CameraChoice> camera = parse_camera(options.scene.camera);
    if (!camera) return camera.error();
    options.camera = *camera;
    if (options.scene.asteroid && options.command == Command::render &&
        camera->kind != CameraChoice::Kind::fixed) {
        return Error{"--camera " + options.scene.camera +
                     " is for cities; on the asteroid say EX,EY,EZ/TX,TY,TZ, such as 22,13,34/1,0,0."};
    }
    if (camera->kind == CameraChoice::Kind::follow &&
        camera->walker >= static_cast<uint32_t>(options.scene.walkers)) {
        return Error{"--camera " + options.scene.camera +
                     " follows nobody: walkers are numbered from 0, and there are " +
                     std::to_string(options.scene.walkers) + "."};
    }
    return {};
}

}  // namespace flaneur
