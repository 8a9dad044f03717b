#include "tools/flaneur/bench/bench.h"

#include <cstdio>

#include "sim/base/zone.h"
#include "tools/flaneur/bench/compare.h"
#include "tools/flaneur/bench/hardware.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

namespace {

Result<Figures> bench_crowd(const Options& options) {
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    Figures figures;
    add_setting(figures, options, world);
    for (uint32_t i = 0; i < options.warm_up; ++i) {
        if (is_stopping()) return interrupted();
        step(world);
    }
    const MeterReading before = read_meters();
    for (uint32_t i = 0; i < options.bench_frames; ++i) {
        if (is_stopping()) return interrupted();
        FLANEUR_ZONE("frame");
        step(world);
        add_stages(figures, world);
    }
    add_meters(figures, before, options.bench_frames, world.crowd.count);
    return figures;
}

// Those that print a table of their own have printed it.
Result<Figures> measure(const Options& options) {
    if (options.load == BenchLoad::pose) return bench_pose(options);
    if (options.load == BenchLoad::city) return bench_city(options);
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

}  // namespace

void add_setting(Figures& figures, const Options& options, const World& world) {
    figures.setting = {{"city", city_name(options.scene)},
                       {"walkers", world.crowd.count},
                       {"threads", thread_count(*world.workers)},
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
    PartFilePtr json;
    if (!options.json.empty()) {
        Result<PartFilePtr> file = open_file(options.json);
        if (!file) return file.error();
        json = std::move(*file);
    }
    open_meters();
    Result<Figures> figures = measure(options);
    if (!figures) return figures.error();
    return json ? write_file(std::move(json), figures_json(*figures, command_of(options))) : Result<void>();
}

}  // namespace flaneur
