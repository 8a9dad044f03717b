#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/flaneur/bench/study/study.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/plot/svg_pieces.h"
#ifdef FLANEUR_VULKAN
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#endif

namespace flaneur {

namespace {

constexpr double k_warm_seconds = 6, k_measured_seconds = 8;  // a point, at most,
constexpr uint32_t k_least_ticks = 4;                         // but so many: who decides takes turns of four
constexpr double k_real_ms = 1000.0 / 60;

#ifdef FLANEUR_VULKAN
constexpr bool k_is_drawn = true;
#else
constexpr bool k_is_drawn = false;
#endif

struct SweepStage {
    const char *series, *name;
    bool is_of_picture = false;
};
constexpr SweepStage k_sweep_stages[] = {{"think", "think"},       {"neighbours", "neighbours"},
                                         {"steer", "steer"},       {"move", "move"},
                                         {"gait", "gait"},         {"pose", "pose"},
                                         {"step", "tick"},         {"extract", "extract", true},
                                         {"record", "cull", true}, {"draw", "draw", true},
                                         {"frame", "frame", true}};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What is measured at each point: a loaded city that is drawn, where there is something to draw with.
#ifdef FLANEUR_VULKAN
struct Subject {
    std::atomic<uint32_t> messages = 0;
    Show show;
    Camera camera;
};

Result<void> begin(Subject& subject, const Options& options) {
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, subject.messages));
    if (!renderer) return renderer.error();
    say_device(**renderer);
    subject.show.renderer = std::move(*renderer);
    return {};
}

Result<World*> set_up(Subject& subject, const Options& options) {
    subject.show.loaded = {};  // before the next one is made: there may not be room for both
    Result<PreparedShow> prepared = prepare_show(options);
    if (!prepared) return prepared.error();
    Result<void> uploaded = upload_show(subject.show, *prepared, options.scene.views);
    if (!uploaded) return uploaded.error();
    return subject.show.loaded.world.get();
}

void look(Subject& subject, const Options& options) {
    subject.camera =
        choose_camera(subject.show, options.scene.camera, options.scene.fov, options.scene.size, 1);
}

Result<void> measure(Subject& subject, const Options& options, Figures& figures) {
    return measure_frame(subject.show, options, subject.camera, figures);
}

Result<void> end(Subject& subject) { return check_messages(subject.messages); }

void add_device(const Subject& subject, const Options& options, Figures& figures) {
    figures.setting.emplace_back("device", device_name(*subject.show.renderer));
    figures.setting.emplace_back("quality", quality_name(*subject.show.renderer));
    figures.setting.emplace_back(
        "size", std::to_string(options.scene.size.width) + "x" + std::to_string(options.scene.size.height));
}
#else
struct Subject {
    Loaded loaded;
};

Result<void> begin(Subject&, const Options&) { return {}; }

Result<World*> set_up(Subject& subject, const Options& options) {
    subject.loaded = {};
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    subject.loaded = std::move(*loaded);
    return subject.loaded.world.get();
}

void look(Subject&, const Options&) {}

Result<void> measure(Subject& subject, const Options&, Figures& figures) {
    const auto start = std::chrono::steady_clock::now();
    step(*subject.loaded.world);
    add_sample(figures, "step", 1e3 * seconds_since(start));
    add_stages(figures, *subject.loaded.world);
    return {};
}

Result<void> end(Subject&) { return {}; }

void add_device(const Subject&, const Options&, Figures&) {}
#endif

// Loads the city with so many walkers, lets them get under way and measures them, each for a while at most.
Result<StudyPoint> measure_point(Subject& subject, Options options, uint32_t walkers) {
    options.scene.walkers = static_cast<int>(walkers);
    const std::string who = short_number(walkers) + " walkers";
    StudyPoint point{static_cast<double>(walkers), {}};
    auto start = std::chrono::steady_clock::now();
    Result<World*> world = set_up(subject, options);
    if (!world) return world.error();
    point.figures.counts.emplace_back("load_s", seconds_since(start));
    start = std::chrono::steady_clock::now();
    for (uint32_t i = 0; i < options.warm_up && seconds_since(start) < k_warm_seconds; ++i) {
        if (is_stopping()) return interrupted();
        show_progress(who + ", getting under way");
        step(**world);
    }
    look(subject, options);
    start = std::chrono::steady_clock::now();
    uint32_t ticks = 0;
    for (;
         ticks < options.bench_frames && (ticks < k_least_ticks || seconds_since(start) < k_measured_seconds);
         ++ticks) {
        if (is_stopping()) return interrupted();
        show_progress(who + ", tick " + std::to_string(ticks + 1));
        if (Result<void> done = measure(subject, options, point.figures); !done) return done.error();
    }
    clear_progress();
    point.figures.counts.emplace_back("ticks", ticks);
    point.figures.counts.emplace_back("resident_mb", resident_mb());
    return point;
}

double count_of(const StudyPoint& point, const std::string& name) {
    for (const auto& [key, value] : point.figures.counts)
        if (key == name) return value;
    return 0;
}

// "district, the built-in one, which has 4 x 4 to 12 x 12 blocks of houses: it grows with the walkers"
std::string city_told(const Options& options, const std::vector<StudyPoint>& points) {
    std::string told = city_name(options.scene);
    if (!grows_with_walkers(options.scene) || points.empty()) return told;
    auto blocks = [&](const StudyPoint& point) {
        Scene scene = options.scene;
        scene.walkers = static_cast<int>(point.at);
        const std::string side = std::to_string(district_blocks(scene));
        return side + " x " + side;
    };
    const std::string low = blocks(points.front()), high = blocks(points.back());
    told += ", built in, " + low;
    return told + (low == high ? " blocks" : " to " + high + " blocks: it grows with the walkers");
}

// Up to how many walkers a stage keeps within 1/60 s: 0 where it does so for none that were measured.
double real_time_end(const std::vector<PlotPoint>& ms) {
    if (ms.front().y >= k_real_ms) return 0;
    return std::round(crossing(ms, k_real_ms).value_or(ms.back().x));
}

std::string real_time_told(const std::string& name, const std::vector<PlotPoint>& ms) {
    const double end = real_time_end(ms);
    if (end == 0) return "A " + name + " takes more than 1/60 s from the first point on.";
    if (end == ms.back().x) return "A " + name + " takes less than 1/60 s at all points.";
    return "A " + name + " takes 1/60 s at about " + short_number(end) + " walkers, between two points.";
}

void print_head() {
    std::printf("\n%-11s %8s", "median, ms", "load, s");
    for (const SweepStage& stage : k_sweep_stages)
        if (k_is_drawn || !stage.is_of_picture) std::printf(" %10s", stage.name);
    std::printf(" %10s %6s\n", "memory, MB", "ticks");
}

void print_point(const StudyPoint& point) {
    std::printf("%-11s %8.1f", short_number(point.at).c_str(), count_of(point, "load_s"));
    for (const SweepStage& stage : k_sweep_stages)
        for (const PlotPoint& ms : medians({point}, stage.series)) std::printf(" %10.3f", ms.y);
    std::printf(" %10.0f %6.0f\n", count_of(point, "resident_mb"), count_of(point, "ticks"));
    std::fflush(stdout);
}

std::vector<PlotPoint> memory(const std::vector<StudyPoint>& points) {
    std::vector<PlotPoint> mb;
    mb.reserve(points.size());
    for (const StudyPoint& point : points) mb.push_back({point.at, count_of(point, "resident_mb")});
    return mb;
}

nlohmann::ordered_json json_of(const std::vector<StudyPoint>& points, const Figures& setting) {
    nlohmann::ordered_json json;
    put_setting(setting, json["setting"]);
    for (const StudyPoint& point : points) {
        nlohmann::ordered_json row = {{"walkers", static_cast<int64_t>(point.at)}};
        for (const auto& [name, value] : point.figures.counts) row[name] = value;
        for (const SweepStage& stage : k_sweep_stages)
            for (const PlotPoint& ms : medians({point}, stage.series)) row["stages"][stage.name] = ms.y;
        json["points"].push_back(row);
    }
    return json;
}

// The exponents and where real time ends: printed, and added to what is written.
void tell_growth(const std::vector<StudyPoint>& points) {
    std::printf("\n");
    auto tell = [&](const char* name, const std::vector<PlotPoint>& over) {
        if (const std::optional<PowerLaw> law = fit_power(over))
            std::printf("%-11s grows as walkers^%.2f, fitted from %s to %s\n", name, law->exponent,
                        short_number(law->from).c_str(), short_number(law->to).c_str());
    };
    for (const SweepStage& stage : k_sweep_stages) tell(stage.name, medians(points, stage.series));
    tell("memory", memory(points));
    std::printf("\n");
    for (const char* series : {"step", "frame"}) {
        const std::vector<PlotPoint> ms = medians(points, series);
        const std::string name = std::string_view(series) == "step" ? "tick" : series;
        if (!ms.empty()) std::printf("%s\n", real_time_told(name, ms).c_str());
    }
}

void add_growth(const std::vector<StudyPoint>& points, nlohmann::ordered_json& json) {
    auto add = [&](const char* name, const std::vector<PlotPoint>& over) {
        if (const std::optional<PowerLaw> law = fit_power(over))
            json["fits"].push_back({{"stage", name},
                                    {"exponent", law->exponent},
                                    {"factor", law->factor},
                                    {"from", law->from},
                                    {"to", law->to}});
    };
    for (const SweepStage& stage : k_sweep_stages) add(stage.name, medians(points, stage.series));
    add("memory", memory(points));
    for (const char* series : {"step", "frame"}) {
        const std::vector<PlotPoint> ms = medians(points, series);
        const char* const name = std::string_view(series) == "step" ? "tick" : series;
        if (!ms.empty()) json["real_time"].push_back({{"stage", name}, {"up_to", real_time_end(ms)}});
    }
}

std::string sweep_svg(const std::vector<StudyPoint>& points, const std::string& note) {
    LinePlot times{.title = "A tick and a picture over the number of walkers",
                   .note = note,
                   .x = {"walkers", true},
                   .y = {"median, milliseconds", true}};
    for (const SweepStage& stage : k_sweep_stages) {
        PlotLine line{stage.name, medians(points, stage.series)};
        if (const auto law = fit_power(line.points)) line.name += printed(", ^%.2f", law->exponent);
        times.lines.push_back(std::move(line));
    }
    times.levels = {{"1/60 s: real time", k_real_ms}};
    LinePlot held{.title = "Memory over the number of walkers",
                  .note = "What the process holds once a point is measured.",
                  .x = {"walkers", true},
                  .y = {"megabytes", true},
                  .lines = {{"memory", memory(points)}}};
    return stacked({plot_svg(times), plot_svg(held)});
}

// A file that is written anew after each point: whatever ends the program leaves the points before. What goes
// to a pipe is written once, at the end.
struct KeptFile {
    std::string path;
    PartFilePtr stream;
};

// Refuses, before anything is measured, what cannot be written to. An empty path is no file.
Result<KeptFile> begin_kept(const std::string& path) {
    KeptFile kept{path, nullptr};
    if (path.empty()) return kept;
    Result<PartFilePtr> file = open_file(path);
    if (!file) return file.error();
    kept.stream = std::move(*file);
    return kept;
}

Result<void> write_kept(KeptFile& file, const std::string& bytes, bool is_last) {
    if (file.path.empty() || (file.stream && !is_last)) return {};
    return file.stream ? write_file(std::move(file.stream), bytes) : write_file(file.path, bytes);
}

Figures setting_of(const Subject& subject, const Options& options, const std::vector<StudyPoint>& points) {
    Figures figures;
    figures.setting = {
        {"city", city_told(options, points)},
        {"threads", options.threads == 0 ? static_cast<int64_t>(core_count()) : options.threads}};
    add_device(subject, options, figures);
    return figures;
}

}  // namespace

Result<void> run_sweep(const Options& options) {
    Result<KeptFile> json = begin_kept(options.json);
    if (!json) return json.error();
    Result<KeptFile> svg = begin_kept(options.study.svg);
    if (!svg) return svg.error();
    for (KeptFile* file : {&*json, &*svg})
        if (!is_stream(file->path)) file->stream.reset();
    Subject subject;
    if (Result<void> begun = begin(subject, options); !begun) return begun.error();
    const std::vector<uint32_t> counts =
        sweep_points(options.study.walkers.first, options.study.walkers.last, options.study.steps);
    std::vector<StudyPoint> points;
    auto write = [&](const std::string& left_out, bool is_last) -> Result<void> {
        nlohmann::ordered_json figures = json_of(points, setting_of(subject, options, points));
        add_growth(points, figures);
        if (!left_out.empty()) figures["left_out"] = left_out;
        Result<void> kept = write_kept(*json, figures.dump(2) + "\n", is_last);
        const std::string note = city_told(options, points) + "; exponents of the upper half of the points.";
        return kept ? write_kept(*svg, sweep_svg(points, note), is_last) : kept;
    };
    print_head();
    std::string left_out;  // why the sweep ended before its last point
    for (const uint32_t walkers : counts) {
        Result<StudyPoint> point = measure_point(subject, options, walkers);
        clear_progress();
        if (!point) {
            if (points.empty()) return point.error();
            left_out = short_number(walkers) + " walkers were not measured: " + point.error().message;
            break;
        }
        points.push_back(std::move(*point));
        print_point(points.back());
        if (Result<void> kept = write({}, false); !kept) return kept;
    }
    if (Result<void> quiet = end(subject); !quiet) return quiet.error();
    tell_growth(points);
    std::printf("\n");
    print_setting(setting_of(subject, options, points));
    if (!left_out.empty()) std::printf("%s\n", left_out.c_str());
    if (Result<void> kept = write(left_out, true); !kept) return kept;
    return is_stopping() ? interrupted("what was measured before is kept") : Result<void>();
}

}  // namespace flaneur
