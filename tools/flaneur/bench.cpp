#include "tools/flaneur/bench.h"

#include <cstdio>

#include "tools/flaneur/commands.h"
#include "tools/flaneur/load.h"
#include "tools/flaneur/output.h"

namespace flaneur {

namespace {

Result<Figures> bench_step(const Options& options) {
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    Figures figures;
    add_setting(figures, options, world);
    bool crowd = options.load == BenchLoad::crowd;
    for (uint32_t i = 0; i < k_warm_up + options.bench_frames; ++i) {
        step(world);
        if (i < k_warm_up) continue;
        if (crowd) {
            add_stages(figures, world, Stage::think, Stage::move);
        } else {
            add_stages(figures, world, Stage::gait, Stage::pose);
        }
    }
    return figures;
}

Result<Figures> measure(const Options& options) {
#ifdef FLANEUR_VULKAN
    if (options.load == BenchLoad::frame) return bench_frame(options);
#endif
    return bench_step(options);
}

}  // namespace

void add_setting(Figures& figures, const Options& options, const World& world) {
    figures.setting = {{"city", world.city.name},
                       {"walkers", std::to_string(world.crowd.count)},
                       {"threads", std::to_string(thread_count(*world.workers))},
                       {"measured", std::to_string(options.bench_frames)}};
}

void add_stages(Figures& figures, const World& world, Stage first, Stage last) {
    for (int s = static_cast<int>(first); s <= static_cast<int>(last); ++s)
        add_sample(figures, k_stage_names[s], world.stage_ms[s]);
}

Result<void> run_bench(const Options& options) {
    PartFilePtr json;
    if (!options.json.empty()) {
        Result<PartFilePtr> file = open_file(options.json);
        if (!file) return file.error();
        json = std::move(*file);
    }
    Result<Figures> figures = measure(options);
    if (!figures) return figures.error();
    print_figures(*figures);
    if (!json) return {};
    std::string text = figures_json(*figures);
    std::fwrite(text.data(), 1, text.size(), json->file);
    return keep_file(std::move(json));
}

}  // namespace flaneur
