#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/pose/bare.h"
#include "sim/pose/cane.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pram.h"
#include "tools/flaneur/bench/study/study.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/plot/svg_pieces.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#include "tools/rendercheck/verdict/flip.h"

namespace flaneur {

namespace {

constexpr int k_posings = 24;  // rounds in which techniques take turns
constexpr int k_posed_at_once = 8;

// Something that a picture is drawn without.
struct Ablation {
    const char *name, *what;
    void (*leave_out)(FrameInput& frame);
    bool poses_everybody = false;  // the picture needs joints that a whole one does without
};
constexpr Ablation k_ablations[] = {
    {"shadows", "nothing throws shadows", [](FrameInput& f) { f.without.shadows = true; }},
    {"smoothing", "edges stay jagged", [](FrameInput& f) { f.without.smoothing = true; }},
    {"contacts", "the ground below people is not darkened", [](FrameInput& f) { f.without.contacts = true; }},
    {"levels", "everybody is drawn by the finest mesh", [](FrameInput& f) { f.is_finest = true; }, true},
    {"impostors", "everybody is a mesh, if a coarse one", [](FrameInput& f) { f.without.impostors = true; },
     true},
    {"occlusion", "what walls hide is drawn too", [](FrameInput& f) { f.skips_hidden = false; }},
    {"lamps", "lamps and windows are dark", [](FrameInput& f) { f.without.lamps = true; }}};

struct AblationRow {
    std::string name, what;
    double cost = 0;           // how much longer the whole takes: ms a picture, or ns a walker
    double low = 0, high = 0;  // the quarter of the pairs below and above
    double work = 0;           // how much more all threads do, ms; of techniques it is `cost`
    double flip = 0;
};

struct Taken {
    Image image;
    double ms = 0, work_ms = 0;  // extraction and drawing: time that goes by, and of all threads
};

// A picture of the show as it is. `ablation` may be null.
Result<Taken> take(Show& show, const Options& options, const Camera& camera, const Ablation* ablation) {
    auto start = std::chrono::steady_clock::now();
    double work_start = cpu_ms();
    FrameInput frame = extract_frame(show, camera, options.scene.size, 1);
    if (ablation && ablation->poses_everybody) {
        work_start = cpu_ms();
        start = std::chrono::steady_clock::now();  // in place of the extraction that it needs no more
        extract_people(*show.loaded.world, show.loaded.characters, show.people, 1);
        frame.walkers = show.people.walkers;
        frame.palette = show.people.palette;
        frame.grounds = show.people.grounds;
    }
    if (ablation) ablation->leave_out(frame);
    Result<Image> image = draw_image(*show.renderer, frame, static_cast<uint32_t>(options.scene.size.width),
                                     static_cast<uint32_t>(options.scene.size.height));
    if (!image) return image.error();
    return Taken{std::move(*image), ms_since(start), cpu_ms() - work_start};
}

// The second of two pictures, a tick apart: the first redraws what the picture before left in maps of
// shadows.
Result<Taken> timed(Show& show, const Options& options, const Camera& camera, const Ablation* ablation) {
    step(show);
    Result<Taken> first = take(show, options, camera, ablation);
    if (!first) return first;
    step(show);
    return take(show, options, camera, ablation);
}

AblationRow row_of(const char* name, const char* what, const std::vector<double>& costs) {
    return {name, what, quantile(costs, 0.5), quantile(costs, 0.25), quantile(costs, 0.75), 0, 0};
}

// Whole pictures and pictures without something take turns, each beside its own.
Result<std::vector<AblationRow>> ablate_pictures(Show& show, const Options& options, const Camera& camera,
                                                 std::vector<double>& whole) {
    std::vector<const Ablation*> ablations;
    for (const Ablation& ablation : k_ablations)
        if (std::string_view(ablation.name) != "lamps" || show.has_lamps) ablations.push_back(&ablation);
    std::vector<std::vector<double>> costs(ablations.size()), work(ablations.size());
    for (uint32_t round = 0; round < options.bench_frames; ++round) {
        show_progress("round " + std::to_string(round + 1) + " of " + std::to_string(options.bench_frames));
        for (size_t i = 0; i < ablations.size(); ++i) {
            if (is_stopping()) return interrupted();
            const Result<Taken> all = timed(show, options, camera, nullptr);
            if (!all) return all.error();
            const Result<Taken> without = timed(show, options, camera, ablations[i]);
            if (!without) return without.error();
            whole.push_back(all->ms);
            costs[i].push_back(all->ms - without->ms);
            work[i].push_back(all->work_ms - without->work_ms);
        }
    }
    std::vector<AblationRow> rows;
    Result<Taken> before = take(show, options, camera, nullptr);
    if (!before) return before.error();
    for (size_t i = 0; i < ablations.size(); ++i) {
        rows.push_back(row_of(ablations[i]->name, ablations[i]->what, costs[i]));
        rows.back().work = quantile(work[i], 0.5);
        Result<Taken> after = take(show, options, camera, ablations[i]);
        if (!after) return after.error();
        rows.back().flip = mean_flip(before->image.rgba, after->image.rgba, options.scene.size.width);
    }
    return rows;
}

// Everybody is posed by these techniques alone; what that takes of one thread's time, nanoseconds a walker.
double posing_ns(const World& w, Techniques on, std::vector<PoseBlock>& poses) {
    const double start = cpu_ms();
    for (int i = 0; i < k_posed_at_once; ++i) {
        pose_bare(w.gait, 0, poses.size(), on, w.poses, poses);
        if (on.limits) restrain_legs(w.gait, 0, poses.size(), k_tick, w.previous_poses, poses);
        if (on.idles) apply_plays(w.idles, 0, w.idles.plays.size(), poses);
        if (on.canes) hold_canes(w.gait, 0, w.gait.canes.size(), poses);
        if (on.prams) hold_prams(w.gait, 0, w.gait.prams.size(), poses);
    }
    return 1e6 * (cpu_ms() - start) / k_posed_at_once / w.crowd.count;
}

Result<std::vector<AblationRow>> ablate_techniques(Show& show, const Options& options, const Camera& camera,
                                                   double& whole_ns) {
    const World& world = *show.loaded.world;
    std::vector<PoseBlock> poses = world.poses;
    std::vector<std::vector<double>> costs(k_techniques.size());
    std::vector<double> whole;
    for (int round = 0; round < k_posings; ++round) {
        for (size_t i = 0; i < k_techniques.size(); ++i) {
            Techniques on;
            on.*k_techniques[i].is_on = false;
            const double all = posing_ns(world, {}, poses);
            whole.push_back(all);
            costs[i].push_back(all - posing_ns(world, on, poses));
        }
    }
    whole_ns = quantile(whole, 0.5);
    std::vector<AblationRow> rows;
    Result<Taken> before = take(show, options, camera, nullptr);
    if (!before) return before.error();
    for (size_t i = 0; i < k_techniques.size(); ++i) {
        if (is_stopping()) return interrupted();
        show_progress("without " + std::string(k_techniques[i].name));
        rows.push_back(row_of(k_techniques[i].name.data(), k_techniques[i].without.data(), costs[i]));
        rows.back().work = rows.back().cost;
        show.without.on = {};
        show.without.on.*k_techniques[i].is_on = false;
        Result<Taken> after = take(show, options, camera, nullptr);
        show.without.on = {};
        if (!after) return after.error();
        rows.back().flip = mean_flip(before->image.rgba, after->image.rgba, options.scene.size.width);
    }
    return rows;
}

void tell_rows(const std::vector<AblationRow>& rows, const char* unit, nlohmann::ordered_json& json) {
    std::printf("\n%-22s %9s %19s %12s %9s\n", (std::string("without, ") + unit).c_str(), "costs",
                "half of the pairs", "all threads", "mean FLIP");
    for (const AblationRow& row : rows) {
        std::printf("%-22s %9.2f %8.2f .. %7.2f %12.2f %9.4f\n", row.name.c_str(), row.cost, row.low,
                    row.high, row.work, row.flip);
        json.push_back({{"name", row.name},
                        {"unit", unit},
                        {"costs", row.cost},
                        {"from", row.low},
                        {"to", row.high},
                        {"all_threads", row.work},
                        {"mean_flip", row.flip}});
    }
}

std::string rows_svg(const char* title, const std::string& note, const char* unit,
                     const std::vector<AblationRow>& rows) {
    BarPlot plot{.title = title, .note = note, .unit = unit};
    const bool has_time = rows.front().cost != rows.front().work;
    if (has_time) plot.columns = {"work of all threads", "time that goes by"};
    for (const AblationRow& row : rows)
        plot.groups.push_back(
            {row.name, has_time ? std::vector<double>{row.work, row.cost} : std::vector<double>{row.cost},
             printed("FLIP %.4f", row.flip)});
    return bars_svg(plot);
}

}  // namespace

Result<std::string> bench_ablate(const Options& options) {
    Result<PartFilePtr> svg = open_if_asked(options.study.svg);
    if (!svg) return svg.error();
    if (options.scene.walkers == 0) return Error{"bench ablate needs someone to draw: --walkers 1 or more."};
    std::atomic<uint32_t> messages = 0;
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    Result<Show> show = make_show(std::move(*renderer), options);
    if (!show) return show.error();
    for (uint32_t i = 0; i < options.warm_up; ++i) step(*show->loaded.world);
    const Camera camera =
        choose_camera(*show, options.scene.camera, options.scene.fov, options.scene.size, 1);
    std::vector<double> whole;
    Result<std::vector<AblationRow>> pictures = ablate_pictures(*show, options, camera, whole);
    if (!pictures) return pictures.error();
    double whole_ns = 0;
    Result<std::vector<AblationRow>> techniques = ablate_techniques(*show, options, camera, whole_ns);
    if (!techniques) return techniques.error();
    clear_progress();
    if (Result<void> quiet = check_messages(messages); !quiet) return quiet.error();

    Figures figures;
    figures.setting = {
        {"city", city_name(options.scene)},
        {"walkers", show->loaded.world->crowd.count},
        {"device", device_name(*show->renderer)},
        {"quality", quality_name(*show->renderer)},
        {"size", std::to_string(options.scene.size.width) + "x" + std::to_string(options.scene.size.height)},
        {"measured", options.bench_frames}};
    nlohmann::ordered_json json;
    print_setting(figures);
    put_setting(figures, json["setting"]);
    json["picture_ms"] = quantile(whole, 0.5);
    json["posing_ns"] = whole_ns;
    std::printf(
        "\nA whole picture, without its tick, takes %.2f ms; to pose a walker with all techniques %.0f ns.\n",
        quantile(whole, 0.5), whole_ns);
    tell_rows(*pictures, "ms a picture", json["ablations"]);
    if (!show->has_lamps) std::printf("%-20s %s\n", "lamps", "are not lit: --time 22:00");
    tell_rows(*techniques, "ns a walker", json["ablations"]);
    if (*svg) {
        const std::string note =
            city_name(options.scene) + ", " + short_number(show->loaded.world->crowd.count) + " walkers. ";
        const std::string chart =
            stacked({rows_svg("What each costs a picture",
                              note + "A whole one takes " + short_number(quantile(whole, 0.5)) + " ms.",
                              "milliseconds that it costs; below 0 it saves more than it costs", *pictures),
                     rows_svg("What each technique costs when bodies are posed",
                              note + "All together take " + short_number(whole_ns) + " ns.",
                              "nanoseconds a walker, on one thread", *techniques)});
        if (Result<void> kept = write_file(std::move(*svg), chart); !kept) return kept.error();
    }
    return json.dump(2) + "\n";
}

}  // namespace flaneur
