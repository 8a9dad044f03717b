#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/flaneur/bench/study/study.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

namespace {

constexpr uint32_t k_turn = 4;  // ticks, in which everybody decides once

const std::vector<std::string>& scaled_stages() {
    static const std::vector<std::string> stages = [] {
        std::vector<std::string> all(std::begin(k_stage_names), std::end(k_stage_names));
        all.emplace_back("tick");
        return all;
    }();
    return stages;
}

// A sample is the sum of a turn, a tick of it.
void measure_turn(World& world, Figures& figures) {
    double stages[k_stage_count] = {}, whole = 0;
    for (uint32_t i = 0; i < k_turn; ++i) {
        step(world);
        for (int s = 0; s < k_stage_count; ++s) stages[s] += world.stage_ms[s] / k_turn;
    }
    for (int s = 0; s < k_stage_count; ++s) {
        add_sample(figures, k_stage_names[s], stages[s]);
        whole += stages[s];
    }
    add_sample(figures, "tick", whole);
}

double at_one(const std::vector<PlotPoint>& ms) { return ms.front().y; }

nlohmann::ordered_json tell_scale(const std::vector<StudyPoint>& points, const Figures& setting) {
    nlohmann::ordered_json json;
    print_setting(setting);
    put_setting(setting, json["setting"]);
    for (const StudyPoint& point : points) {
        nlohmann::ordered_json row = {{"threads", static_cast<int>(point.at)}};
        for (const std::string& stage : scaled_stages())
            for (const PlotPoint& ms : medians({point}, stage)) row["stages"][stage] = ms.y;
        json["points"].push_back(row);
    }
    std::printf("\n%-12s", "median, ms");
    for (const StudyPoint& point : points) std::printf(" %9.0f", point.at);
    std::printf(" %9s %11s %8s\n", "speed-up", "efficiency", "serial");
    for (const std::string& stage : scaled_stages()) {
        const std::vector<PlotPoint> ms = medians(points, stage);
        std::printf("%-12s", stage.c_str());
        for (const PlotPoint& p : ms) std::printf(" %9.3f", p.y);
        const std::optional<Amdahl> law = fit_amdahl(ms);
        if (!law || !(ms.back().y > 0)) {
            std::printf("\n");
            continue;
        }
        const double faster = at_one(ms) / ms.back().y;
        std::printf(" %9.2f %9.0f %% %6.0f %%\n", faster, 100 * faster / ms.back().x,
                    100 * law->serial_share());
        json["fits"].push_back({{"stage", stage},
                                {"serial_ms", law->serial_ms},
                                {"shared_ms", law->shared_ms},
                                {"serial_share", law->serial_share()}});
    }
    std::printf(
        "\nSpeed-up of the most threads over one, efficiency a thread, and the share that Amdahl's law, "
        "fitted,\n"
        "leaves to one thread.\n");
    return json;
}

std::string scale_svg(const std::vector<StudyPoint>& points, const std::string& note) {
    LinePlot plot{.title = "A tick over the number of threads",
                  .note = note,
                  .x = {"threads"},
                  .y = {"times as fast as on one thread"}};
    for (const std::string& stage : scaled_stages()) {
        PlotLine line{stage, {}};
        const std::vector<PlotPoint> ms = medians(points, stage);
        for (const PlotPoint& p : ms) line.points.push_back({p.x, p.y > 0 ? at_one(ms) / p.y : 0});
        plot.lines.push_back(std::move(line));
    }
    const double most = points.back().at;
    plot.lines.push_back({"perfect", {{1, 1}, {most, most}}, true});
    return plot_svg(plot);
}

}  // namespace

Result<std::string> bench_scale(const Options& options) {
    Result<PartFilePtr> svg = open_if_asked(options.study.svg);
    if (!svg) return svg.error();
    const int most = options.threads == 0 ? core_count() : options.threads;
    if (most < 2)
        return Error{
            "bench scale compares numbers of threads, and there is one core: --threads 2 tries two all the "
            "same."};
    if (options.scene.walkers == 0) return Error{"bench scale needs someone to move: --walkers 1 or more."};
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    for (uint32_t i = 0; i < options.warm_up; ++i) {
        if (is_stopping()) return interrupted();
        step(world);
    }
    // The same people go on by other threads, turn by turn, so that a busy neighbour meets all alike. What
    // they do does not depend on it.
    std::vector<StudyPoint> points;
    std::vector<WorkersPtr> workers;
    for (const int threads : thread_points(most)) {
        points.push_back({static_cast<double>(threads), {}});
        workers.push_back(make_workers(threads));
    }
    const uint32_t turns = std::max(options.bench_frames / k_turn, 1u);
    for (uint32_t turn = 0; turn < turns; ++turn) {
        show_progress("turn " + std::to_string(turn + 1) + " of " + std::to_string(turns));
        for (size_t i = 0; i < points.size(); ++i) {
            if (is_stopping()) return interrupted();
            world.workers.swap(workers[i]);
            measure_turn(world, points[i].figures);
            world.workers.swap(workers[i]);
        }
    }
    clear_progress();
    Figures setting;
    setting.setting = {{"city", city_name(options.scene)},
                       {"walkers", world.crowd.count},
                       {"cores", core_count()},
                       {"measured", turns * k_turn}};
    const nlohmann::ordered_json json = tell_scale(points, setting);
    if (*svg) {
        const std::string note = city_name(options.scene) + ", " + short_number(world.crowd.count) +
                                 " walkers; medians of " + std::to_string(turns) + " turns of four ticks.";
        Result<void> kept = write_file(std::move(*svg), scale_svg(points, note));
        if (!kept) return kept.error();
    }
    return json.dump(2) + "\n";
}

}  // namespace flaneur
