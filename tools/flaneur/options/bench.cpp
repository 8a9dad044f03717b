#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_bench_footer =
    R"(Loads: frame (simulation and drawing, off-screen), window (the whole viewer, at rest and looking about, with panels and
without; takes a display), crowd (the simulation, everybody in full), tick (the
same with those afar of an eye among the people in less detail, as a viewer has it, or of that of --camera EX,EY,EZ/TX,TY,TZ), pose (the kernels that pose bodies, on one thread), city (how long it
takes to read, and its queries on one thread), peers (a scene that other renderers were measured by: copies of one character
that play its own clip, drawn with levels of detail and with every triangle), sweep (the stages of a tick and a picture over
the number of walkers: how each grows, and where it stops being real time), scale (the stages of a tick over the number of
threads: speed-up, and what stays on one thread), ablate (what a picture costs and how it looks without shadows, smoothed
edges, levels of detail and so on, one at a time, and bodies without each technique), gauntlet (a fixed score of some minutes
that every machine can play, for a page beside other machines'), ik (ways of inverse kinematics beside each other: iterations
and time of each, on one thread); compare measures nothing: it says which stages of the second
file are slower than those of the first, and fails if any is. frame, window, crowd, tick and peers print the median and percentiles of each stage in milliseconds; pose prints nanoseconds a walker on each instruction
set that the CPU has, city nanoseconds a query, beside the goals.
Examples:
  flaneur bench frame --walkers 500 --size 1280x720
  flaneur bench window --walkers 500
  flaneur bench crowd --walkers 100000 --threads 8 --json out/crowd.json
  flaneur bench tick --walkers 100000 --threads 2
  flaneur bench pose --walkers 1000
  flaneur bench city --city monaco.osm.pbf
  flaneur bench sweep --walkers 100:1000000 --svg out/sweep.svg
  flaneur bench ablate --walkers 500 --svg out/ablate.svg
  flaneur bench gauntlet --json out/here.json --html out/gauntlet.html --others out/others
  flaneur bench scale --walkers 20000 --svg out/scale.svg
  flaneur bench ik --json out/ik.json
  flaneur bench peers --count 500 --character CesiumMan.glb --out out/peers
  flaneur bench frame --trace out/frame.json                    zone by zone, for ui.perfetto.dev
  flaneur bench compare before.json after.json --tolerance 3    files that --json wrote)";

Result<BenchLoad> parse_load(const std::string& text) {
    if (text == "frame") return BenchLoad::frame;
    if (text == "window") return BenchLoad::window;
    if (text == "crowd") return BenchLoad::crowd;
    if (text == "tick") return BenchLoad::tick;
    if (text == "pose") return BenchLoad::pose;
    if (text == "city") return BenchLoad::city;
    if (text == "peers") return BenchLoad::peers;
    if (text == "sweep") return BenchLoad::sweep;
    if (text == "scale") return BenchLoad::scale;
    if (text == "ablate") return BenchLoad::ablate;
    if (text == "gauntlet") return BenchLoad::gauntlet;
    if (text == "ik") return BenchLoad::ik;
    if (text == "compare") return BenchLoad::compare;
    return Error{
        excerpt(text) +
        " is none of frame, window, crowd, tick, pose, ik, city, peers, sweep, scale, ablate and gauntlet, "
        "which bench measures, and compare"};
}

Result<BenchMove> parse_move(const std::string& text) {
    if (text == "follow") return BenchMove::follow;
    if (text == "walk") return BenchMove::walk;
    if (text == "orbit") return BenchMove::orbit;
    return Error{excerpt(text) + " is none of follow, walk and orbit, the ways a camera moves"};
}

// One number as other commands have it, or a range for sweep.
void add_walkers(CLI::App& bench, SceneWords& words, Options& options) {
    bench.remove_option(bench.get_option("--walkers"));
    auto take = [&](const std::string& text) {
        Result<WalkerRange> range = parse_walkers(text);
        if (!range)
            throw CLI::ValidationError("--walkers " + range.error().message, CLI::ExitCodes::ValidationError);
        options.study.walkers = *range;
        if (is_single(*range)) words.walkers = static_cast<int>(range->first);
    };
    bench
        .add_option_function<std::string>("--walkers", take,
                                          "How many people, 0 to 1000000; of sweep from and to how many; "
                                          "without it, 100:100000")
        ->type_name("N|FIRST:LAST")
        ->group("Scene");
}

}  // namespace

void add_bench(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* bench = app.add_subcommand("bench", "Measure")->footer(k_bench_footer);
    bench->callback([&] { options.command = Command::bench; });
    add_parsed(*bench, "load", parse_load, options.load,
               "What to measure: frame, window, crowd, tick, pose, ik, city, peers, sweep, scale, ablate or "
               "gauntlet; or compare",
               "LOAD", "")
        ->required();
    bench->add_option("files", options.compared, "Of compare: figures that --json wrote, before and after")
        ->type_name("FILE")
        ->expected(-1)
        ->take_all();
    add_scene_options(*bench, words, options);
    add_walkers(*bench, words, options);
    add_drawing_options(*bench, words, options);
    add_camera_option(*bench, words);
    add_lod(*bench, options);
    bench
        ->add_option("--frames", options.bench_frames,
                     "How often to measure, after a warm-up: frames of frame, peers and each part of window, "
                     "ticks of crowd and tick, "
                     "repetitions of pose "
                     "and city")
        ->type_name("N")
        ->transform(whole_between(1, 1'000'000))
        ->capture_default_str();
    bench
        ->add_option(
            "--warm-up", options.warm_up,
            "Ticks of the simulation before the first that frame, crowd, tick, pose and city measure")
        ->type_name("TICKS")
        ->transform(whole_between(0, 1'000'000))
        ->capture_default_str();
    add_parsed(
        *bench, "--move", parse_move, options.move,
        "How the camera of frame moves: follow (a walker), walk (down the street) or orbit (about the city); "
        "without it, it stands",
        "HOW", "");
    bench
        ->add_option("--tolerance", options.tolerance,
                     "Of compare: percent that a stage must have become slower by to count")
        ->type_name("PERCENT")
        ->check(number_between(0.0, 1000.0))
        ->capture_default_str();
    bench->add_option("--count", options.bench_count, "How many characters peers draws")
        ->type_name("N")
        ->transform(whole_between(1, 10'000))
        ->capture_default_str();
    bench
        ->add_option("--steps", options.study.steps,
                     "At how many points sweep measures, in equal ratios; without it, at 1, 2, 5, 10 ..")
        ->type_name("N")
        ->transform(whole_between(2, 100));
    bench->add_option("--svg", options.study.svg, "Where sweep, scale and ablate draw their chart")
        ->type_name("FILE");
    bench->add_flag("--quick", options.study.quick, "A gauntlet of a minute, with fewer people");
    bench->add_option("--html", options.study.html, "Where gauntlet writes a page with charts")
        ->type_name("FILE");
    bench
        ->add_option("--others", options.study.others,
                     "A folder with what gauntlet --json wrote on other machines: they are on the page too")
        ->type_name("FOLDER");
    bench
        ->add_option("--markdown", options.study.markdown,
                     "Where gauntlet writes the project's goals beside what it measured")
        ->type_name("FILE");
    bench->add_option("--out", options.out, "Where peers writes its two pictures")->type_name("FOLDER");
    add_isa_option(*bench, options);
    add_trace_option(*bench, options);
    add_record_options(*bench, options);
    bench->add_option("--json", options.json, "Write the figures to a file too")->type_name("FILE");
}

}  // namespace flaneur
