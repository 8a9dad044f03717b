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
constexpr double k_patience = 60;  // seconds, to end a point and keep what there is
constexpr double k_real_ms = 1000.0 / 60;

struct SweepStage {
    const char *series, *name;
};
constexpr SweepStage k_sweep_stages[] = {{"think", "think"}, {"neighbours", "neighbours"},
                                         {"steer", "steer"}, {"move", "move"},
                                         {"gait", "gait"},   {"pose", "pose"},
                                         {"step", "tick"},   {"extract", "extract"},
                                         {"record", "cull"}, {"draw", "draw"},
                                         {"frame", "frame"}};

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

void print_sweep(const std::vector<StudyPoint>& points) {
    std::printf("\n%-11s %8s", "median, ms", "load, s");
    for (const SweepStage& stage : k_sweep_stages)
        if (!medians(points, stage.series).empty()) std::printf(" %10s", stage.name);
    std::printf(" %9s %6s\n", "memory, MB", "ticks");
    for (const StudyPoint& point : points) {
        std::printf("%-11s %8.1f", short_number(point.at).c_str(), count_of(point, "load_s"));
        for (const SweepStage& stage : k_sweep_stages)
            for (const PlotPoint& ms : medians({point}, stage.series)) std::printf(" %10.3f", ms.y);
        std::printf(" %10.0f %6.0f\n", count_of(point, "resident_mb"), count_of(point, "ticks"));
    }
}

std::vector<PlotPoint> memory(const std::vector<StudyPoint>& points) {
    std::vector<PlotPoint> mb;
    for (const StudyPoint& point : points) mb.push_back({point.at, count_of(point, "resident_mb")});
    return mb;
}

nlohmann::ordered_json json_of(const std::vector<StudyPoint>& points, const Figures& setting) {
    nlohmann::ordered_json json;
    put_setting(setting, json);
    for (const StudyPoint& point : points) {
        nlohmann::ordered_json row = {{"walkers", static_cast<int64_t>(point.at)}};
        for (const auto& [name, value] : point.figures.counts) row[name] = value;
        for (const SweepStage& stage : k_sweep_stages)
            for (const PlotPoint& ms : medians({point}, stage.series)) row["stages"][stage.name] = ms.y;
        json["points"].push_back(row);
    }
    return json;
}

// Prints the exponents and where real time ends, and adds them to what is written.
void tell_growth(const std::vector<StudyPoint>& points, nlohmann::ordered_json& json) {
    std::printf("\n");
    auto tell = [&](const char* name, const std::vector<PlotPoint>& over) {
        const std::optional<PowerLaw> law = fit_power(over);
        if (!law) return;
        std::printf("%-11s grows as walkers^%.2f, fitted from %s to %s\n", name, law->exponent,
                    short_number(law->from).c_str(), short_number(law->to).c_str());
        json["fits"].push_back({{"stage", name},
                                {"exponent", law->exponent},
                                {"factor", law->factor},
                                {"from", law->from},
                                {"to", law->to}});
    };
    for (const SweepStage& stage : k_sweep_stages) tell(stage.name, medians(points, stage.series));
    tell("memory", memory(points));
    std::printf("\n");
    for (const SweepStage& stage : {k_sweep_stages[6], k_sweep_stages[10]}) {
        const std::vector<PlotPoint> ms = medians(points, stage.series);
        if (ms.empty()) continue;
        std::printf("%s\n", real_time_told(stage.name, ms).c_str());
        json["real_time"].push_back({{"stage", stage.name}, {"up_to", real_time_end(ms)}});
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

}  // namespace

Result<std::string> bench_sweep(const Options& options) {
    PartFilePtr svg;
    if (!options.study.svg.empty()) {
        Result<PartFilePtr> file = open_file(options.study.svg);
        if (!file) return file.error();
        svg = std::move(*file);
    }
    be_patient(k_patience);
    Subject subject;
    if (Result<void> begun = begin(subject, options); !begun) return begun.error();
    std::vector<StudyPoint> points;
    std::string left;  // why the sweep ended before its last point
    for (const uint32_t walkers :
         sweep_points(options.study.walkers.first, options.study.walkers.last, options.study.steps)) {
        Result<StudyPoint> point = measure_point(subject, options, walkers);
        clear_progress();
        if (!point) {
            left = short_number(walkers) + " walkers were not measured: " + point.error().message;
            if (points.empty()) return point.error();
            break;
        }
        points.push_back(std::move(*point));
        const std::vector<PlotPoint> tick = medians({points.back()}, "step");
        say(short_number(walkers) + " walkers: a tick takes " + short_number(tick.front().y) +
            " ms, loading took " + short_number(count_of(points.back(), "load_s")) + " s, " +
            short_number(count_of(points.back(), "resident_mb")) + " MB");
    }
    if (Result<void> quiet = end(subject); !quiet) return quiet.error();
    Figures setting;
    setting.setting = {
        {"city", city_told(options, points)},
        {"threads", options.threads == 0 ? static_cast<int64_t>(core_count()) : options.threads}};
#ifdef FLANEUR_VULKAN
    setting.setting.emplace_back("device", device_name(*subject.show.renderer));
    setting.setting.emplace_back(
        "size", std::to_string(options.scene.size.width) + "x" + std::to_string(options.scene.size.height));
#endif
    print_setting(setting);
    print_sweep(points);
    nlohmann::ordered_json json = json_of(points, setting);
    tell_growth(points, json);
    if (!left.empty()) {
        std::printf("%s\n", left.c_str());
        json["left_out"] = left;
    }
    if (svg) {
        Result<void> kept = write_file(
            std::move(svg),
            sweep_svg(points, city_told(options, points) + "; exponents of the upper half of the points."));
        if (!kept) return kept.error();
    }
    return json.dump(2) + "\n";
}

}  // namespace flaneur
