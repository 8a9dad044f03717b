#include "tools/flaneur/validate/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "assets/measures/moments.h"
#include "tools/flaneur/plot/plot.h"

namespace flaneur {
namespace {

// As a cell of a table has it.
std::string cell(std::string_view text) {
    std::string told;
    for (const char c : text) {
        if (c == '|') told.push_back('\\');
        told.push_back(c);
    }
    return told;
}

std::string padded(const std::string& text, size_t width) {
    return text.size() >= width ? text : text + std::string(width - text.size(), ' ');
}

// The means of all moments whose densities lie within the same step.
std::vector<PlotPoint> binned(std::span<const FlowSample> samples) {
    constexpr double k_step = 0.25;
    constexpr size_t k_fewest = 5;
    std::map<int, std::vector<FlowSample>> bins;
    for (const FlowSample& s : samples) bins[static_cast<int>(std::floor(s.density / k_step))].push_back(s);
    std::vector<PlotPoint> points;
    for (const auto& [bin, in] : bins) {
        if (in.size() < k_fewest) continue;
        const MeanFlow mean = mean_of(in);
        points.push_back({mean.density, mean.speed});
    }
    return points;
}

PlotLine weidmann_line(const std::string& name, double times) {
    PlotLine line{name, {}, true};
    for (double density = 0.1; density <= 5.4; density += 0.1)
        line.points.push_back({density, times * weidmann_speed(density)});
    return line;
}

PlotLine measured_line(const Measured& measured) {
    Trajectories tracks = measured.tracks;
    tracks.area = area_or_box(tracks);
    const double first = tracks.sightings.front().frame / static_cast<double>(tracks.fps),
                 last = tracks.sightings.back().frame / static_cast<double>(tracks.fps);
    return {measured.name, binned(flow_samples(tracks, busiest_square(tracks), 0.4, first, last))};
}

}  // namespace

const char* word_of(Validity verdict) { return verdict == Validity::passed ? "passed" : "missed"; }

bool is_passed(const Findings& findings) {
    return std::all_of(findings.begin(), findings.end(),
                       [](const ValidationFinding& f) { return f.verdict == Validity::passed; });
}

std::string told_validation(const Validated& validated) {
    std::string text = std::string(validated.test->id) + ", " + std::string(validated.test->name) + ": " +
                       std::string(validated.test->set_up) + "\n";
    for (const ValidationFinding& f : validated.findings)
        text += "  " + padded(f.what, 44) + " " + padded(f.expected, 34) + " " + padded(f.measured, 28) +
                " " + word_of(f.verdict) + "\n";
    return text;
}

std::string validation_markdown(const std::vector<Validated>& all) {
    std::string text = "| test | set-up | expected | ours | |\n|---|---|---|---|---|\n";
    auto add_row = [&text](std::initializer_list<std::string_view> cells) {
        for (const std::string_view one : cells) text.append("| ").append(cell(one)).append(" ");
        text += "|\n";
    };
    for (const Validated& v : all)
        for (const ValidationFinding& f : v.findings) {
            const bool is_first = &f == v.findings.data();
            add_row({is_first ? v.test->id : "", is_first ? v.test->set_up : "", f.what + ": " + f.expected,
                     f.measured, word_of(f.verdict)});
        }
    return text;
}

std::string validation_json(const std::vector<Validated>& all) {
    nlohmann::ordered_json json;
    json["program"] = "flaneur " FLANEUR_VERSION;
    json["passed"] =
        std::all_of(all.begin(), all.end(), [](const Validated& v) { return is_passed(v.findings); });
    json["tests"] = nlohmann::ordered_json::array();
    for (const Validated& v : all) {
        nlohmann::ordered_json test;
        test["id"] = v.test->id;
        test["name"] = v.test->name;
        test["set_up"] = v.test->set_up;
        test["seconds"] = v.seconds;
        test["findings"] = nlohmann::ordered_json::array();
        for (const ValidationFinding& f : v.findings)
            test["findings"].push_back({{"what", f.what},
                                        {"expected", f.expected},
                                        {"measured", f.measured},
                                        {"verdict", word_of(f.verdict)}});
        json["tests"].push_back(std::move(test));
    }
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string diagram_svg(const ValidationNotes& notes) {
    LinePlot plot{.title = "Speed over density",
                  .note = "Weidmann 1993 with 20 % about it; density and speed by Voronoi cells",
                  .x = {"people / m2"},
                  .y = {"m/s"}};
    plot.lines = {weidmann_line("Weidmann", 1), weidmann_line("+ 20 %", 1.2), weidmann_line("- 20 %", 0.8)};
    PlotLine ours{"flaneur", {}};
    for (const MeanFlow& mean : notes.diagram) ours.points.push_back({mean.density, mean.speed});
    plot.lines.push_back(std::move(ours));
    for (const Measured& measured : notes.measured) plot.lines.push_back(measured_line(measured));
    return plot_svg(plot);
}

}  // namespace flaneur
