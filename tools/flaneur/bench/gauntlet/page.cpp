#include <limits>
#include <set>

#include "tools/flaneur/bench/gauntlet/gauntlet.h"
#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/plot/svg_pieces.h"

namespace flaneur {

namespace {

constexpr const char* k_page_style =
    "body{font:15px/1.45 'Helvetica Neue',Arial,sans-serif;color:#333;max-width:920px;margin:24px "
    "auto;padding:0 12px}"
    "svg{max-width:100%;height:auto;margin:10px 0}table{border-collapse:collapse;font-size:13px}"
    "td,th{padding:2px 12px 2px 0;text-align:left;border-bottom:1px solid #e4e4e4}td.n{text-align:right}";

std::vector<const GauntletRun*> all_of(const GauntletRun& run, std::span<const GauntletRun> others) {
    std::vector<const GauntletRun*> all = {&run};
    for (const GauntletRun& other : others) all.push_back(&other);
    return all;
}

// A line a machine: the score of that name over its sizes.
std::string lines_chart(const char* title, std::string_view part, std::string_view name, const char* across,
                        const std::vector<const GauntletRun*>& all) {
    LinePlot plot{.title = title, .x = {across, true}, .y = {"milliseconds", true}};
    for (const GauntletRun* run : all) {
        PlotLine line{run->machine, {}};
        for (const GauntletScore& score : run->scores)
            if (score.part == part && score.name == name) line.points.push_back({score.size, score.value});
        plot.lines.push_back(std::move(line));
    }
    return plot_svg(plot);
}

std::string bars_chart(const char* title, std::string_view part, const char* unit,
                       const std::vector<const GauntletRun*>& all) {
    BarPlot plot{.title = title, .unit = unit};
    std::set<std::string> known;
    for (const GauntletRun* run : all) plot.columns.push_back(run->machine);
    for (const GauntletRun* owner : all) {
        for (const GauntletScore& score : owner->scores) {
            if (score.part != part || !known.insert(score.name).second) continue;
            BarGroup group{score.name, {}, {}};
            for (const GauntletRun* run : all) {
                const GauntletScore* found = find_score(*run, part, score.name, score.size);
                group.values.push_back(found ? found->value : std::numeric_limits<double>::quiet_NaN());
            }
            plot.groups.push_back(std::move(group));
        }
    }
    return bars_svg(plot);
}

bool has_part(const std::vector<const GauntletRun*>& all, std::string_view part) {
    for (const GauntletRun* run : all)
        for (const GauntletScore& score : run->scores)
            if (score.part == part) return true;
    return false;
}

std::string scores_table(const std::vector<const GauntletRun*>& all) {
    std::string text = "<table><tr><th>part</th><th>of what</th><th>size</th><th>unit</th>";
    for (const GauntletRun* run : all) text += "<th>" + escaped(run->machine) + "</th>";
    text += "</tr>\n";
    for (const GauntletScore& score : all.front()->scores) {
        text += "<tr><td>" + escaped(score.part) + "</td><td>" + escaped(score.name) +
                "</td><td class=\"n\">" + (score.size > 0 ? short_number(score.size) : "") + "</td><td>" +
                escaped(score.unit) + "</td>";
        for (const GauntletRun* run : all) {
            const GauntletScore* found = find_score(*run, score.part, score.name, score.size);
            text += "<td class=\"n\">" + (found ? short_number(found->value) : "") + "</td>";
        }
        text += "</tr>\n";
    }
    return text + "</table>\n";
}

}  // namespace

std::string gauntlet_html(const GauntletRun& run, std::span<const GauntletRun> others) {
    const std::vector<const GauntletRun*> all = all_of(run, others);
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/><title>flaneur bench "
        "gauntlet</title>\n<style>";
    page.append(k_page_style).append("</style></head><body>\n<h1>flaneur bench gauntlet</h1>\n<table>");
    page += "<tr><th>machine</th><th>drawn on</th><th>flaneur</th><th>seconds</th></tr>\n";
    for (const GauntletRun* one : all)
        page += "<tr><td>" + escaped(one->machine) + "</td><td>" + escaped(one->device) + "</td><td>" +
                escaped(one->version) + "</td><td class=\"n\">" + short_number(one->seconds) + "</td></tr>\n";
    page += "</table>\n<p>A " + std::string(run.is_quick ? "quick" : "full") +
            " run. Medians; smaller is better. Times are of machines as they were then: others may have used "
            "them too.</p>\n";
    for (const std::string& note : run.notes) page += "<p>" + escaped(note) + "</p>\n";
    page += bars_chart("From nothing to a city with people", "load", "milliseconds", all);
    page += lines_chart("A tick of the simulation, on all threads", "sim", "tick", "walkers", all);
    page += lines_chart("A tick, its extraction and a picture at 1280x720, street camera", "frame", "street",
                        "walkers", all);
    if (has_part(all, "peers")) {
        page +=
            lines_chart("Copies of one character, with levels of detail", "peers", "with LOD", "copies", all);
        page +=
            lines_chart("Copies of one character, every triangle", "peers", "every triangle", "copies", all);
    }
    page += bars_chart("Kernels that pose people", "pose",
                       "nanoseconds a walker, chain or tree, on one thread", all);
    page += "<h2>All scores</h2>\n" + scores_table(all);
    return page + "</body></html>\n";
}

}  // namespace flaneur
