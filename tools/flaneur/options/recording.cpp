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
    add_shard_option(*replay, options)->excludes(check);
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

}  // namespace flaneur
