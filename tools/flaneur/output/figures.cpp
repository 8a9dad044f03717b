#include "tools/flaneur/output/figures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/flaneur/console/console.h"

namespace flaneur {

namespace {

struct Column {
    const char* title;
    const char* key;
    double share;
};
constexpr Column k_columns[] = {{"median", "median_ms", 0.5},
                                {"5 %", "p5_ms", 0.05},
                                {"95 %", "p95_ms", 0.95},
                                {"99 %", "p99_ms", 0.99},
                                {"worst", "worst_ms", 1}};

bool is_listed(const Figures& figures, const std::string& name) {
    return std::any_of(figures.series.begin(), figures.series.end(),
                       [&](const Series& series) { return series.name == name; });
}

void print_parts(const Figures& figures, const std::string& whole, int depth) {
    for (const Series& series : figures.series) {
        const bool is_part = is_listed(figures, series.within);
        if (is_part ? series.within != whole : !whole.empty()) continue;
        std::printf("%*s%-*s", 2 * depth, "", 20 - 2 * depth, series.name.c_str());
        for (const Column& column : k_columns) std::printf(" %9.3f", quantile(series.ms, column.share));
        std::printf("\n");
        print_parts(figures, series.name, depth + 1);
    }
}

// What takes most of a frame, and most of that, as far as it goes.
void print_longest(const Figures& figures) {
    constexpr double k_much = 0.2;  // of a frame
    auto frame = std::find_if(figures.series.begin(), figures.series.end(),
                              [](const Series& series) { return series.name == "frame"; });
    if (frame == figures.series.end()) return;
    const double whole = quantile(frame->ms, 0.5);
    std::string told, within = "frame";
    for (;;) {
        const Series* longest = nullptr;
        for (const Series& series : figures.series)
            if (series.within == within &&
                (!longest || quantile(series.ms, 0.5) > quantile(longest->ms, 0.5)))
                longest = &series;
        const double share = longest ? quantile(longest->ms, 0.5) / whole : 0;
        if (!(share > k_much)) break;
        told.append(told.empty() ? "" : ", of it ").append(longest->name).append(" ");
        told.append(std::to_string(std::lround(100 * share))).append(" %");
        within = longest->name;
    }
    if (!told.empty()) std::printf("\nMost of a frame is %s\n", told.c_str());
}

}  // namespace

void add_sample(Figures& figures, std::string_view stage, double ms, std::string_view within) {
    auto it = std::find_if(figures.series.begin(), figures.series.end(),
                           [&](const Series& series) { return series.name == stage; });
    if (it == figures.series.end())
        it = figures.series.insert(it, {std::string(stage), {}, std::string(within)});
    it->ms.push_back(ms);
}

double quantile(std::vector<double> values, double share) {
    assert(!values.empty());
    std::sort(values.begin(), values.end());
    double rank = share * static_cast<double>(values.size() - 1);
    auto low = static_cast<size_t>(rank);
    size_t high = std::min(low + 1, values.size() - 1);
    return values[low] + (values[high] - values[low]) * (rank - static_cast<double>(low));
}

void print_setting(const Figures& figures) {
    for (const auto& [name, value] : figures.setting) {
        const auto* text = std::get_if<std::string>(&value);
        std::printf("%-20s %s\n", name.c_str(),
                    text ? printable(*text).c_str() : std::to_string(std::get<int64_t>(value)).c_str());
    }
}

void put_setting(const Figures& figures, nlohmann::ordered_json& json) {
    json["setting"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : figures.setting)
        std::visit([&, &key = name](const auto& of) { json["setting"][key] = of; }, value);
}

void print_figures(const Figures& figures) {
    print_setting(figures);
    if (figures.series.empty()) return;
    std::printf("\n%-20s", "stage, ms");
    for (const Column& column : k_columns) std::printf(" %9s", column.title);
    std::printf("\n");
    print_parts(figures, {}, 0);
    print_longest(figures);
    if (!figures.counts.empty()) std::printf("\n");
    for (const auto& [name, value] : figures.counts) std::printf("%-20s %9.0f\n", name.c_str(), value);
}

std::string figures_json(const Figures& figures) {
    nlohmann::ordered_json json;
    put_setting(figures, json);
    json["stages"] = nlohmann::ordered_json::array();
    for (const Series& series : figures.series) {
        nlohmann::ordered_json stage = {{"name", series.name}, {"count", series.ms.size()}};
        for (const Column& column : k_columns) stage[column.key] = quantile(series.ms, column.share);
        json["stages"].push_back(stage);
    }
    json["counts"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : figures.counts) json["counts"][name] = value;
    return json.dump(2) + "\n";
}

}  // namespace flaneur
