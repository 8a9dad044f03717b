#include "tools/flaneur/bench/bench.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "sim/base/isa.h"
#include "sim/base/zone.h"
#include "tools/flaneur/bench/compare.h"
#include "tools/flaneur/bench/gauntlet/gauntlet.h"
#include "tools/flaneur/bench/hardware.h"
#include "tools/flaneur/bench/study/study.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/recording/check.h"
#include "tools/flaneur/recording/taking.h"

namespace flaneur {

namespace {

// Those that print a table of their own have printed it.
Result<Figures> measure(const Options& options) {
    if (options.load == BenchLoad::pose) return bench_pose(options);
    if (options.load == BenchLoad::city) return bench_city(options);
    if (options.load == BenchLoad::ik) return bench_ik();
#ifdef FLANEUR_VULKAN
    if (options.load == BenchLoad::peers) return bench_peers(options);
    Result<Figures> figures = options.load == BenchLoad::frame    ? bench_frame(options)
                              : options.load == BenchLoad::window ? bench_window(options)
                                                                  : bench_crowd(options);
#else
    Result<Figures> figures = bench_crowd(options);
#endif
    if (figures) print_figures(*figures);
    return figures;
}

// "flaneur bench frame --walkers 500"
std::string command_of(const Options& options) {
    std::string command = "flaneur bench";
    for (const std::string& word : options.words) command += " " + word;
    return command;
}

// Measures, and gives it as JSON: most loads have figures, some a JSON of their own.
Result<std::string> measured_json(const Options& options) {
    if (options.load == BenchLoad::scale) return bench_scale(options);
    if (options.load == BenchLoad::gauntlet) return bench_gauntlet(options);
#ifdef FLANEUR_VULKAN
    if (options.load == BenchLoad::ablate) return bench_ablate(options);
#endif
    Result<Figures> figures = measure(options);
    if (!figures) return figures.error();
    return figures_json(*figures, command_of(options));
}

}  // namespace

// As a viewer has it: an eye among the people, or where --camera says.
static void look_from_among(World& world, const Options& options) {
    const CameraChoice& camera = options.scene.camera;
    if (options.load != BenchLoad::tick || world.crowd.count == 0) return;
    const bool is_fixed = camera.kind == CameraChoice::Kind::fixed;
    const Vec3 eye = is_fixed ? camera.eye : world.crowd.motion.position[world.crowd.count / 2];
    if (options.lod > 0) look_from(world, {&eye, 1}, options.lod);
}

// What the stages come to.
static void add_rates(Figures& figures, const World& world) {
    auto median_of = [&](std::string_view name) {
        for (const Series& series : figures.series)
            if (series.name == name) return quantile(series.ms, 0.5);
        return 0.0;
    };
    double tick = 0;
    for (std::string_view name : k_stage_names) tick += median_of(name);
    const double decisions = static_cast<double>(world.crowd.count) / k_decision_ticks;
    if (world.crowd.onlookers.eyes.empty())  // else those afar decide less often
        figures.counts.emplace_back("neighbours and steering, ns a decision",
                                    (median_of("neighbours") + median_of("steer")) * 1e6 / decisions);
    figures.counts.emplace_back("simulated seconds a second", 1000 * static_cast<double>(k_tick) / tick);
}

Result<Figures> bench_crowd(const Options& options) {
    if (Result<void> allowed = check_record(options); !allowed) return allowed.error();
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    Figures figures;
    add_setting(figures, options, world);
    look_from_among(world, options);
    for (uint32_t i = 0; i < options.warm_up; ++i) {
        if (is_stopping()) return interrupted();
        step(world);
    }
    Result<TakingPtr> taking = begin_taking(options, world);
    if (!taking) return taking.error();
    const MeterReading before = read_meters();
    for (uint32_t i = 0; i < options.bench_frames; ++i) {
        if (is_stopping()) return interrupted();
        FLANEUR_ZONE("frame");
        step(world);
        add_stages(figures, world);
        if (!*taking) continue;
        const auto start = std::chrono::steady_clock::now();
        if (!take(**taking, world)) break;  // finish_taking() says why
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        add_sample(figures, "record", took.count(), "step");
    }
    if (Result<void> finished = finish_taking(std::move(*taking)); !finished) return finished.error();
    add_meters(figures, before, options.bench_frames, world.crowd.count);
    add_rates(figures, world);
    return figures;
}

double resident_mb() {
    std::ifstream file("/proc/self/statm");
    double whole = 0, resident = 0;
    if (!(file >> whole >> resident)) return 0;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

int core_count() { return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u)); }

void add_setting(Figures& figures, const Options& options, const World& world) {
    figures.setting = {
        {"city", city_name(options.scene)},
        {"walkers", world.crowd.count},
        {"threads", thread_count(*world.workers)},
        {"instructions", options.isa == "best" ? std::string(isa_names().back()) : options.isa},
        {"measured", options.bench_frames}};
}

void add_stages(Figures& figures, const World& world) {
    for (int s = 0; s < k_stage_count; ++s) add_sample(figures, k_stage_names[s], world.stage_ms[s], "step");
}

Result<void> run_bench(const Options& options) {
    if (options.load == BenchLoad::compare) {
        if (options.compared.size() != 2)
            return Error{"bench compare takes two files: flaneur bench compare before.json after.json"};
        return bench_compare(options.compared[0], options.compared[1], options.tolerance);
    }
    if (Result<void> isa = use_isa(options.isa); !isa) return isa;
    if (options.load == BenchLoad::sweep) return run_sweep(options);
    Result<PartFilePtr> json = open_if_asked(options.json);
    if (!json) return json.error();
    open_meters();
    Result<std::string> measured = measured_json(options);
    if (!measured) return measured.error();
    return *json ? write_file(std::move(*json), *measured) : Result<void>();
}

}  // namespace flaneur
