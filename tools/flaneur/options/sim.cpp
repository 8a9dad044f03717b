#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_sim_footer =
    R"(Runs without Vulkan. The hash covers the whole state; the same city, people, walkers and seed give the same
one for any number of threads, on any x86-64 machine.
--line and --zone count people, as the room Measure of `flaneur view` does, which also draws both and copies them as these
options. Metres, x to the east and z to the south; flaneur inspect MAP says where on Earth that is. What was counted is
printed; --measures FILE.csv writes FILE-L1.csv of the first line, a row for each crossing (when, who, to which side of one
who looks from the line's first end to its last, how fast, where), and FILE-Z1.csv of the first zone, a row for each second
(people, density, density by Voronoi cells, mean speed). docs/viewer.md tells how it is counted.
--trajectories FILE writes everybody's ways for programs that judge crowds, --fps times a second: x to the east, y to the
north, z up, metres. FILE.sqlite is what JuPedSim writes, with the ground that is walked on; FILE.txt what PeTrack writes;
FILE.csv has headed columns, FILE.xml is floating-car data of SUMO, FILE.json or FILE.geojson moving features of OGC in
metres, FILE.traj steps of Vadere. docs/trajectories.md tells of them.
Examples:
  flaneur sim --walkers 500 --seconds 60 --hash
  flaneur sim --seconds 10 --hash-log out/a.txt --threads 1     compare two runs with diff
  flaneur sim --seconds 10 --state-log out/a.log                for flaneur check --sim --against, on another machine
  flaneur sim --seconds 300 --line -4,12/4,12 --measures out/flow.csv
  flaneur sim --seconds 300 --line door:2,8/5,8 --zone 0,0/8,0/8,6/0,6 --measures out/square.csv
  flaneur sim --seconds 300 --measures-of measures.json --measures out/flow.csv
  flaneur sim --seconds 60 --record out/a.flr                   and flaneur replay out/a.flr shows it
  flaneur sim --seconds 120 --trajectories out/square.sqlite --fps 25)";

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

}  // namespace

void add_trace_option(CLI::App& app, Options& options) {
    app.add_option("--trace", options.trace,
                   "Write where time goes, zone by zone, on each thread and on the device: a .json for "
                   "ui.perfetto.dev or chrome://tracing; see docs/profiling.md")
        ->type_name("FILE");
}

void add_isa_option(CLI::App& app, Options& options) {
    app.add_option("--isa", options.isa, "Instruction set to run on: sse4, avx2, avx512, neon or best")
        ->type_name("NAME")
        ->capture_default_str();
}

void add_sim(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* sim = app.add_subcommand("sim", "Simulate without drawing")->footer(k_sim_footer);
    sim->callback([&] { options.command = Command::sim; });
    add_scene_options(*sim, words, options);
    sim->add_option("--seconds", options.seconds, "How long, in simulated time")
        ->type_name("T")
        ->check(number_between(0.0, 1e6))
        ->capture_default_str();
    add_trace_option(*sim, options);
    add_record_options(*sim, options);
    sim->add_flag("--hash", options.hash, "Print the hash of the last state");
    sim->add_option("--hash-log", options.hash_log, "Write a line with tick and hash for each tick")
        ->type_name("FILE");
    sim->add_option(
           "--state-log", options.state_log,
           "Write what `flaneur check --sim --against FILE` compares with: some bytes of each walker and "
           "field for each tick, and all values of the last")
        ->type_name("FILE");
    add_isa_option(*sim, options);
    add_measures(*sim, options.plan);
    sim->add_option("--measures", options.measures,
                    "Write what lines and zones counted: FILE-L1.csv, FILE-Z1.csv and so on")
        ->type_name("FILE.csv");
    CLI::Option* trajectories =
        sim->add_option("--trajectories", options.trajectories,
                        "Write where everybody is, for other programs: .csv, .sqlite (JuPedSim), .txt "
                        "(PeTrack, which PedPy reads), .xml (SUMO), .json (moving features) or .traj "
                        "(Vadere); see docs/trajectories.md")
            ->type_name("FILE");
    sim->add_option("--fps", options.fps, "Of --trajectories: frames a second")
        ->type_name("N")
        ->check(whole_between(1, 60))
        ->needs(trajectories)
        ->capture_default_str();
}

Result<void> settle_measures(Options& options) {
    if (!options.measures.empty() && is_empty(options.plan))
        return Error{
            "--measures writes what lines and zones count: give some with --line, --zone or --measures-of."};
    if (!is_empty(options.plan) && is_small_world(options.scene))
        return Error{"--line and --zone are of the ground plane of a city, and here people walk all round."};
    if (!options.trajectories.empty() && is_small_world(options.scene))
        return Error{"--trajectories are of a ground plane, and here people walk all round."};
    if (Result<void> named = name_all(options.plan); !named)
        return Error{named.error().message + ": give one of them another name, as in --line NAME:X,Z/X,Z."};
    return {};
}

}  // namespace flaneur
