#include "tools/flaneur/bench/compare.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/output/figures.h"

namespace flaneur {
namespace {

constexpr size_t k_largest_file = 256 << 20;
constexpr double k_chance = 0.01;  // that anything is called slower that is not
constexpr const char* k_so_what = "Nothing is compared";
constexpr double k_small = 0.01;  // of the longest

// Of the context; what differs between any two runs.
constexpr const char* k_of_the_moment[] = {"date",        "load_avg",        "caches",
                                           "mhz_per_cpu", "commit",          "command",
                                           "first frame", "library_version", "cpu_scaling_enabled"};

constexpr size_t k_most_depth = 32, k_most_values = 20'000'000;

std::string text_of(const nlohmann::json& one, const char* key, const char* usual) {
    return one.contains(key) && one[key].is_string() ? one[key].get<std::string>() : usual;
}

double ms_of(const std::string& unit) {
    return unit == "ns" ? 1e-6 : unit == "us" ? 1e-3 : unit == "s" ? 1e3 : 1;
}

BenchTimes& times_of(BenchFile& file, const std::string& name) {
    for (BenchTimes& times : file.times)
        if (times.name == name) return times;
    return file.times.emplace_back(BenchTimes{name, {}});
}

const BenchTimes* find_times(const BenchFile& file, const std::string& name) {
    for (const BenchTimes& times : file.times)
        if (times.name == name) return &times;
    return nullptr;
}

std::string told(double ms) {
    char text[32];
    if (ms >= 0.1)
        std::snprintf(text, sizeof text, "%.3f ms", ms);
    else if (ms >= 1e-3)
        std::snprintf(text, sizeof text, "%.3f us", ms * 1e3);
    else
        std::snprintf(text, sizeof text, "%.1f ns", ms * 1e6);
    return ms > 0 ? text : "";
}

void print_settings(const BenchFile& before, const BenchFile& after) {
    for (const auto& [name, value] : after.setting)
        for (const auto& [other, was] : before.setting)
            if (name == other && value != was)
                std::printf("%s was %s before and is %s after: they may not compare.\n",
                            printable(name).c_str(), printable(was).c_str(), printable(value).c_str());
}

void print_row(const Compared& c) {
    std::printf("%-32s %12s %12s", printable(c.name).c_str(), told(c.before_ms).c_str(),
                told(c.after_ms).c_str());
    if (c.before_ms > 0 && c.after_ms > 0)
        std::printf(" %7.3f  %5.3f..%5.3f %8.4f", c.difference.ratio, c.difference.low, c.difference.high,
                    c.difference.p);
    else
        std::printf(" %7s  %12s %8s", "", "", "");
    std::printf("  %s\n", k_verdict_words[static_cast<size_t>(c.verdict)]);
}

BenchVerdict judge(const Difference& d, bool is_beyond_chance, double tolerance) {
    if (!d.is_enough) return BenchVerdict::unsure;
    if (!is_beyond_chance) return BenchVerdict::same;
    if (d.ratio > 1 && d.high >= 1 + tolerance) return BenchVerdict::slower;
    if (d.ratio < 1 && d.low <= 1 / (1 + tolerance)) return BenchVerdict::faster;
    return BenchVerdict::same;
}

}  // namespace

Result<BenchFile> parse_bench_file(std::string_view text) {
    if (Result<void> sound = check_json(text, k_most_depth, k_most_values); !sound) return sound.error();
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("benchmarks") || !json["benchmarks"].is_array())
        return Error{"has no \"benchmarks\", as files of `flaneur bench --json` have"};
    BenchFile file;
    if (json.contains("context") && json["context"].is_object())
        for (const auto& [name, value] : json["context"].items())
            if (std::find(std::begin(k_of_the_moment), std::end(k_of_the_moment), name) ==
                std::end(k_of_the_moment))
                file.setting.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
    for (const nlohmann::json& one : json["benchmarks"]) {
        const bool is_sound = one.is_object() && one.contains("name") && one["name"].is_string() &&
                              one.contains("real_time") && one["real_time"].is_number();
        if (!is_sound) return Error{"has a benchmark without \"name\" or \"real_time\""};
        if (text_of(one, "run_type", "iteration") != "iteration") continue;  // what others sum up
        const double unit = ms_of(text_of(one, "time_unit", "ns"));
        BenchTimes& times = times_of(file, one["name"].get<std::string>());
        if (!one.contains("samples")) {
            times.ms.push_back(unit * one["real_time"].get<double>());
            continue;
        }
        for (const nlohmann::json& sample : one["samples"]) {
            if (!sample.is_number())
                return Error{"has a sample of " + excerpt(times.name) + " that is no number"};
            times.ms.push_back(unit * sample.get<double>());
        }
    }
    std::erase_if(file.times, [](const BenchTimes& times) { return times.ms.empty(); });
    return file;
}

std::vector<Compared> compare_times(const BenchFile& before, const BenchFile& after,
                                    double tolerance_percent) {
    std::vector<Compared> all;
    double longest = 0;
    for (const BenchTimes& was : before.times) {
        Compared& c = all.emplace_back();
        c.name = was.name;
        c.before_ms = quantile(was.ms, 0.5);
        c.verdict = BenchVerdict::gone;
        const BenchTimes* const is = find_times(after, was.name);
        if (!is) continue;
        c.after_ms = quantile(is->ms, 0.5);
        c.difference = difference_of(was.ms, is->ms);
        c.verdict = BenchVerdict::same;
        longest = std::max({longest, c.before_ms, c.after_ms});
    }
    for (const BenchTimes& is : after.times)
        if (!find_times(before, is.name))
            all.push_back({is.name, 0, quantile(is.ms, 0.5), {}, BenchVerdict::added});
    std::vector<Compared*> judged;
    for (Compared& c : all) {
        if (c.verdict != BenchVerdict::same) continue;
        if (std::max(c.before_ms, c.after_ms) < k_small * longest)
            c.verdict = BenchVerdict::small;
        else
            judged.push_back(&c);
    }
    std::sort(judged.begin(), judged.end(),
              [](const Compared* a, const Compared* b) { return a->difference.p < b->difference.p; });
    bool is_beyond_chance = true;
    for (size_t i = 0; i < judged.size(); ++i) {
        const Difference& d = judged[i]->difference;
        is_beyond_chance &= d.p * static_cast<double>(judged.size() - i) < k_chance;
        judged[i]->verdict = judge(d, is_beyond_chance, tolerance_percent / 100);
    }
    return all;
}

Result<void> bench_compare(const std::string& before, const std::string& after, double tolerance_percent) {
    const Result<BenchFile> was = read_parsed<BenchFile>(before, k_largest_file, parse_bench_file, k_so_what);
    if (!was) return was.error();
    const Result<BenchFile> is = read_parsed<BenchFile>(after, k_largest_file, parse_bench_file, k_so_what);
    if (!is) return is.error();
    const std::vector<Compared> all = compare_times(*was, *is, tolerance_percent);
    print_settings(*was, *is);
    std::printf("%-32s %12s %12s %7s  %12s %8s\n", "", "before", "after", "ratio", "99 %", "chance");
    std::string slower;
    size_t judged = 0;
    for (const Compared& c : all) {
        print_row(c);
        judged += c.verdict < BenchVerdict::unsure;
        if (c.verdict != BenchVerdict::slower) continue;
        char text[32];
        std::snprintf(text, sizeof text, " %.1f %%", 100 * (c.difference.ratio - 1));
        slower.append(slower.empty() ? "" : ", ").append(c.name).append(text);
    }
    if (!slower.empty())
        return Error{after + " is slower than " + before + ": " + slower +
                     ". Measure both again, in turns, to be sure."};
    if (judged == 0)
        return Error{"Nothing can be told: the two have nothing in common of which each has " +
                     std::to_string(k_least_samples) + " samples or more. Measure more --frames."};
    std::printf("Nothing is slower by %g %% or more.\n", tolerance_percent);
    return {};
}

}  // namespace flaneur
