#include "tools/flaneur/bench/gauntlet/gauntlet.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/gait/people/who.h"
#include "tools/flaneur/gait/trials.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/machine.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/plot/plot.h"

namespace flaneur {

namespace {

constexpr uint32_t k_turn = 4;  // ticks, in which everybody decides once
constexpr double k_walk_seconds = 25;
constexpr double k_busy = 0.4;  // of the cores

// What is played, and how long: the counts are those of the goals, and fewer for a quick run.
struct GauntletPlan {
    std::vector<int> crowds, pictures, copies;
    uint32_t turns, frames, repetitions;
    bool has_throng;  // the camera before the densest throng too
};
GauntletPlan plan_of(bool is_quick) {
    if (is_quick) return {{500, 1000, 2000}, {100, 500, 1000}, {100}, 5, 12, 8, false};
    return {{1000, 10'000, 100'000}, {500, 2000, 10'000}, {100, 500, 1000}, 10, 60, 60, true};
}

void add_score(GauntletRun& run, const char* part, const std::string& name, double size, double value,
               const char* unit) {
    run.scores.push_back({part, name, size, value, unit});
    std::printf("%-7s %-28s %9s %12s %s\n", part, name.c_str(), size > 0 ? short_number(size).c_str() : "",
                short_number(value).c_str(), unit);
    std::fflush(stdout);
}

// Whether others use the machine, which makes times longer: said before the first load.
void note_others(GauntletRun& run) {
    double load = 0;
    if (getloadavg(&load, 1) != 1 || load < k_busy * core_count()) return;
    run.notes.push_back("Others used the machine: before it began, " + short_number(load) +
                        " programs on average wanted its " + std::to_string(core_count()) +
                        " cores (/proc/loadavg). Times are longer than they would be; the work of all "
                        "threads is about as it is.");
}

// Without what earlier runs kept.
Result<void> play_load(const Options& options, GauntletRun& run) {
    show_progress("load");
    auto start = std::chrono::steady_clock::now();
    Result<City> city = read_city(options.scene);
    if (!city) return city.error();
    add_score(run, "load", "city", 0, ms_since(start), "ms");
    start = std::chrono::steady_clock::now();
    Result<NavmeshPtr> mesh =
        build_navmesh(city->ground, {}, core_count(), [](float) { return !is_stopping(); });
    if (!mesh) return mesh.error();
    add_score(run, "load", "navigation mesh", 0, ms_since(start), "ms");
    start = std::chrono::steady_clock::now();
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    add_score(run, "load", "all, with what is kept", 0, ms_since(start), "ms");
    return {};
}

// On all threads, and then decisions on one.
Result<void> play_crowd(Options options, int walkers, uint32_t turns, GauntletRun& run) {
    options.scene.walkers = walkers;
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    WorkersPtr one = make_workers(1);
    std::vector<double> tick, all_threads, decision;
    for (uint32_t turn = 0; turn < 2 * turns; ++turn) {
        if (turn == turns) world.workers.swap(one);
        show_progress("sim of " + short_number(walkers) + ", turn " + std::to_string(turn + 1));
        double whole = 0, deciding = 0;
        const double cpu_start = cpu_ms();
        for (uint32_t i = 0; i < k_turn; ++i) {
            if (is_stopping()) return interrupted();
            const auto start = std::chrono::steady_clock::now();
            step(world);
            whole += ms_since(start) / k_turn;
            deciding += world.stage_ms[static_cast<int>(Stage::neighbours)] +
                        world.stage_ms[static_cast<int>(Stage::steer)];
        }
        if (turn < turns && turn > 0) {
            tick.push_back(whole);
            all_threads.push_back((cpu_ms() - cpu_start) / k_turn);
        }
        if (turn > turns) decision.push_back(1e6 * deciding / walkers);
    }
    world.workers.swap(one);
    clear_progress();
    add_score(run, "sim", "tick", walkers, quantile(tick, 0.5), "ms");
    add_score(run, "sim", "tick, all threads", walkers, quantile(all_threads, 0.5), "ms");
    add_score(run, "sim", "decision", walkers, quantile(decision, 0.5), "ns");
    return {};
}

Result<void> play_pose(Options options, uint32_t repetitions, GauntletRun& run) {
    options.scene.walkers = 1000;
    options.bench_frames = repetitions;
    show_progress("pose");
    Result<std::vector<KernelTime>> times = pose_times(options);
    clear_progress();
    if (!times) return times.error();
    for (const KernelTime& time : *times)
        add_score(run, "pose", time.name + ", " + time.isa, 0, time.median_ns, "ns");
    return {};
}

void play_walk(GauntletRun& run) {
    const Who who;
    const Person person{standard_body(static_cast<float>(usual_height(who))), manner_of(who)};
    const double speed = liked_speed(who, static_cast<double>(leg_length(person.body)));
    for (const Verdict& verdict : try_level(person, speed, k_walk_seconds).verdicts) {
        if (!verdict.measured) continue;
        const Bar& bar = verdict.bar;
        add_score(run, "gait", bar.quantity, 0, verdict.value, "");
        if (bar.low > -k_open) run.scores.back().low = bar.low;
        if (bar.high < k_open) run.scores.back().high = bar.high;
    }
}

#ifdef FLANEUR_VULKAN
double median_of(const Figures& figures, const std::string& stage) {
    for (const Series& series : figures.series)
        if (series.name == stage) return quantile(series.ms, 0.5);
    return std::nan("");
}

Result<void> play_picture(Options options, int walkers, uint32_t frames, bool is_throng, GauntletRun& run) {
    options.scene.walkers = walkers;
    options.scene.size = {1280, 720};
    options.scene.quality = "medium";
    options.bench_frames = frames;
    if (is_throng) options.scene.camera = {CameraChoice::Kind::crowd, 0, {}, {}};
    show_progress("frames of " + short_number(walkers));
    Result<Figures> figures = bench_frame(options);
    clear_progress();
    if (!figures) return figures.error();
    add_score(run, "frame", is_throng ? "crowd" : "street", walkers, median_of(*figures, "frame"), "ms");
    add_score(run, "frame", is_throng ? "crowd, all threads" : "street, all threads", walkers,
              median_of(*figures, "all threads"), "ms");
    for (const auto& [name, value] : figures->setting)
        if (name == "device") run.device = std::get<std::string>(value);
    if (is_throng) return {};
    for (const char* stage : {"step", "extract", "draw"})
        add_score(run, "frame", stage, walkers, median_of(*figures, stage), "ms");
    for (const auto& [name, value] : figures->counts)
        if (name == "sub-draws" || name == "direct draws") add_score(run, "frame", name, walkers, value, "");
    return {};
}

Result<void> play_peers(Options options, int copies, uint32_t frames, GauntletRun& run) {
    options.bench_count = static_cast<uint32_t>(copies);
    options.bench_frames = frames;
    options.scene.size = {1280, 720};
    show_progress("peers of " + short_number(copies));
    Result<Figures> figures = bench_peers(options);
    clear_progress();
    if (!figures) return figures.error();
    const std::string modes[] = {"with LOD", "every triangle"};
    for (const std::string& mode : modes)
        add_score(run, "peers", mode, copies, median_of(*figures, mode + "/frame"), "ms");
    for (const std::string& mode : modes)
        add_score(run, "peers", mode + ", all threads", copies, median_of(*figures, mode + "/all threads"),
                  "ms");
    for (const auto& [name, value] : figures->counts)
        if (name == "mean FLIP between the two") add_score(run, "peers", "FLIP", copies, value, "");
    return {};
}

Result<void> play_pictures(const Options& options, const GauntletPlan& plan, GauntletRun& run) {
    Options everyday = options;
    everyday.scene.people.clear();  // those of peers
    for (const bool is_throng : {false, true}) {
        if (is_throng && !plan.has_throng) continue;
        for (const int walkers : plan.pictures)
            if (Result<void> done = play_picture(everyday, walkers, plan.frames, is_throng, run); !done)
                return done;
    }
    if (options.scene.people.empty()) {
        run.notes.emplace_back(
            "Peers was left out: it draws copies of a character with a clip of its own. --character FILE "
            "gives one, Khronos' "
            "CesiumMan.glb to compare with others.");
        return {};
    }
    for (const int copies : plan.copies)
        if (Result<void> done = play_peers(options, copies, plan.frames / 2, run); !done) return done;
    return {};
}
#else
Result<void> play_pictures(const Options&, const GauntletPlan&, GauntletRun& run) {
    run.notes.emplace_back("Frames and peers were left out: this flaneur was built without Vulkan.");
    return {};
}
#endif

Result<void> play(const Options& options, GauntletRun& run) {
    const GauntletPlan plan = plan_of(options.study.quick);
    Options everyday = options;
    everyday.scene.people.clear();
    everyday.scene.walkers = 500;
    if (Result<void> done = play_load(everyday, run); !done) return done;
    for (const int walkers : plan.crowds)
        if (Result<void> done = play_crowd(everyday, walkers, plan.turns, run); !done) return done;
    if (Result<void> done = play_pose(everyday, plan.repetitions, run); !done) return done;
    play_walk(run);
    return play_pictures(options, plan, run);
}

}  // namespace

Result<std::string> bench_gauntlet(const Options& options) {
    GauntletRun run;
    const std::string cpu = cpu_name();
    run.machine =
        (cpu.empty() ? "a CPU without a name" : cpu) + ", " + std::to_string(core_count()) + " cores";
    run.version = FLANEUR_VERSION;
    run.is_quick = options.study.quick;
    std::vector<GauntletRun> others;
    if (!options.study.others.empty()) {  // before minutes go by
        std::vector<std::string> notes;
        Result<std::vector<GauntletRun>> read = read_others(options.study.others, run.is_quick, notes);
        if (!read) return read.error();
        others = std::move(*read);
        for (const std::string& note : notes) say(note);
    }
    Result<PartFilePtr> html = open_if_asked(options.study.html);
    if (!html) return html.error();
    Result<PartFilePtr> markdown = open_if_asked(options.study.markdown);
    if (!markdown) return markdown.error();

    note_others(run);
    const auto start = std::chrono::steady_clock::now();
    if (Result<void> done = play(options, run); !done) return done.error();
    run.seconds = ms_since(start) / 1000;
    for (const std::string& note : run.notes) std::printf("%s\n", note.c_str());
    std::printf("%s run of %.0f s\n", run.is_quick ? "A quick" : "A full", run.seconds);
    if (*html) {
        if (Result<void> kept = write_file(std::move(*html), gauntlet_html(run, others)); !kept)
            return kept.error();
    }
    if (*markdown) {
        if (Result<void> kept = write_file(std::move(*markdown), goals_markdown(run)); !kept)
            return kept.error();
    }
    return run_json(run);
}

}  // namespace flaneur
