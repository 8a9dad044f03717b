#include <algorithm>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/recording/head.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_replay_footer =
    R"(Shows what --record of sim, render, view or bench tick has written: in a window where there is a display, else as a film in
out/; --out writes it as render does. Motion is shown without simulating, by any version; inputs are simulated again, which
only the version that recorded them does. The camera, the quality and the views may be others than those of the run.
Examples:
  flaneur sim --scene life --seconds 60 --record out/life.flr        a minute, without drawing
  flaneur replay out/life.flr                                        watch it
  flaneur replay out/life.flr --seconds 20:30 --out out/life.mp4     ten seconds of it as a film
  flaneur replay out/life.flr --frames 1234 --out out/life.png       one moment
  flaneur replay out/life.flr --camera street --quality high --out out/street.mp4
  flaneur replay out/life.flr --check                                whether all of it can be read, and is as it was
docs/recording.md tells of recordings.)";

constexpr const char* k_diff_footer =
    R"(Names the first tick, walker and joint, or thing, in which two recordings differ by more than --within, by how much, and how
many do then; ends with 0 where none does, and with 1 where one does or nothing could be compared. Of inputs that this
version wrote both are simulated again.
Examples:
  flaneur diff before.flr after.flr
  flaneur diff before.flr after.flr --within 5      millimetres, and half as many degrees)";

Result<RecordedAs> parse_recorded_as(const std::string& text) {
    if (text == "motion") return RecordedAs::motion;
    if (text == "inputs") return RecordedAs::inputs;
    return Error{excerpt(text) + " is neither motion nor inputs"};
}

Result<float> parse_millimetres(const std::string& text) {
    constexpr float k_least = 0.1f, k_most = 50;
    float mm = 0;
    if (!parse_number(text, mm) || !(mm == 0 || (mm >= k_least && mm <= k_most)))
        return Error{excerpt(text) + " is neither 0 nor 0.1 to 50 millimetres"};
    return mm / 1000;
}

// "20:30", seconds.
Result<TickRange> parse_seconds(const std::string& text) {
    const size_t colon = text.find(':');
    double first = 0, last = 0;
    const bool is_range = colon != std::string::npos && parse_number(text.substr(0, colon), first) &&
                          parse_number(text.substr(colon + 1), last);
    if (!is_range || first < 0 || last < first || last > k_last_tick / 60.0)
        return Error{excerpt(text) + " is no stretch of time, such as 20:30, in seconds"};
    return TickRange{static_cast<uint32_t>(first * 60 + 0.5), static_cast<uint32_t>(last * 60 + 0.5), 2};
}

constexpr const char* k_export_footer =
    R"(SOURCE is a recording (--record of sim, render, view or bench tick), or trajectories of any program, as docs/trajectories.md
says which: motion of those is that of bodies that go the same ways. With --scene or --city a run is simulated instead, and
OUT is all that is named.
The ending of OUT says what is written:
  .glb                 how people move, with the meshes that they wear: glTF 2.0, for Blender, engines and viewers
  .bvh                 how one person moves; of several a folder of that name without its ending, with a file each
  .sqlite              where they are: JuPedSim's database        .txt             text of PeTrack and jpscore
  .csv                 headed columns                             .fcd.xml, .xml   floating-car data of SUMO
  .geojson, .json      moving features of OGC, in metres          .traj            steps of Vadere
Seconds of what is written count from the beginning of --seconds. In a .glb everybody has a clip of their own, behind one
of all; who is not there yet, or any more, has a size of 0.
Examples:
  flaneur sim --scene life --seconds 60 --record out/life.flr
  flaneur export out/life.flr out/life.glb --walkers 10:20 --seconds 5:15
  flaneur export out/life.flr out/walks.bvh --walkers 3,7,9 --fps 30      out/walks/walker_3.bvh and so on
  flaneur export out/life.flr out/life.sqlite                             everybody, for PedPy
  flaneur export corridor.h5 out/corridor.glb --seconds 0:10              bodies for measured places
  flaneur export corridor.h5 out/corridor.fcd.xml --fps 10
  flaneur export --scene quayside out/quay.glb --walkers 0:9
docs/export.md tells more.)";

// Tells by what is in it whether the source is a recording.
void settle_source(const CLI::App& command, SceneWords& words, Options& options) {
    std::vector<std::string>& files = options.exported.files;
    const bool is_simulated = command.count("--scene") + command.count("--city") > 0;
    auto refuse = [](const std::string& why) {
        throw CLI::ValidationError(why, CLI::ExitCodes::ValidationError);
    };
    if (is_simulated && files.size() > 1)
        refuse("export: --scene and --city are what is exported; then OUT is all that is named besides.");
    if (!is_simulated && files.size() != 2)
        refuse("export wants what and where to: flaneur export SOURCE OUT, or export --scene NAME OUT.");
    options.out = files.back();
    if (is_simulated) return;
    for (const CLI::Option* option : command.get_options())
        if (option->get_group() == "Scene" && option->count() > 0)
            refuse(option->get_name() + " is for what is simulated, with --scene or --city; " + files[0] +
                   " is as it was.");
    (looks_recorded(files[0]) ? words.replay : options.file) = files[0];
}

}  // namespace

void add_record_options(CLI::App& app, Options& options) {
    CLI::Option* record =
        app.add_option("--record", options.record.path,
                       "Record how everybody moves, from the first tick on, for flaneur replay and diff; see "
                       "docs/recording.md")
            ->type_name("FILE");
    add_parsed(app, "--record-as", parse_recorded_as, options.record.as,
               "motion, which any version shows without simulating; or inputs, a few bytes that this version "
               "alone repeats, to the last bit",
               "KIND", "motion")
        ->needs(record);
    add_parsed(
        app, "--record-error", parse_millimetres, options.record.error,
        "How far off joints may be in motion, 0.1 to 50 millimetres, and half as many degrees; 0: to the "
        "last bit, in some thirty times the room",
        "MM", "1")
        ->needs(record);
}

void add_replay_option(CLI::App& app, SceneWords& words) {
    CLI::Option* replay =
        app.add_option("--replay", words.replay, "A recording, in place of a scene that is simulated")
            ->type_name("FILE");
    // What is recorded has its own.
    for (CLI::Option* option : app.get_options())
        if (option->get_group() == "Scene" && option->get_name() != "--threads") replay->excludes(option);
    if (CLI::Option* lod = app.get_option_no_throw("--lod")) replay->excludes(lod);
    if (CLI::Option* without = app.get_option_no_throw("--without")) replay->excludes(without);
}

// What is told apart by a file's content would be so here: a recording is all that there is.
Result<Scene> replayed_scene(const std::string& path, Options& options) {
    Result<RecordingHead> head = read_recording_head(path);
    if (!head) return head.error();
    Result<Scene> scene = parse_scene(head->scene, head->scene_name);
    if (!scene) return Error{"The scene of " + path + " cannot be made: " + scene.error().message};
    options.force = head->force;
    options.replay = path;
    return scene;
}

void add_replay(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* replay = app.add_subcommand("replay", "Show a recording")->footer(k_replay_footer);
    replay->callback([&, replay] {
        options.command = Command::replay;
        options.has_ticks = replay->count("--frames") + replay->count("--seconds") > 0;
    });
    replay->add_option("file", words.replay, "A recording")->type_name("FILE")->required();
    CLI::Option* check = replay->add_flag(
        "--check", options.checks_replay,
        "Read all of it, against its sums; and simulate inputs again, against a hash of each second");
    replay
        ->add_option("--out", options.out,
                     "FILE.png, DIR/%05d.png or FILE.mp4, as render has them; without it, a window")
        ->type_name("FILE")
        ->excludes(check);
    CLI::Option* frames =
        add_parsed(*replay, "--frames", parse_ticks, options.ticks,
                   "Which ticks, 60 to the second: N, A:B or A:B:STEP; without it, all", "TICKS", "");
    add_parsed(*replay, "--seconds", parse_seconds, options.ticks, "The same in seconds", "A:B", "")
        ->excludes(frames);
    replay->add_option("--threads", options.threads, "Threads that read it; 0: one a core")
        ->type_name("N")
        ->transform(whole_between(0, 256))
        ->capture_default_str();
    add_drawing_options(*replay, words, options);
    add_camera_option(*replay, words);
    add_work_views(*replay, words);
}

void add_diff(CLI::App& app, Options& options) {
    CLI::App* diff = app.add_subcommand("diff", "Find where two recordings differ")->footer(k_diff_footer);
    diff->callback([&] { options.command = Command::diff; });
    diff->add_option("files", options.compared, "Two recordings")
        ->type_name("FILE")
        ->expected(-1)
        ->take_all()
        ->required();
    add_parsed(*diff, "--within", parse_millimetres, options.within,
               "What does not count: 0.1 to 50 millimetres, and half as many degrees; 0: nothing", "MM", "0");
    diff->add_option("--threads", options.threads, "Threads that read them; 0: one a core")
        ->type_name("N")
        ->transform(whole_between(0, 256))
        ->capture_default_str();
}

void add_export(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* command = app.add_subcommand("export", "Write how and where people went, for other programs")
                            ->footer(k_export_footer);
    command->add_option("files", options.exported.files, "SOURCE and OUT; with --scene or --city OUT alone")
        ->type_name("FILE")
        ->expected(-1)
        ->take_all()
        ->required();
    command->callback([&, command] {
        options.command = Command::exports;
        settle_source(*command, words, options);
    });
    add_parsed(
        *command, "--walkers", parse_who, options.exported.walkers,
        "Who, by number: 12, 10:20 or 3,7,10:20, as --camera follow:12 counts; of trajectories, as they "
        "are called there",
        "WHO", "all");
    add_parsed(*command, "--seconds", parse_part, options.exported.seconds,
               "Which part of the time; of a scene, without it, the first ten seconds", "FROM:TO", "all");
    command
        ->add_option("--fps", options.exported.fps,
                     "Frames a second, 1 to 60; without it, 60 of motion, and of places 25 or as many as "
                     "SOURCE has")
        ->type_name("N")
        ->transform(whole_between(1, 60));
    add_place_options(*command, words);
    add_characters(*command, words, "Who walks in a scene, as render has it; may be given several times",
                   "FILE[:SHARE]")
        ->group("Scene");
    add_force(*command, options)->group("Scene");
    command->add_option("--threads", options.threads, "Threads that simulate or read; 0: one a core")
        ->type_name("N")
        ->transform(whole_between(0, 256))
        ->capture_default_str();
}

}  // namespace flaneur
