#include <algorithm>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/recording/head.h"
#include "assets/scene.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_replay_footer =
    R"(Shows what --record of sim, render, view or bench tick has written, or people with bodies who go where a file of
trajectories has them (PeTrack, JuPedSim, SUMO, Vadere and more: by what is in it): in a window where there is a
display, else as a film in out/; --out writes it as render does. Motion is shown without simulating, by any version; inputs are simulated again, which
only the version that recorded them does. The camera, the quality and the views may be others than those of the run.
Examples:
  flaneur sim --scene life --seconds 60 --record out/life.flr        a minute, without drawing
  flaneur replay out/life.flr                                        watch it
  flaneur replay out/life.flr --seconds 20:30 --out out/life.mp4     ten seconds of it as a film
  flaneur replay out/life.flr --frames 1234 --out out/life.png       one moment
  flaneur replay out/life.flr --camera street --quality high --out out/street.mp4
  flaneur replay bottleneck.txt --out out/bottleneck.mp4             people where others were tracked
  flaneur replay tracks.csv --unit cm --fps 16 --camera street       what the file does not say itself
  flaneur replay out/life.flr --check                                whether all of it can be read, and is as it was
docs/recording.md tells of recordings, docs/trajectories.md of trajectories.)";

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

Result<float> parse_unit(const std::string& text) {
    static constexpr std::pair<std::string_view, float> k_units[] = {
        {"m", 1.0f}, {"dm", 0.1f}, {"cm", 0.01f}, {"mm", 0.001f}, {"ft", 0.3048f}, {"in", 0.0254f}};
    for (const auto& [name, metres] : k_units)
        if (text == name) return metres;
    double metres = 0;
    if (parse_number(text, metres) && metres >= k_least_unit && metres <= k_most_unit)
        return static_cast<float>(metres);
    return Error{excerpt(text) + " is none of m, dm, cm, mm, ft and in, nor how many metres it is"};
}

Result<char> parse_up(const std::string& text) {
    if (text == "y" || text == "z") return text[0];
    return Error{excerpt(text) + " is neither y nor z"};
}

Result<std::optional<Vec2>> parse_asked_origin(const std::string& text) {
    const Result<Vec2> origin = parse_origin(text);
    if (!origin) return origin.error();
    return std::optional<Vec2>(*origin);
}

Result<Entering> parse_entering(const std::string& text) {
    for (size_t k = 0; k < std::size(k_entering_names); ++k)
        if (text == k_entering_names[k]) return static_cast<Entering>(k);
    return Error{excerpt(text) + " is neither fade nor step"};
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
    (is_recording(files[0]) ? words.replay : options.file) = files[0];
}

}  // namespace

void add_reading_options(CLI::App& app, TrajectoryReading& reading) {
    const char* group = "Trajectories";
    add_parsed(app, "--unit", parse_unit, reading.unit,
               "What 1 is in a file of trajectories: m, dm, cm, mm, ft, in, or metres", "UNIT",
               "as it says, or by evidence")
        ->group(group);
    app.add_option("--fps", reading.fps, "Its frames a second; without it, as it says, or by evidence")
        ->type_name("N")
        ->transform(number_between(k_least_frame_rate, k_most_frame_rate))
        ->group(group);
    add_parsed(app, "--up", parse_up, reading.up, "Its axis that points upwards, y or z", "AXIS",
               "by evidence")
        ->group(group);
    add_parsed(app, "--origin", parse_asked_origin, reading.origin,
               "The place of it, in its own unit, that is to be the middle", "EAST,NORTH",
               "as it is, or the middle of what lies far off")
        ->group(group);
    app.add_option("--geometry", reading.geometry,
                   "A file of where people can be; without it, one that lies beside it and fits")
        ->type_name("FILE")
        ->group(group);
}

std::vector<std::string> told_reading(const TrajectoryReading& reading) {
    std::vector<std::string> words;
    auto tell = [&](const char* option, std::string word) {
        words.insert(words.end(), {option, std::move(word)});
    };
    if (reading.unit > 0) tell("--unit", plainly(reading.unit));
    if (reading.fps > 0) tell("--fps", plainly(reading.fps));
    if (reading.up != 0) tell("--up", std::string(1, reading.up));
    if (reading.origin) tell("--origin", plainly(reading.origin->x) + "," + plainly(reading.origin->z));
    if (!reading.geometry.empty()) tell("--geometry", reading.geometry);
    return words;
}

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
        app.add_option("--replay", words.replay,
                       "A recording, or a file of trajectories, in place of a scene that is simulated")
            ->type_name("FILE");
    // What is recorded has its own.
    for (CLI::Option* option : app.get_options())
        if (option->get_group() == "Scene" && option->get_name() != "--threads") replay->excludes(option);
    add_reading_options(app, words.reading);
    for (const char* name : {"--unit", "--fps", "--up", "--origin", "--geometry"})
        app.get_option(name)->needs(replay);
    if (CLI::Option* lod = app.get_option_no_throw("--lod")) replay->excludes(lod);
    if (CLI::Option* without = app.get_option_no_throw("--without")) replay->excludes(without);
}

// By what is in the file: what is no recording may be trajectories.
Result<Scene> replayed_scene(const SceneWords& words, Options& options) {
    const std::string& path = words.replay;
    if (Result<void> found = find_file(path); !found) return found.error();
    if (!is_recording(path) && !has_ending(path, ".flr")) {
        Scene scene = scene_of_trajectories(path);
        scene.reading = words.reading;
        scene.entering = words.entering;
        return scene;
    }
    if (!(words.reading == TrajectoryReading{}))
        return Error{"--unit, --fps, --up, --origin and --geometry are for trajectories, and " + path +
                     " is a recording, which knows them."};
    Result<RecordingHead> head = read_recording_head(path);
    if (!head) return head.error();
    Result<Scene> scene = parse_scene(head->scene, head->scene_name);
    if (!scene) return Error{"The scene of " + path + " cannot be made: " + scene.error().message};
    options.force = head->force;
    options.replay = path;
    return scene;
}

void add_replay(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* replay = app.add_subcommand("replay", "Show a recording, or trajectories with bodies")
                           ->footer(k_replay_footer);
    replay->callback([&, replay] {
        options.command = Command::replay;
        options.has_ticks = replay->count("--frames") + replay->count("--seconds") > 0;
    });
    replay->add_option("file", words.replay, "A recording, or a file of trajectories")
        ->type_name("FILE")
        ->required();
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
    add_shard_option(*replay, options)->excludes(check);
    add_threads_option(*replay, options, "Threads that read it; 0: one a core");
    add_drawing_options(*replay, words, options);
    add_camera_option(*replay, words);
    add_work_views(*replay, words);
    add_reading_options(*replay, words.reading);
    add_parsed(
        *replay, "--enter", parse_entering, words.entering,
        "How one comes and leaves in the middle of trajectories: fade, into sight where it is first; or "
        "step, before that",
        "HOW", "fade")
        ->group("Trajectories");
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
    add_threads_option(*diff, options, "Threads that read them; 0: one a core");
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
    add_characters(*command, words,
                   "Who walks in a scene, a file or builtin, as render has it; may be given several times",
                   "FILE[:SHARE]")
        ->group("Scene");
    add_force(*command, options)->group("Scene");
    add_threads_option(*command, options, "Threads that simulate or read; 0: one a core");
}

}  // namespace flaneur
