#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

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
  flaneur render --frames 0:60 --out out/%05d.png --capture 30            and out/00030.rdc, for RenderDoc
  flaneur render --frames 600:1200:60 --ids out/%05d-ids.png --out out/%05d.png
  flaneur render --frames 0:600:2 --out out/city.mp4 --shard 1/8          an eighth of a film, for flaneur join
A camera path is JSON: { "keys": [ { "time": 0, "eye": [0, 1.7, -20], "target": [0, 1.5, 0], "fov": 32 }, ... ] } in
seconds, metres and degrees; the window's Cameras room records one, plays it and writes it.)";

constexpr const char* k_join_footer =
    R"(The film is the one that a single process would have written, byte for byte, where the same ffmpeg encodes it with as
many threads. tools/farm draws all parts of a film on several machines, and joins them.
Examples:
  flaneur render --replay life.flr --frames 0:1200:2 --out life.mp4 --shard 1/2
  flaneur render --replay life.flr --frames 0:1200:2 --out life.mp4 --shard 2/2
  flaneur join life.mp4)";

Result<bool> parse_light(const std::string& text) {
    if (text == "host" || text == "device") return text == "host";
    return Error{excerpt(text) + " is neither device nor host"};
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

}  // namespace

void add_work_views(CLI::App& app, SceneWords& words) {
    add_parsed(
        app, "--view", parse_view_list, words.views,
        "Views for work, such as skeletons,trails: wireframe, normals or overdraw; lods or speed; density "
        "or walkable; trails; skeletons; gizmos; ways",
        "VIEW,...", "");
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

static Result<float> parse_lod(const std::string& text) {
    constexpr float k_least = 20, k_most = 10000;
    float metres = 0;
    if (text == "off") return 0.0f;
    if (!parse_number(text, metres) || !(metres >= k_least && metres <= k_most))
        return Error{excerpt(text) + " is neither off nor 20 to 10000 metres"};
    return metres;
}

CLI::Option* add_threads_option(CLI::App& app, Options& options, const char* what) {
    return app.add_option("--threads", options.threads, what)
        ->type_name("N")
        ->transform(whole_between(0, 256))
        ->capture_default_str();
}

void add_lod(CLI::App& app, Options& options) {
    add_parsed(app, "--lod", parse_lod, options.lod,
               "People farther than this from the camera walk eight ticks at once, and twice as far sixteen, "
               "which takes an eighth and a sixteenth of the time; off, as without it: everybody in full",
               "METRES|off", "");
}

void add_without(CLI::App& app, SceneWords& words) {
    std::string names;
    for (const TechniqueInfo& technique : k_techniques)
        names.append(names.empty() ? "" : ", ").append(technique.name);
    add_parsed(app, "--without", parse_without, words.techniques,
               ("Draw bodies without some of what makes them, such as feet,walls: " + names +
                "; or none; see docs/gait.md. They walk as ever")
                   .c_str(),
               "NAME,...", "");
}

CLI::Option* add_shard_option(CLI::App& app, Options& options) {
    return add_parsed(
        app, "--shard", parse_shard, options.shard,
        "Draw one of so many parts of a film, or of numbered pictures: the first of eight is 1/8. A "
        "film's go into FILE.mp4.parts, and flaneur join makes the film of them; what is drawn "
        "already is left. See docs/farm.md",
        "I/N", "");
}

void add_join(CLI::App& app, Options& options) {
    CLI::App* join = app.add_subcommand("join", "Make a film of its parts")->footer(k_join_footer);
    join->callback([&] { options.command = Command::join; });
    join->add_option("film", options.out, "The film, .mp4, as --out of its parts had it")
        ->type_name("FILE")
        ->required();
}

void add_view(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* view = app.add_subcommand("view", "Watch the city in a window")->footer(k_view_footer);
    view->callback([&] { options.command = Command::view; });
    add_scene_options(*view, words, options);
    add_drawing_options(*view, words, options);
    add_camera_option(*view, words);
    add_work_views(*view, words);
    add_without(*view, words);
    add_lod(*view, options);
    add_trace_option(*view, options);
    add_record_options(*view, options);
    add_replay_option(*view, words);
    view->add_flag("--capture", options.captures,
                   "Load RenderDoc, so that Ctrl+F12 captures a picture, with all that draws it, into out/");
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
        options.captures = render->count("--capture") > 0;
    });
    add_scene_options(*render, words, options);
    add_drawing_options(*render, words, options);
    add_camera_option(*render, words);
    add_work_views(*render, words);
    add_without(*render, words);
    add_lod(*render, options);
    add_trace_option(*render, options);
    add_record_options(*render, options);
    add_replay_option(*render, words);
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
    CLI::Option* resume = render->add_flag(
        "--resume", options.resume, "Go on with a film, or numbered pictures, that the same command began");
    add_shard_option(*render, options)->excludes(render->get_option("--record"));
    render
        ->add_option("--capture", options.captured,
                     "Have RenderDoc capture the picture of this tick, with all that draws it, into an .rdc "
                     "beside it; takes librenderdoc")
        ->type_name("TICK")
        ->transform(whole_between(0, k_last_tick))
        ->excludes(resume);
}

}  // namespace flaneur
