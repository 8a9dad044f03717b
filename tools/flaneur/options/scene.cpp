#include "tools/flaneur/options/scene.h"

#include <algorithm>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"
#include "tools/flaneur/options/spelling.h"

namespace flaneur {

CLI::Option* add_characters(CLI::App& app, SceneWords& words, const char* description, const char* type) {
    return app
        .add_option_function<std::vector<std::string>>(
            "--character",
            [&words](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    Result<PeopleShare> people = parse_people(text);
                    if (!people)
                        throw CLI::ValidationError("--character " + people.error().message,
                                                   CLI::ExitCodes::ValidationError);
                    words.people.push_back(*people);
                }
            },
            description)
        ->type_name(type)
        ->allow_extra_args(false)
        ->take_all();
}

CLI::Option* add_force(CLI::App& app, Options& options) {
    return app.add_flag("--force", options.force,
                        "Let characters walk that have two legs but lack arms or a head");
}

void add_map_options(CLI::App& app, SceneWords& words) {
    add_parsed(app, "--center", parse_place, words.center,
               "The middle of what is drawn of a map, degrees; without it, the whole map or, of a large one, "
               "where there is most to see",
               "LAT,LON", "");
    app.add_option(
           "--radius", words.radius,
           "How far that reaches to each side, 100 to 3000 metres; without it, as far as can be built "
           "in half a minute, and 1200 about a center")
        ->type_name("M")
        ->check(number_between(k_least_map_radius, k_most_map_radius));
}

void add_place_options(CLI::App& app, SceneWords& words) {
    app.add_option("--scene", words.scene, "A built-in scene (" + joined(scene_names()) + ") or a .json file")
        ->type_name("NAME|FILE")
        ->capture_default_str()
        ->group("Scene");
    app.add_option("--city", words.city,
                   "An OpenStreetMap extract, .osm or .osm.pbf, or a glTF scene, .glb or .gltf")
        ->type_name("FILE")
        ->group("Scene");
    add_map_options(app, words);
    for (const char* name : {"--center", "--radius"}) app.get_option(name)->group("Scene");
    app.add_option("--terrain", words.terrain,
                   "Heights of the ground under it: an SRTM tile (.hgt, .hgt.zip) or a GeoTIFF (.tif)")
        ->type_name("FILE")
        ->group("Scene");
    app.add_option("--scale", words.scale, "Metres to a unit of a glTF city; without it, 1")
        ->type_name("M")
        ->check(number_between(k_least_scale, k_most_scale))
        ->group("Scene");
    add_parsed(app, "--seed", parse_seed, words.seed,
               "Another seed makes other people, ways and, built in, another city", "S", "")
        ->group("Scene");
}

void add_walking_options(CLI::App& app, SceneWords& words, Options& options) {
    app.add_option("--walkers", words.walkers, "How many people, 0 to 1000000")
        ->type_name("N")
        ->transform(whole_between(0, k_max_walkers))
        ->group("Scene");
    add_parsed(app, "--time", parse_time, words.hour,
               "The time of day when it begins, or dawn, noon, dusk or night: the sun stands where it does "
               "then on 26 "
               "August by a summer time whose noon is 13:20, and people go where they go then; without it, "
               "17:30 and "
               "the scene's own sun",
               "HH:MM", "")
        ->group("Scene");
    add_parsed(app, "--side", parse_side, words.side,
               "right or left: on which side people pass those who come the other way; without it, as one "
               "drives there on a map, else right",
               "SIDE", "")
        ->group("Scene");
    app.add_flag("--stay", words.stays,
                 "The same people walk all the time: nobody leaves at doors, stops and the edges of the map, "
                 "and nobody comes in there")
        ->group("Scene");
    add_parsed(app, "--weather", parse_weather, words.is_overcast, "clear or overcast", "WEATHER", "clear")
        ->group("Scene");
    add_threads_option(app, options, "Threads of the simulation; 0: one a core")->group("Scene");
}

void add_scene_options(CLI::App& app, SceneWords& words, Options& options) {
    add_place_options(app, words);
    add_characters(
        app, words,
        "A skinned humanoid, .glb, .gltf or .vrm, or builtin for the built-in people, and its share "
        "of the walkers; may be given several times",
        "FILE[:SHARE]")
        ->group("Scene");
    add_force(app, options)->group("Scene");
    app.add_option("--idle", words.idles,
                   "What people who stand play: stretch, look-out, neck, or an animation of a skinned "
                   "humanoid, .glb or "
                   ".gltf; may be given several times")
        ->type_name("FILE[:CLIP]")
        ->allow_extra_args(false)
        ->take_all()
        ->group("Scene");
    app.add_option("--demand", words.demand,
                   "People who come in at their time, go where they are sent and leave there, beside "
                   "--walkers: a .json, or persons of SUMO, .rou.xml; see docs/life/demand.md")
        ->type_name("FILE")
        ->group("Scene");
    add_walking_options(app, words, options);
}

void add_camera_option(CLI::App& app, SceneWords& words) {
    add_parsed(
        app, "--camera", parse_camera, words.camera,
        "overview, street, crowd, follow:ID, eyes:ID (through a walker's), map or map:X,Z,ACROSS (its "
        "middle and width, metres), or EX,EY,EZ/TX,TY,TZ: where the eye is and what it looks at, metres",
        "CAMERA", "");
    add_parsed(
        app, "--fov", parse_fov, words.fov,
        "The lens: from the picture's lower border to its upper one, 1 to 150 degrees; without it, 32, "
        "or what follow:ID needs",
        "DEGREES", "");
}

static std::string told_place(const Scene& scene) {
    return std::string(k_built_in_names[static_cast<size_t>(scene.built)]);
}

// Refuses a camera or a view that has nothing to show, where something is drawn with it.
static Result<void> check_camera(const SceneWords& words, const Options& options) {
    using enum CameraChoice::Kind;
    bool is_drawn = options.command == Command::view || options.command == Command::render ||
                    options.command == Command::replay ||
                    (options.command == Command::bench && options.load == BenchLoad::frame);
    if (!is_drawn) return {};
    const CameraChoice& camera = options.scene.camera;
    std::string who = words.camera ? "--camera " : "The camera of the scene " + words.scene + ", ";
    const bool is_round = is_small_world(options.scene);
    const WorkViews& views = options.scene.views;
    if (is_round && (views[WorkView::density] || views[WorkView::walkable]))
        return Error{std::string("The view ") + (views[WorkView::density] ? "density" : "walkable") +
                     " is of the ground plane of a city, and here people walk all round."};
    if (is_round && options.command == Command::render && camera.kind != fixed && camera.kind != overview &&
        camera.kind != follow) {
        return Error{who + told_camera(camera) +
                     " is for places where up is one way; here say overview, follow:ID, or "
                     "EX,EY,EZ/TX,TY,TZ, such as 22,13,34/1,0,0."};
    }
    const bool is_of_walker = camera.kind == follow || camera.kind == eyes;
    const int musicians = static_cast<int>(options.scene.along.musicians);
    const int those = options.scene.walkers + options.scene.creatures + musicians;
    if (is_of_walker && !is_recorded(options.scene) && camera.walker >= static_cast<uint32_t>(those)) {
        return Error{
            who + told_camera(camera) + (camera.kind == eyes ? " is of" : " follows") +
            " nobody: walkers are numbered from 0, and there are " + std::to_string(options.scene.walkers) +
            (those > options.scene.walkers
                 ? " and then " + std::to_string(those - options.scene.walkers) + " creatures and musicians."
                 : ".")};
    }
    return {};
}

Result<void> settle_scene(const SceneWords& words, Options& options) {
    const bool is_replayed = !words.replay.empty();
    Result<Scene> scene = is_replayed ? replayed_scene(words, options) : load_scene(words.scene);
    if (!scene && is_replayed) return scene.error();
    if (!scene && has_ending(words.scene, ".json")) return scene.error();
    if (!scene) return Error{scene.error().message + did_you_mean(words.scene, scene_names())};
    options.scene = *scene;
    if (words.city) {
        if (is_small_world(options.scene)) options.scene.creatures = 0;
        options.scene.city = *words.city;
        options.scene.trajectories.clear();
        if (options.scene.walkers == usual_walkers(options.scene.built))
            options.scene.walkers = usual_walkers(BuiltIn::district);
        options.scene.built = BuiltIn::district;
        options.scene.platform.clear();
        options.scene.rock.clear();
        options.scene.flat = false;
        options.scene.look = std::nullopt;
        if (options.scene.habit == Habit::stagger) options.scene.habit = Habit::wander;
        // What is said of the scene's own city.
        options.scene.about.clear();
        options.scene.center = std::nullopt;
        options.scene.radius = 0;
        options.scene.terrain.clear();
        options.scene.scale = 1;
    }
    if (words.terrain) options.scene.terrain = *words.terrain;
    bool no_map = options.scene.city.empty() && options.command != Command::inspect;
    if (!options.scene.terrain.empty() && no_map)
        return Error{"--terrain " + options.scene.terrain +
                     " lies under an OpenStreetMap city only; give one with --city."};
    if (words.center) options.scene.center = words.center;
    if (words.radius) options.scene.radius = *words.radius;
    if (words.center || words.radius) {
        const std::string& map = options.command == Command::inspect ? options.file : options.scene.city;
        if (kind_of(map) != FileKind::map)
            return Error{std::string(words.center ? "--center" : "--radius") +
                         " chooses what is drawn of an OpenStreetMap city; give one with --city."};
    }
    if (words.scale) {
        options.scene.scale = *words.scale;
        bool has_units = !options.scene.city.empty() && kind_of(options.scene.city) != FileKind::map;
        if (!has_units)
            return Error{"--scale is for a glTF city; " +
                         (options.scene.city.empty() ? std::string("the built-in one")
                                                     : "the map " + options.scene.city) +
                         " is in metres."};
    }
    if (!words.people.empty()) options.scene.people = words.people;
    if (!words.idles.empty()) options.scene.idles = words.idles;
    options.inputs = {words.scene, options.file, options.camera_path, words.replay};
    if (is_recorded(options.scene) && (words.walkers || words.demand))
        return Error{std::string(words.walkers ? "--walkers" : "--demand") +
                     ": nobody walks here but those in " + options.scene.trajectories + "."};
    if (words.walkers) options.scene.walkers = *words.walkers;
    if (words.seed) options.scene.seed = *words.seed;
    if (words.hour) {
        options.scene.hour = *words.hour;
        options.scene.sun_height = options.scene.sun_heading = std::nullopt;
    }
    if (words.is_overcast) options.scene.is_overcast = *words.is_overcast;
    if (words.side) options.scene.side = *words.side;
    if (words.stays) options.scene.stays = true;
    if (words.demand) options.scene.demand = *words.demand;
    // Of fewer people than the scene has, those are pushed who are there.
    if (words.walkers) leave_out_nobody(options.scene);
    if (is_small_world(options.scene) && words.stays)
        return Error{"--stay is for cities: nobody leaves the " + told_place(options.scene) + " anyway."};
    if (is_small_world(options.scene) && words.side)
        return Error{"--side is for cities: on the " + told_place(options.scene) +
                     " people pass where there is room."};
    if (is_small_world(options.scene) && !options.scene.demand.empty())
        return Error{"Nobody can be sent anywhere on the " + told_place(options.scene) + ", as " +
                     options.scene.demand + " asks for; take a city."};
    const bool is_course = is_of(options.scene, BuiltIn::course);
    if (is_course && words.stays) return Error{"--stay is for cities: nobody leaves a course anyway."};
    if (is_course && words.side)
        return Error{"--side is for cities: on a course all go the same way, and nobody passes."};
    if (is_course && !options.scene.demand.empty())
        return Error{"Nobody can be sent anywhere on a course, as " + options.scene.demand +
                     " asks for; take a city."};
    if (options.command == Command::gait) {
        const GaitOptions& gait = options.gait;
        int walks = (gait.turn != 0) + !gait.stairs.empty() + (gait.slope != 0) + (gait.kerb != 0) +
                    (gait.leap != 0) + (gait.crowd > 0);
        if (walks > 1)
            return Error{
                "gait measures one of --turn, --stairs, --slope, --kerb, --leap and --crowd at a time."};
        if (gait.crowd > 0 && gait.walker >= gait.crowd)
            return Error{"--walker " + std::to_string(gait.walker) +
                         " is nobody: people are numbered from 0, and there are " +
                         std::to_string(gait.crowd) + "."};
        bool steady = gait.turn == 0 && gait.kerb == 0 && gait.leap == 0 && gait.crowd == 0;
        if (!steady && !gait.svg.empty())
            return Error{"--svg draws the curves of steady walking: on level ground, a slope or stairs."};
    }
    if (options.command == Command::gait && !is_recorded(options.scene))
        options.scene.walkers = std::max(options.gait.crowd, 1);
    // Who walks alone is nobody of the scene's.
    if (options.command == Command::gait && options.gait.crowd == 0) options.scene.pushes.clear();
    if (const auto nobody = pushed_nobody(options.scene))
        return Error{"The scene pushes walker " + std::to_string(*nobody) +
                     ", who is nobody: walkers are numbered from 0, and there are " +
                     std::to_string(options.scene.walkers) + "."};
    if (words.camera) options.scene.camera = *words.camera;
    if (words.fov) options.scene.fov = *words.fov;
    if (words.fov && options.scene.camera.kind == CameraChoice::Kind::map)
        return Error{"--fov is for a picture in perspective: a map is as wide as map:X,Z,ACROSS says."};
    options.techniques = words.techniques.value_or(usual_techniques(options.scene.limbs));
    if (words.size) options.scene.size = *words.size;
    if (words.quality) options.scene.quality = *words.quality;
    if (words.views) options.scene.views = *words.views;
    return check_camera(words, options);
}

}  // namespace flaneur
