#include "tools/flaneur/output/figures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/output/machine.h"

namespace flaneur {

namespace {

struct Column {
    const char* title;
    const char* key;
    double share;
};
constexpr Column k_columns[] = {{"median", "p50", 0.5},
                                {"5 %", "p5", 0.05},
                                {"95 %", "p95", 0.95},
                                {"99 %", "p99", 0.99},
                                {"worst", "worst", 1}};

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

// What all threads worked while the whole of a frame went by; of all else the time is the caller's own.
const std::vector<double>& worked(const Series& series, const Figures& figures) {
    const size_t slash = series.name.rfind('/') + 1;  // npos + 1 is 0
    if (series.name.substr(slash) != "frame") return series.ms;
    const std::string name = series.name.substr(0, slash) + "all threads";
    for (const Series& other : figures.series)
        if (other.name == name) return other.ms;
    return series.ms;
}

nlohmann::ordered_json benchmark_of(const Series& series, const Figures& figures) {
    const double times = std::string_view(series.unit) == "ns" ? 1e6 : 1;
    nlohmann::ordered_json json = {{"name", series.name},
                                   {"run_name", series.name},
                                   {"run_type", "iteration"},
                                   {"repetitions", 1},
                                   {"repetition_index", 0},
                                   {"threads", 1},
                                   {"iterations", series.ms.size()},
                                   {"real_time", times * quantile(series.ms, 0.5)},
                                   {"cpu_time", times * quantile(worked(series, figures), 0.5)},
                                   {"time_unit", series.unit}};
    for (const Column& column : k_columns) json[column.key] = times * quantile(series.ms, column.share);
    json["within"] = series.within;
    for (double ms : series.ms) json["samples"].push_back(times * ms);
    return json;
}

// Two, and more where two would leave nothing of it.
int decimals_of(double value) {
    if (value == std::floor(value)) return 0;
    return std::clamp(1 - static_cast<int>(std::floor(std::log10(std::fabs(value)))), 2, 6);
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
    for (const auto& [name, value] : figures.setting)
        std::visit([&, &key = name](const auto& of) { json[key] = of; }, value);
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
    for (const auto& [name, value] : figures.counts)
        std::printf("%-20s %9.*f\n", name.c_str(), decimals_of(value), value);
}

std::string figures_json(const Figures& figures, const std::string& command) {
    nlohmann::ordered_json json;
    nlohmann::ordered_json& context = json["context"] = machine_context();
    context["command"] = command;
    put_setting(figures, context);
    json["benchmarks"] = nlohmann::ordered_json::array();
    for (const Series& series : figures.series) json["benchmarks"].push_back(benchmark_of(series, figures));
    json["counts"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : figures.counts) json["counts"][name] = value;
    json["counts"]["peak MB"] = peak_megabytes();
    // A path on the command line need not be UTF-8.
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace flaneur
