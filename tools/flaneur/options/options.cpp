#include <cstdlib>
#include <iostream>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/like.h"
#include "tools/flaneur/options/refusal.h"
#include "tools/flaneur/options/scene.h"
#include "tools/flaneur/options/unused.h"

namespace flaneur {

namespace {

constexpr const char* k_footer = R"(Examples:
  flaneur view                                             walk about in the built-in city
  flaneur render --out out/city.png                        a picture of it
  flaneur render --city berlin.osm --walkers 2000 --frames 600:1200 --out out/berlin.mp4
  flaneur sim --seconds 60 --hash                          the same number on every x86-64 machine
  flaneur bench frame --walkers 2000                       where the time of a frame goes
  flaneur people --count 24 --sheet out/people.png         who lives there
  flaneur inspect me.glb                                   what is found in a character
  flaneur city --city berlin.osm --out out/berlin.glb      a city, to open elsewhere
  flaneur cache --clear                                    remove what is kept between runs
`flaneur render --help` and so on tell more.)";

constexpr const char* k_people_footer =
    R"(Prints who they are: age, height and triangles of each. The files are skinned on 22 joints with VRM's names.
A cell of a sheet shows one person twice: with its arms held out, and in the middle of a step; --close shows its face.
Examples:
  flaneur people --count 24 --seed 1 --sheet out/people.png    pictures of 24 of the built-in people
  flaneur people --count 24 --seed 1 --out out/people          the same people as out/people/person_01.glb, ...
  flaneur people --count 6 --close --size 800x500 --sheet out/faces.png
  flaneur people --turn 180 --sheet out/backs.png              all of them from behind
  flaneur people --character me.glb --character you.glb --sheet out/us.png)";

constexpr const char* k_inspect_footer =
    R"(Of a character: which node of the file each joint was taken from, size, facing, triangles, animations and what was
repaired. Of a map: where on Earth it is, what of it render draws, ground and houses, what it has beside what was built
of it, and what was skipped.
Refuses, in a sentence, what cannot be used.
Examples:
  flaneur inspect me.glb
  flaneur inspect berlin.osm.pbf --json out/berlin.json
  flaneur inspect monaco.osm.pbf --terrain N43E007.hgt.zip
  flaneur inspect berlin.osm.pbf --center 52.5163,13.3777 --radius 800)";

constexpr const char* k_city_footer =
    R"(--check says whether people can live there: nothing walkable inside buildings, the ground as it is drawn, ways between
sidewalks, and a crowd that nothing stops; it fails where a bar is missed.
--out writes what is drawn, but for what shaders add, in metres, +y up: grouped into ground, facades, roofs
and props, with materials named road, sidewalk, facade and so on. Names and slopes are all that it takes to read it
back as --city FILE.glb.
Examples:
  flaneur city --out out/district.glb
  flaneur city --city berlin.osm.pbf --out out/berlin.glb
  flaneur city --city berlin.osm.pbf --check --walkers 2000 --seconds 300)";

constexpr const char* k_scenes_footer =
    R"(A scene is a JSON file that says what to simulate and from where to look; what the command line says goes before it.
docs/scenes.md tells all its keys, and so does the schema.
Examples:
  flaneur scenes                                           the built-in ones
  flaneur scenes --check mine.json yours.json              what is wrong in them
  flaneur scenes --schema > scene.schema.json              in a scene: "$schema": "scene.schema.json")";

constexpr const char* k_cache_footer =
    R"(Navigation meshes and built-in people are kept between runs in $XDG_CACHE_HOME/flaneur, or ~/.cache/flaneur, and are
the same as those made anew. They take 1024 MiB at most, or as many as FLANEUR_CACHE_MAX says; those that were used least
recently go first. With --no-cache a command neither reads nor keeps any.
Examples:
  flaneur cache                where they are, and how much
  flaneur cache --clear        remove them
  FLANEUR_CACHE_MAX=200 flaneur view
  flaneur render --no-cache --out out/city.png)";

constexpr const char* k_view_footer =
    R"(Keys: W A S D or arrows fly, E and Q rise and sink, Shift is faster, dragging the mouse looks around,
the wheel zooms to the cursor, the middle button drags along and the right one round;
Space pauses, . makes one tick, - and + change how fast time goes by; 1 street, 2 overview, 3 follow a walker, Tab the
next one, 4 through its eyes, 5 a map, G walk on foot; who is clicked is told about, F looks at them, Shift+F follows;
[ and ] change the lens; Ctrl+1 to 9 keep a camera, Alt+1 to 9 go back there; L lists layers, the views for work, F2 to
F11; M measures, / finds people, J shows how one walks; H hides the panels; F12 writes a picture to out/, R a film; C
copies the command that draws it; Ctrl+O opens a file, and so does dropping it; Ctrl+P finds any action by its name; F1
lists the keys; Ctrl+Q quits.
Examples:
  flaneur view --scene square
  flaneur view --city berlin.osm --walkers 5000 --camera follow:12
  flaneur view --start                                          scenes to choose from
  flaneur view --character me.glb --character you.glb
  flaneur view --character robot.glb:1 --character builtin:9    one in ten is a robot)";

constexpr const char* k_render_footer =
    R"(One tick is 1/60 s of simulation. A film plays in real time: 60 pictures a second, or 60 / STEP.
Examples:
  flaneur render --out out/city.png                                       one picture, ten seconds in
  flaneur render --frames 0:600:2 --size 1920x1080 --out out/city.mp4     ten seconds at 30 pictures a second
  flaneur render --frames 0:59 --out out/%05d.png                         a picture for each tick
  flaneur render --city berlin.osm --camera overview --out out/berlin.png
  flaneur render --city berlin.osm.pbf --center 52.5163,13.3777 --radius 800 --out out/gate.png
  flaneur render --time 22:00 --quality high --out out/night.png
  flaneur render --city monaco.osm.pbf --terrain N43E007.hgt.zip --out out/monaco.png
  flaneur render --view skeletons,trails --camera follow:3 --out out/bones.png
  flaneur render --without feet --camera follow:3 --out out/before.png    legs by joint curves alone
  flaneur render --camera 0,1.7,-20/0,1.5,0 --fov 50 --walkers 100 --out out/from_here.png
  flaneur render --camera eyes:3 --frames 600:1200:2 --out out/eyes.mp4   what walker 3 sees
  flaneur render --camera map --out out/map.png                           all of the city from straight above
  flaneur render --camera-path way.json --out out/way.mp4                 a camera that moves
  flaneur render --like out/view-361.png --size 3840x2160 --out out/large.png
  flaneur render --transparent --depth out/depth.png --out out/cut_out.png
  flaneur render --frames 600:1200:60 --ids out/%05d-ids.png --out out/%05d.png
A camera path is JSON: { "keys": [ { "time": 0, "eye": [0, 1.7, -20], "target": [0, 1.5, 0], "fov": 32 }, ... ] } in
seconds, metres and degrees; the window's Cameras room records one, plays it and writes it.)";

constexpr const char* k_sim_footer =
    R"(Runs without Vulkan. The hash covers the whole state; the same city, people, walkers and seed give the same
one for any number of threads, on any x86-64 machine.
--line and --zone count people, as the room Measure of `flaneur view` does, which also draws both and copies them as these
options. Metres, x to the east and z to the south; flaneur inspect MAP says where on Earth that is. What was counted is
printed; --measures FILE.csv writes FILE-L1.csv of the first line, a row for each crossing (when, who, to which side of one
who looks from the line's first end to its last, how fast, where), and FILE-Z1.csv of the first zone, a row for each second
(people, density, density by Voronoi cells, mean speed). docs/viewer.md tells how it is counted.
Examples:
  flaneur sim --walkers 500 --seconds 60 --hash
  flaneur sim --seconds 10 --hash-log out/a.txt --threads 1     compare two runs with diff
  flaneur sim --seconds 300 --line -4,12/4,12 --measures out/flow.csv
  flaneur sim --seconds 300 --line door:2,8/5,8 --zone 0,0/8,0/8,6/0,6 --measures out/square.csv
  flaneur sim --seconds 300 --measures-of measures.json --measures out/flow.csv)";

constexpr const char* k_bench_footer =
    R"(Loads: frame (simulation and drawing, off-screen), window (the whole viewer, at rest and looking about, with panels and
without; takes a display), crowd (the simulation), pose (the kernels that pose bodies, on one thread), city (how long it
takes to read, and its queries on one thread), peers (a scene that other renderers were measured by: copies of one character
that play its own clip, drawn with levels of detail and with every triangle). frame, window, crowd and peers print the median and percentiles of each stage in milliseconds; pose prints nanoseconds a walker on each instruction
set that the CPU has, city nanoseconds a query, beside the goals.
Examples:
  flaneur bench frame --walkers 500 --size 1280x720
  flaneur bench window --walkers 500
  flaneur bench crowd --walkers 100000 --threads 8 --json out/crowd.json
  flaneur bench pose --walkers 1000
  flaneur bench city --city monaco.osm.pbf
  flaneur bench peers --count 500 --character CesiumMan.glb --out out/peers)";

constexpr const char* k_gait_footer =
    R"(Prints each quantity of the walk beside the bar it is held to; docs/gait.md explains both.
Examples:
  flaneur gait --speed 1.3                                 one person on level ground
  flaneur gait --speed 1.3 --check                         every walk that has bars: fails if one is missed
  flaneur gait --everyone --check                          the same of women and men from 4 to 80 years
  flaneur gait --speed 1.3 --svg out/gait.svg --json out/gait.json
  flaneur gait --sex woman --age 75                        as fast as she likes
  flaneur gait --turn 180                                  a half turn on the way
  flaneur gait --stairs up --riser 0.16 --tread 0.32
  flaneur gait --slope -8
  flaneur gait --crowd 1000 --seconds 60 --check           feet, joints and manners of a whole crowd
  flaneur gait --crowd 500 --city town.osm.pbf             the same in a city of yours
  flaneur gait --stairs up --export out/up.bvh             its motion, for animation programs: metres, +y up, ahead
                                                           along +z, at 60 frames a second
  flaneur gait --crowd 500 --walker 12 --export out/12.glb
                                                           that of one of a crowd, as glTF with a doll to look at
  flaneur gait --strip out/strip.png --view front
  flaneur gait --strip out/stop.png --moments 21.8:24      one who stands for a second, walks, and stops after 22
  flaneur gait --speed 1.4 --change 3.1 --strip out/run.png --moments 4.8:6.8
  flaneur gait --abreast --strip out/people.png            twelve people, each with a walk of their own
  flaneur gait --stand 60 --style 3 --strip out/stand.png --view front
                                                           what the hands of one who waits do
  flaneur gait --stand 12 --aside 0.6 --strip out/aside.png --view front
  flaneur gait --stairs down --age 80 --strip out/stairs.mp4 --moments 9:17
                                                           a film of what a strip shows)";

Result<BenchLoad> parse_load(const std::string& text) {
    if (text == "frame") return BenchLoad::frame;
    if (text == "window") return BenchLoad::window;
    if (text == "crowd") return BenchLoad::crowd;
    if (text == "pose") return BenchLoad::pose;
    if (text == "city") return BenchLoad::city;
    if (text == "peers") return BenchLoad::peers;
    return Error{excerpt(text) +
                 " is none of frame, window, crowd, pose, city and peers, which bench measures"};
}

Result<bool> parse_light(const std::string& text) {
    if (text == "host" || text == "device") return text == "host";
    return Error{excerpt(text) + " is neither device nor host"};
}

Result<BenchMove> parse_move(const std::string& text) {
    if (text == "follow") return BenchMove::follow;
    if (text == "walk") return BenchMove::walk;
    if (text == "orbit") return BenchMove::orbit;
    return Error{excerpt(text) + " is none of follow, walk and orbit, the ways a camera moves"};
}

Result<StripView> parse_view(const std::string& text) {
    if (text == "side") return StripView::side;
    if (text == "front") return StripView::front;
    return Error{excerpt(text) + " is neither side nor front"};
}

void add_drawing_options(CLI::App& app, SceneWords& words, Options& options) {
    app.add_option("--device", options.device, "Part of the name of a Vulkan device, or its number")
        ->type_name("NAME");
    app.add_flag("--validate", options.validate, "Fail if the Khronos validation layer has anything to say");
    add_parsed(app, "--size", parse_size, words.size, "Pixels", "WxH", "1280x720");
    add_parsed(
        app, "--quality", parse_quality, words.quality,
        "low, medium (smooth edges), high (four samples a pixel, sharper shadows, people in more detail) or "
        "ultra (and the shade of what is close by); without it, medium on a CPU, high on a GPU within one, "
        "ultra on others",
        "LEVEL", "");
    add_parsed(
        app, "--light", parse_light, options.lights_on_host,
        "device or host: who lights what is drawn, to the same colours within 1 of 255; without it, the "
        "host where the device is a CPU, which is ten times as slow at it by itself",
        "WHERE", "");
}

// "trails,speed"
Result<WorkViews> parse_view_list(const std::string& text) {
    std::vector<std::string> names;
    for (std::string_view name : split(text, ',')) {
        if (name.empty()) return Error{excerpt(text) + " has a comma that no view stands beside"};
        names.emplace_back(name);
    }
    return parse_work_views(names);
}

void add_work_views(CLI::App& app, SceneWords& words) {
    add_parsed(
        app, "--view", parse_view_list, words.views,
        "Views for work, such as skeletons,trails: wireframe, normals or overdraw; lods or speed; density "
        "or walkable; trails; skeletons; gizmos",
        "VIEW,...", "");
}

void add_without(CLI::App& app, Options& options) {
    std::string names;
    for (const TechniqueInfo& technique : k_techniques)
        names.append(names.empty() ? "" : ", ").append(technique.name);
    add_parsed(app, "--without", parse_without, options.techniques,
               ("Draw bodies without some of what makes them, such as feet,walls: " + names +
                "; see docs/gait.md. They walk as ever")
                   .c_str(),
               "NAME,...", "");
}

void add_view(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* view = app.add_subcommand("view", "Watch the city in a window")->footer(k_view_footer);
    view->callback([&] { options.command = Command::view; });
    add_scene_options(*view, words, options);
    add_drawing_options(*view, words, options);
    add_camera_option(*view, words);
    add_work_views(*view, words);
    add_without(*view, options);
    view->add_flag("--start", options.starts, "Begin with the built-in scenes, and the files opened of late");
    view->add_option("--frames", options.close_after, "Close when so many pictures were shown; 0: stay open")
        ->type_name("N")
        ->transform(whole_between(0, 1'000'000'000))
        ->capture_default_str();
}

void add_render(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* render = app.add_subcommand("render", "Write pictures or a film")->footer(k_render_footer);
    render->callback([&, render] {
        options.command = Command::render;
        options.has_ticks = render->count("--frames") > 0;
    });
    add_scene_options(*render, words, options);
    add_drawing_options(*render, words, options);
    add_camera_option(*render, words);
    add_work_views(*render, words);
    add_without(*render, options);
    add_parsed(*render, "--frames", parse_ticks, options.ticks,
               "Which ticks of the simulation, 60 to the second, to draw: N, A:B or A:B:STEP", "TICKS",
               "600");
    CLI::Option* path =
        render
            ->add_option(
                "--camera-path", options.camera_path,
                "A way of the camera, as the window's Cameras room writes it; see docs/views.md. The "
                "first picture is at its second 0; without --frames, all of it from tick 600 on")
            ->type_name("FILE");
    for (const char* other : {"--camera", "--fov"}) path->excludes(render->get_option(other));
    render
        ->add_option(
            "--out", options.out,
            "FILE.png for one picture, DIR/%05d.png for one a tick, FILE.mp4 for a film (needs ffmpeg)")
        ->type_name("FILE")
        ->required();
    render
        ->add_option("--like", options.like,
                     "A picture, .png, that F12 wrote in `flaneur view`: its options, but for those that are "
                     "given here")
        ->type_name("FILE");
    render->add_flag("--transparent", options.is_transparent,
                     "Where there is sky, pictures are seen through");
    render
        ->add_option(
            "--depth", options.depth,
            "Write how far away it is too, what a picture shows: metres in a FILE.exr or FILE.pfm, or "
            "centimetres in a FILE.png of 16 bits; 0 for the sky. DIR/%05d.exr for one a tick")
        ->type_name("FILE");
    render
        ->add_option(
            "--ids", options.ids,
            "Write too which walker, house, tree, car, prop or ground each pixel shows: a number each "
            "in a FILE.exr, or in the three bytes of a FILE.png, and FILE.json, which says what they "
            "are. DIR/%05d.exr for one a tick")
        ->type_name("FILE");
    render->add_flag("--resume", options.resume,
                     "Go on with a film, or numbered pictures, that the same command began");
}

// Options that may be given again and again, each of which adds to the plan.
void add_measures(CLI::App& sim, MeasurePlan& plan) {
    auto add = [&sim](const char* name, auto take, const char* description, const char* type) {
        sim.add_option_function<std::vector<std::string>>(
               name,
               [=](const std::vector<std::string>& texts) {
                   for (const std::string& text : texts)
                       if (Result<void> taken = take(text); !taken)
                           throw CLI::ValidationError(std::string(name) + " " + taken.error().message,
                                                      CLI::ExitCodes::ValidationError);
               },
               description)
            ->type_name(type)
            ->allow_extra_args(false)
            ->take_all();
    };
    add(
        "--line",
        [&plan](const std::string& text) -> Result<void> {
            Result<CountLine> line = parse_count_line(text);
            if (!line) return line.error();
            plan.lines.push_back(std::move(*line));
            return {};
        },
        "Count who crosses a line, by its ends in metres; may be given several times", "[NAME:]X,Z/X,Z");
    add(
        "--zone",
        [&plan](const std::string& text) -> Result<void> {
            Result<CountZone> zone = parse_count_zone(text);
            if (!zone) return zone.error();
            plan.zones.push_back(std::move(*zone));
            return {};
        },
        "Count who is in a zone, by its corners; may be given several times", "[NAME:]X,Z/X,Z/X,Z...");
    add(
        "--measures-of",
        [&plan](const std::string& text) -> Result<void> {
            Result<MeasurePlan> more = read_plan(text);
            if (!more) return more.error();
            plan.lines.insert(plan.lines.end(), more->lines.begin(), more->lines.end());
            plan.zones.insert(plan.zones.end(), more->zones.begin(), more->zones.end());
            return {};
        },
        "The lines and zones of a .json file that the room Measure of `flaneur view` has written", "FILE");
}

// Refuses what has nothing to count.
Result<void> settle_measures(Options& options) {
    if (!options.measures.empty() && is_empty(options.plan))
        return Error{
            "--measures writes what lines and zones count: give some with --line, --zone or --measures-of."};
    if (!is_empty(options.plan) && options.scene.asteroid)
        return Error{
            "--line and --zone are of the ground plane of a city, and people walk all round the asteroid."};
    if (Result<void> named = name_all(options.plan); !named)
        return Error{named.error().message + ": give one of them another name, as in --line NAME:X,Z/X,Z."};
    return {};
}

void add_sim(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* sim = app.add_subcommand("sim", "Simulate without drawing")->footer(k_sim_footer);
    sim->callback([&] { options.command = Command::sim; });
    add_scene_options(*sim, words, options);
    sim->add_option("--seconds", options.seconds, "How long, in simulated time")
        ->type_name("T")
        ->check(number_between(0.0, 1e6))
        ->capture_default_str();
    sim->add_flag("--hash", options.hash, "Print the hash of the last state");
    sim->add_option("--hash-log", options.hash_log, "Write a line with tick and hash for each tick")
        ->type_name("FILE");
    sim->add_option("--isa", options.isa, "Instruction set to run on: sse4, avx2, avx512, neon or best")
        ->type_name("NAME")
        ->capture_default_str();
    add_measures(*sim, options.plan);
    sim->add_option("--measures", options.measures,
                    "Write what lines and zones counted: FILE-L1.csv, FILE-Z1.csv and so on")
        ->type_name("FILE.csv");
}

void add_bench(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* bench = app.add_subcommand("bench", "Measure")->footer(k_bench_footer);
    bench->callback([&] { options.command = Command::bench; });
    add_parsed(*bench, "load", parse_load, options.load,
               "What to measure: frame, window, crowd, pose, city or peers", "LOAD", "")
        ->required();
    add_scene_options(*bench, words, options);
    add_drawing_options(*bench, words, options);
    add_camera_option(*bench, words);
    bench
        ->add_option("--frames", options.bench_frames,
                     "How often to measure, after a warm-up: frames of frame, peers and each part of window, "
                     "ticks of crowd, "
                     "repetitions of pose "
                     "and city")
        ->type_name("N")
        ->transform(whole_between(1, 1'000'000))
        ->capture_default_str();
    add_parsed(
        *bench, "--move", parse_move, options.move,
        "How the camera of frame moves: follow (a walker), walk (down the street) or orbit (about the city); "
        "without it, it stands",
        "HOW", "");
    bench->add_option("--count", options.bench_count, "How many characters peers draws")
        ->type_name("N")
        ->transform(whole_between(1, 10'000))
        ->capture_default_str();
    bench->add_option("--out", options.out, "Where peers writes its two pictures")->type_name("FOLDER");
    bench->add_option("--json", options.json, "Write the figures to a file too")->type_name("FILE");
}

Result<Sex> parse_sex(const std::string& text) {
    if (text == "woman") return Sex::woman;
    if (text == "man") return Sex::man;
    return Error{excerpt(text) + " is neither woman nor man"};
}

Result<Bag> parse_bag(const std::string& text) {
    if (text == "backpack") return Bag::backpack;
    if (text == "shoulder_bag") return Bag::shoulder_bag;
    if (text == "handbag") return Bag::handbag;
    return Error{excerpt(text) + " is neither backpack, shoulder_bag nor handbag"};
}

Result<std::string> parse_stairs(const std::string& text) {
    if (text == "up" || text == "down") return text;
    return Error{excerpt(text) + " is neither up nor down"};
}

void add_gait(CLI::App& app, SceneWords& words, Options& options) {
    GaitOptions& gait = options.gait;
    CLI::App* command =
        app.add_subcommand("gait", "Walk one person and measure the walk")->footer(k_gait_footer);
    command->callback([&] { options.command = Command::gait; });
    auto number = [&](const char* group, const char* name, double& to, double low, double high,
                      const char* unit, const std::string& what, const char* shown = "") {
        return command->add_option(name, to, what + " (" + plainly(low) + " to " + plainly(high) + ")")
            ->type_name(unit)
            ->check(number_between(low, high))
            ->default_str(shown)
            ->group(group);
    };
    constexpr const char *k_who = "Who", *k_where = "Where";
    number(k_who, "--speed", gait.speed, 0.3, 5, "M/S", "How fast; without it, as fast as such people like");
    number(k_who, "--height", gait.height, 0.8, 2.3, "M", "How tall; without it, as tall as such people are");
    add_parsed(*command, "--sex", parse_sex, gait.sex, "woman or man", "SEX", "man")->group(k_who);
    number(k_who, "--age", gait.age, 4, 100, "YEARS", "How old", "30");
    add_parsed(*command, "--style", parse_seed, gait.style, "Seed of a manner of walking; 0: the middle one",
               "S", "0")
        ->group(k_who);
    command
        ->add_flag("--everyone", gait.everyone,
                   "Women and men from 4 to 80 years instead, with ten styles each, in every way of walking")
        ->group(k_who);
    command->add_flag("--cane", gait.cane, "Who walks with a cane")->group(k_who);
    command->add_flag("--pram", gait.pram, "Who pushes a pram")->group(k_who);
    add_parsed(*command, "--bag", parse_bag, gait.bag, "Who carries a backpack, shoulder_bag or handbag",
               "BAG", "")
        ->group(k_who);
    command
        ->add_option(
            "--posture", gait.posture,
            "What hands do as soon as they may: pocket, pockets, hip, hips, clasp, behind, fold, across "
            "or strap")
        ->type_name("WORD")
        ->group(k_who);
    number(k_where, "--stand", gait.stand, 10, 600, "T",
           "Stands for so long instead of walking, and does with its hands what people do");
    number(k_where, "--seconds", gait.seconds, 12, k_longest_walk, "T",
           "On level ground, from standing to standing, or of what is exported, or of a crowd", "25");
    number(k_where, "--turn", gait.turn, -180, 180, "DEG",
           "Turn on the way, to the left, or, with --stand, on the spot after five seconds");
    number(k_where, "--aside", gait.aside, -1, 1, "M",
           "With --stand, steps so far to the left after five seconds, in a strip or an export");
    number(k_where, "--change", gait.change, 0.3, 5, "M/S",
           "So fast from the fifth to the tenth second, in a strip or an export");
    add_parsed(*command, "--stairs", parse_stairs, gait.stairs, "A flight up or down", "up|down", "")
        ->group(k_where);
    number(k_where, "--riser", gait.riser, 0.05, 0.25, "M", "Height of a stair", "0.17");
    number(k_where, "--tread", gait.tread, 0.2, 0.6, "M", "Depth of a stair", "0.29");
    number(k_where, "--slope", gait.slope, -25, 25, "PERCENT", "Up, or down, so many metres in a hundred");
    number(k_where, "--kerb", gait.kerb, 0.02, 0.25, "M", "Up a kerb so high and down again");
    number(k_where, "--leap", gait.leap, 0.2, 2, "M", "Leap over a puddle so wide, on level ground");
    CLI::Option* wall =
        number(k_where, "--wall", gait.wall, 0.2, 2, "M", "A wall so far to the left, in a strip");
    command
        ->add_option("--crowd", gait.crowd,
                     "Watch so many people in a city instead, for --seconds: in the built-in one, or in that "
                     "of a scene")
        ->type_name("N")
        ->transform(whole_between(1, k_max_walkers))
        ->group(k_where);
    add_place_options(*command, words);
    command->add_option("--csv", gait.csv, "Write every quantity and curve")->type_name("FILE");
    command->add_option("--json", options.json, "The same")->type_name("FILE");
    command->add_option("--svg", gait.svg, "Draw the curves over those of people")->type_name("FILE");
    CLI::Option* strip =
        command
            ->add_option("--strip", gait.strip,
                         "Draw twelve moments of it side by side, a .png, or all between, a film, an .mp4")
            ->type_name("FILE");
    add_parsed(*command, "--view", parse_view, gait.view, "What a strip shows it from: side or front", "VIEW",
               "side")
        ->needs(strip);
    add_parsed(*command, "--moments", parse_moments, gait.moments,
               "From which to which second of the walk a strip is; without it, of one stride or the turn",
               "FROM:TO", "")
        ->needs(strip);
    command
        ->add_flag("--abreast", gait.abreast,
                   "Twelve different people in a strip, at one moment; others by --style")
        ->needs(strip);
    wall->needs(strip);
    CLI::Option* motion =
        command
            ->add_option("--export", gait.motion, "Write the motion, for Blender and others, a .bvh or .glb")
            ->type_name("FILE");
    command->add_option("--walker", gait.walker, "Whose of a --crowd that is, from 0 on")
        ->type_name("ID")
        ->transform(whole_between(0, k_max_walkers))
        ->capture_default_str()
        ->needs(motion);
    command->add_flag("--check", gait.check,
                      "Fail if a bar is not met; without a place, try every walk that has bars");
}

void add_people(CLI::App& app, SceneWords& words, Options& options) {
    PeopleOptions& people = options.people;
    CLI::App* command =
        app.add_subcommand("people", "Make people: as files, as pictures")->footer(k_people_footer);
    command->callback([&] { options.command = Command::people; });
    command->add_option("--count", people.count, "How many of the built-in people")
        ->type_name("N")
        ->transform(whole_between(1, 1000))
        ->capture_default_str();
    add_parsed(*command, "--seed", parse_seed, words.seed, "Another seed makes other people", "S", "1");
    add_characters(*command, words,
                   "A skinned humanoid to show instead, or builtin to show both; may be given several times",
                   "FILE");
    add_force(*command, options);
    command->add_option("--out", people.folder, "Write them as person_01.glb and so on")->type_name("FOLDER");
    CLI::Option* sheet = command->add_option("--sheet", people.sheet, "Draw them, a .png")->type_name("FILE");
    command->add_flag("--close", people.close, "Draw their faces")->needs(sheet);
    command->add_option("--turn", people.turn, "Turn them to their left, so that 180 shows their backs")
        ->type_name("DEGREES")
        ->needs(sheet)
        ->check(number_between(-360.0, 360.0))
        ->capture_default_str();
    add_parsed(*command, "--size", parse_size, people.cell, "Pixels of each one's cell of the sheet", "WxH",
               "480x400")
        ->needs(sheet);
    command->add_option("--device", options.device, "Part of the name of a Vulkan device, or its number")
        ->needs(sheet)
        ->type_name("NAME");
    command
        ->add_flag("--validate", options.validate, "Fail if the Khronos validation layer has anything to say")
        ->needs(sheet);
    command->add_option("--threads", options.threads, "Threads that make people; 0: one a core")
        ->type_name("N")
        ->transform(whole_between(0, 256))
        ->capture_default_str();
}

void add_inspect(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* command =
        app.add_subcommand("inspect", "Say what is found in a character or a map")->footer(k_inspect_footer);
    command->callback([&] { options.command = Command::inspect; });
    command->add_option("file", options.file, "A character (.glb, .gltf, .vrm) or a map (.osm, .osm.pbf)")
        ->type_name("FILE")
        ->required();
    command->add_option("--terrain", words.terrain, "Heights of the ground under a map, as render takes them")
        ->type_name("FILE");
    add_map_options(*command, words);
    add_force(*command, options);
    command->add_option("--json", options.json, "Write it to a file too")->type_name("FILE");
}

void add_city(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* city = app.add_subcommand("city", "Write a city to a file, or check it")->footer(k_city_footer);
    city->callback([&] { options.command = Command::city; });
    add_place_options(*city, words);
    CLI::Option_group* what = city->add_option_group("What to do");
    what->add_option("--out", options.out, "Write what is drawn, a .glb; - is standard output")
        ->type_name("FILE");
    CLI::Option* check =
        what->add_flag("--check", options.check,
                       "Fail if what is drawn, walked on and found ways through differ, or people get stuck");
    what->require_option(1);
    add_walking_options(*city, words, options);
    // A city that is written has nobody in it.
    for (const char* name : {"--walkers", "--time", "--weather", "--threads"})
        city->get_option(name)->needs(check);
    city->add_option(
            "--seconds", options.seconds,
            "How long they walk in a check, in simulated time: more than a minute shows who gets stuck")
        ->needs(check)
        ->type_name("T")
        ->check(number_between(1.0, 1e6))
        ->capture_default_str();
    city->add_option("--json", options.json, "Write what a check finds to a file too")
        ->needs(check)
        ->type_name("FILE");
}

void add_scenes(CLI::App& app, Options& options) {
    CLI::App* scenes = app.add_subcommand("scenes", "List the built-in scenes, or check scene files")
                           ->footer(k_scenes_footer);
    scenes->callback([&] { options.command = Command::scenes; });
    CLI::Option* check =
        scenes
            ->add_option("--check", options.scene_files,
                         "Say what is wrong in scene files, by line and column; fail if anything is")
            ->type_name("FILE...")
            ->take_all();
    scenes->add_flag("--schema", options.schema, "Print the JSON schema of scene files, for editors")
        ->excludes(check);
}

void add_cache(CLI::App& app, Options& options) {
    // What commands keep: they have --no-cache.
    for (CLI::App* command : app.get_subcommands({})) {
        command->add_flag_callback(
            "--no-cache", [] { setenv("FLANEUR_CACHE_MAX", "0", 1); },
            "Neither read nor keep what is kept between runs; see flaneur cache --help");
    }
    CLI::App* cache =
        app.add_subcommand("cache", "Say what is kept between runs, or remove it")->footer(k_cache_footer);
    cache->callback([&] { options.command = Command::cache; });
    cache->add_flag("--clear", options.clear_cache, "Remove it");
}

// Several files do not go to one stream.
Result<void> check_folders(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        if (option->get_type_name().starts_with("FOLDER") &&
            option->results() == std::vector<std::string>{"-"})
            return Error{option->get_name() +
                         " - is no folder: several files do not go to standard output. Give the name of a "
                         "folder, ./- if that is what it is called."};
    return {};
}

}  // namespace

static Result<std::variant<std::monostate, Options>> parse_words(int argc, char** argv) {
    using Parsed = std::variant<std::monostate, Options>;
    Options options;
    SceneWords words;
    CLI::App app("flaneur fills a city with people and lets you watch, check and profile them.", "flaneur");
    app.footer(k_footer);
    app.set_version_flag("--version", "flaneur " FLANEUR_VERSION);
    app.require_subcommand(1);
    app.option_defaults()->take_last();
    app.get_formatter()->column_width(32);
    add_view(app, words, options);
    add_render(app, words, options);
    add_sim(app, words, options);
    add_bench(app, words, options);
    add_gait(app, words, options);
    add_people(app, words, options);
    add_inspect(app, words, options);
    add_city(app, words, options);
    add_scenes(app, options);
    add_cache(app, options);

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        app.exit(asked, std::cout, std::cerr);
        return Parsed();
    } catch (const CLI::ParseError& error) {
        return refusal(app, error, argc, argv);
    }
    const CLI::App& command = *app.get_subcommands().front();
    for (int i = 2; i < argc; ++i) options.words.emplace_back(argv[i]);
    if (options.starts && command.count("--scene") + command.count("--city") == 0) {
        words.scene = "corner";  // quick to load, behind what one chooses from
        options.words.insert(options.words.end(), {"--scene", words.scene});
    }
    if (Result<void> filled = check_values(command); !filled) return filled.error();
    if (Result<void> named = check_folders(command); !named) return named.error();
    Result<void> settled = settle_scene(words, options);
    if (!settled) return settled.error();
    if (Result<void> used = check_used(command, options); !used) return used.error();
    if (Result<void> measured = settle_measures(options); !measured) return measured.error();
    return Parsed(std::move(options));
}

Result<std::variant<std::monostate, Options>> parse_options(int argc, char** argv) {
    if (argc < 2 || std::string_view(argv[1]) != "render") return parse_words(argc, argv);
    const std::vector<std::string> said(argv + 2, argv + argc);
    Result<std::vector<std::string>> words = words_like(said);
    if (!words) return words.error();
    std::vector<char*> all = {argv[0], argv[1]};
    for (std::string& word : *words) all.push_back(word.data());
    all.push_back(nullptr);
    auto parsed = parse_words(static_cast<int>(all.size()) - 1, all.data());
    Options* const options = parsed ? std::get_if<Options>(&*parsed) : nullptr;
    if (options) options->inputs.push_back(options->like = picture_of_like(said));
    return parsed;
}

}  // namespace flaneur
