#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_bench_footer =
    R"(Loads: frame (simulation and drawing, off-screen), window (the whole viewer, at rest and looking about, with panels and
without; takes a display), crowd (the simulation), pose (the kernels that pose bodies, on one thread), city (how long it
takes to read, and its queries on one thread), peers (a scene that other renderers were measured by: copies of one character
that play its own clip, drawn with levels of detail and with every triangle); compare measures nothing: it says which stages
of the second file are slower than those of the first, and fails if any is. frame, window, crowd and peers print the median and percentiles of each stage in milliseconds; pose prints nanoseconds a walker on each instruction
set that the CPU has, city nanoseconds a query, beside the goals.
Examples:
  flaneur bench frame --walkers 500 --size 1280x720
  flaneur bench window --walkers 500
  flaneur bench crowd --walkers 100000 --threads 8 --json out/crowd.json
  flaneur bench pose --walkers 1000
  flaneur bench city --city monaco.osm.pbf
  flaneur bench peers --count 500 --character CesiumMan.glb --out out/peers
  flaneur bench frame --trace out/frame.json                    zone by zone, for ui.perfetto.dev
  flaneur bench compare before.json after.json --tolerance 3    files that --json wrote)";

Result<BenchLoad> parse_load(const std::string& text) {
    if (text == "frame") return BenchLoad::frame;
    if (text == "window") return BenchLoad::window;
    if (text == "crowd") return BenchLoad::crowd;
    if (text == "pose") return BenchLoad::pose;
    if (text == "city") return BenchLoad::city;
    if (text == "peers") return BenchLoad::peers;
    if (text == "compare") return BenchLoad::compare;
    return Error{excerpt(text) +
                 " is none of frame, window, crowd, pose, city and peers, which bench measures, and compare"};
}

Result<BenchMove> parse_move(const std::string& text) {
    if (text == "follow") return BenchMove::follow;
    if (text == "walk") return BenchMove::walk;
    if (text == "orbit") return BenchMove::orbit;
    return Error{excerpt(text) + " is none of follow, walk and orbit, the ways a camera moves"};
}

}  // namespace

void add_bench(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* bench = app.add_subcommand("bench", "Measure")->footer(k_bench_footer);
    bench->callback([&] { options.command = Command::bench; });
    add_parsed(*bench, "load", parse_load, options.load,
               "What to measure: frame, window, crowd, pose, city or peers; or compare", "LOAD", "")
        ->required();
    bench->add_option("files", options.compared, "Of compare: figures that --json wrote, before and after")
        ->type_name("FILE")
        ->expected(-1)
        ->take_all();
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
    bench
        ->add_option("--warm-up", options.warm_up,
                     "Ticks of the simulation before the first that frame, crowd, pose and city measure")
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
    bench->add_option("--out", options.out, "Where peers writes its two pictures")->type_name("FOLDER");
    add_trace_option(*bench, options);
    bench->add_option("--json", options.json, "Write the figures to a file too")->type_name("FILE");
}

}  // namespace flaneur
