#include <chrono>
#include <cstdio>

#include "tools/flaneur/commands.h"
#include "tools/flaneur/figures.h"
#include "tools/flaneur/load.h"
#include "tools/flaneur/output.h"
#ifdef FLANEUR_VULKAN
#include "tools/flaneur/camera.h"
#include "tools/flaneur/show.h"
#endif

namespace flaneur {

namespace {

using Clock = std::chrono::steady_clock;
constexpr uint32_t k_warm_up = 60;  // ticks; people get under way

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

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

#ifdef FLANEUR_VULKAN
// One frame of the load: a tick, the extraction, and a picture read back.
Result<void> measure_frame(Show& show, const Options& options, const Camera& camera, Figures& figures) {
    World& world = *show.loaded.world;
    auto start = Clock::now();
    step(world);
    add_sample(figures, "step", ms_since(start));
    add_stages(figures, world, Stage::think, Stage::pose);
    auto extracting = Clock::now();
    FrameInput frame = extract_frame(show, camera, 1);
    add_sample(figures, "extract", ms_since(extracting));
    auto drawing = Clock::now();
    Result<Image> image = draw_image(*show.renderer, frame, static_cast<uint32_t>(options.size.width),
                                     static_cast<uint32_t>(options.size.height));
    if (!image) return image.error();
    add_sample(figures, "draw", ms_since(drawing));
    const FrameStats& stats = frame_stats(*show.renderer);
    add_sample(figures, "record", stats.cpu_record_ms);
    for (const FrameStats::Stage& stage : stats.stages)
        add_sample(figures, "gpu " + stage.name, stage.gpu_ms);
    add_sample(figures, "frame", ms_since(start));
    return {};
}

Result<Figures> bench_frame(const Options& options) {
    std::atomic<uint32_t> messages = 0;
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    Result<Show> show = make_show(std::move(*renderer), options);
    if (!show) return show.error();
    World& world = *show->loaded.world;
    for (uint32_t i = 0; i < k_warm_up; ++i) step(world);
    Camera camera = choose_camera(world, options.camera, 1);

    Figures first, figures;
    Result<void> done = measure_frame(*show, options, camera, first);
    for (uint32_t i = 0; i < options.bench_frames && done; ++i) {
        if (options.camera.kind == CameraChoice::Kind::follow)
            camera = choose_camera(world, options.camera, 1);
        done = measure_frame(*show, options, camera, figures);
    }
    if (done) done = check_messages(messages);
    if (!done) return done.error();

    add_setting(figures, options, world);
    figures.setting.emplace_back("device", device_name(*show->renderer));
    figures.setting.emplace_back(
        "size", std::to_string(options.size.width) + "x" + std::to_string(options.size.height));
    figures.setting.emplace_back("first frame", std::to_string(first.series.back().ms.front()) + " ms");
    const FrameStats& stats = frame_stats(*show->renderer);
    figures.counts = {{"walkers drawn", stats.walkers_drawn},
                      {"walkers in shadow", stats.walkers_in_shadow},
                      {"triangles", stats.triangles},
                      {"sub-draws", stats.sub_draws},
                      {"direct draws", stats.direct_draws}};
    return figures;
}
#else
Result<Figures> bench_frame(const Options&) { return Error{"This flaneur was built without Vulkan."}; }
#endif

}  // namespace

Result<void> run_bench(const Options& options) {
    PartFilePtr json;
    if (!options.json.empty()) {
        Result<PartFilePtr> file = open_file(options.json);
        if (!file) return file.error();
        json = std::move(*file);
    }
    Result<Figures> figures = options.load == BenchLoad::frame ? bench_frame(options) : bench_step(options);
    if (!figures) return figures.error();
    print_figures(*figures);
    if (!json) return {};
    std::string text = figures_json(*figures);
    std::fwrite(text.data(), 1, text.size(), json->file);
    return keep_file(std::move(json));
}

}  // namespace flaneur
