#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/base/zone.h"
#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/bench/hardware.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr uint32_t k_timed_frames = 20;  // whose passes are timed

using Clock = std::chrono::steady_clock;

// What crowd, city and sky take of the scene's time, in a frame that draws one after the other.
Result<void> measure_passes(Show& show, const Options& options, const Camera& camera, Figures& figures) {
    FLANEUR_ZONE("frame");
    FrameInput frame = extract_frame(show, camera, options.scene.size, 1);
    frame.times_passes = true;
    Result<Image> image = draw_image(*show.renderer, frame, static_cast<uint32_t>(options.scene.size.width),
                                     static_cast<uint32_t>(options.scene.size.height));
    if (!image) return image.error();
    for (const FrameStats::Stage& stage : frame_stats(*show.renderer).stages)
        if (stage.name == "crowd" || stage.name == "city" || stage.name == "sky")
            add_sample(figures, "gpu " + stage.name, stage.gpu_ms, "gpu scene");
    return {};
}

constexpr float k_tick_seconds = 1.0f / 60;
constexpr float k_stroll = 1.4f;      // metres a second
constexpr float k_orbit_rate = 0.2f;  // radians a second

// Where the camera is a tick later.
Camera moved(Camera camera, const Options& options, const Show& show, uint32_t frame) {
    CameraChoice choice = options.scene.camera;
    if (options.move == BenchMove::follow && choice.kind != CameraChoice::Kind::follow)
        choice = {CameraChoice::Kind::follow, 0, {}, {}};
    if (choice.kind == CameraChoice::Kind::follow || choice.kind == CameraChoice::Kind::eyes)
        return choose_camera(show, choice, options.scene.fov, options.scene.size, 1);
    const glm::vec3 way = camera.target - camera.eye;
    if (options.move == BenchMove::walk) {
        // Down the street, and back before its end.
        const float there = frame / 600 % 2 == 0 ? 1.0f : -1.0f;
        const glm::vec3 step =
            glm::normalize(glm::vec3(way.x, 0, way.z)) * (there * k_stroll * k_tick_seconds);
        camera.eye += step, camera.target += step;
    } else if (options.move == BenchMove::orbit) {
        const float s = std::sin(k_orbit_rate * k_tick_seconds), c = std::cos(k_orbit_rate * k_tick_seconds);
        camera.eye = camera.target - glm::vec3(c * way.x + s * way.z, way.y, c * way.z - s * way.x);
    }
    return camera;
}

// The time that went by in the frame, and what it went into.
std::string first_frame(const Figures& first) {
    std::string total, parts;
    for (const Series& series : first.series) {
        const std::string ms = std::to_string(std::lround(series.ms.front())) + " ms";
        if (series.name == "frame")
            total = ms;
        else if (series.name.starts_with("gpu ") || series.name == "record" || series.name == "all threads")
            parts += (parts.empty() ? "" : ", ") + series.name + " " + ms;
    }
    return total + " (" + parts + ")";
}

}  // namespace

Result<void> measure_frame(Show& show, const Options& options, const Camera& camera, Figures& figures) {
    FLANEUR_ZONE("frame");
    World& world = *show.loaded.world;
    auto start = Clock::now();
    const double cpu_start = cpu_ms();
    look_from(show, camera);
    step(world);
    add_sample(figures, "step", ms_since(start), "frame");
    add_stages(figures, world);
    auto extracting = Clock::now();
    FrameInput frame = extract_frame(show, camera, options.scene.size, 1);
    add_sample(figures, "extract", ms_since(extracting), "frame");
    auto drawing = Clock::now();
    Result<Image> image = draw_image(*show.renderer, frame, static_cast<uint32_t>(options.scene.size.width),
                                     static_cast<uint32_t>(options.scene.size.height));
    if (!image) return image.error();
    add_sample(figures, "draw", ms_since(drawing), "frame");
    const FrameStats& stats = frame_stats(*show.renderer);
    add_sample(figures, "record", stats.cpu_record_ms, "draw");
    for (const FrameStats::Stage& stage : stats.stages)
        add_sample(figures, "gpu " + stage.name, stage.gpu_ms, "draw");
    add_sample(figures, "frame", ms_since(start));
    add_sample(figures, "all threads", cpu_ms() - cpu_start);
    return {};
}

void add_counts(Figures& figures, const FrameStats& stats) {
    figures.counts = {{"walkers drawn", stats.walkers_drawn},
                      {"impostors", stats.impostors},
                      {"walkers in shadow", stats.walkers_in_shadow},
                      {"triangles", stats.triangles},
                      {"sub-draws", stats.sub_draws},
                      {"direct draws", stats.direct_draws},
                      {"uploaded bytes", static_cast<double>(stats.uploaded_bytes)}};
    for (size_t level = 0; level < k_max_lods; ++level)
        figures.counts.emplace_back("meshes, level " + std::to_string(level), stats.meshes[level]);
    for (const FrameStats::Stage& stage : stats.stages) {
        if (stage.vertices > 0) figures.counts.emplace_back(stage.name + " vertices", stage.vertices);
        if (stage.fragments > 0) figures.counts.emplace_back(stage.name + " fragments", stage.fragments);
    }
}

Result<Figures> bench_frame(const Options& options) {
    if (Result<void> found = find_files(options.scene); !found) return found.error();
    std::atomic<uint32_t> messages = 0;
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    Result<Show> show = make_show(std::move(*renderer), options);
    if (!show) return show.error();
    World& world = *show->loaded.world;
    for (uint32_t i = 0; i < options.warm_up; ++i) step(world);
    CameraChoice choice = options.scene.camera;
    if (options.move == BenchMove::orbit && choice.kind == CameraChoice::Kind::street)
        choice.kind = CameraChoice::Kind::overview;
    Camera camera = choose_camera(*show, choice, options.scene.fov, options.scene.size, 1);

    Figures first, figures;
    Result<void> done = measure_frame(*show, options, camera, first);
    const MeterReading before = read_meters();
    for (uint32_t i = 0; i < options.bench_frames && done; ++i) {
        if (is_stopping()) return interrupted();
        camera = moved(camera, options, *show, i);
        done = measure_frame(*show, options, camera, figures);
    }
    Figures counted;
    add_meters(counted, before, options.bench_frames, world.crowd.count);
    for (uint32_t i = 0; i < std::min(options.bench_frames, k_timed_frames) && done; ++i)
        done = measure_passes(*show, options, camera, figures);
    if (done) done = check_messages(messages);
    if (!done) return done.error();

    add_setting(figures, options, world);
    figures.setting.emplace_back("device", device_name(*show->renderer));
    figures.setting.emplace_back("quality", quality_name(*show->renderer));
    figures.setting.emplace_back(
        "size", std::to_string(options.scene.size.width) + "x" + std::to_string(options.scene.size.height));
    figures.setting.emplace_back("first frame", first_frame(first));
    add_counts(figures, frame_stats(*show->renderer));
    figures.setting.insert(figures.setting.end(), counted.setting.begin(), counted.setting.end());
    figures.counts.insert(figures.counts.end(), counted.counts.begin(), counted.counts.end());
    return figures;
}

}  // namespace flaneur
