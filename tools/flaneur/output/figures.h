// Measured times and what they come to.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

struct Series {
    std::string name;
    std::vector<double> ms;
    std::string within;       // the stage that it is a part of; or empty
    const char* unit = "ms";  // that files have it in: "ms" or "ns"
};

struct Figures {
    std::vector<std::pair<std::string, std::variant<std::string, int64_t>>> setting;  // what was measured
    std::vector<Series> series;  // in order of first appearance
    std::vector<std::pair<std::string, double>> counts;
};

void add_sample(Figures& figures, std::string_view stage, double ms, std::string_view within = {});

// The value that a share of the samples lies at or below, by linear interpolation between the closest ranks;
// share 0.5 is the median. `values` must not be empty.
double quantile(std::vector<double> values, double share);

void print_setting(const Figures& figures);
// As keys of an object.
void put_setting(const Figures& figures, nlohmann::ordered_json& json);

// Parts are indented below what they are parts of. Where there is a "frame", a sentence says what takes most
// of it.
void print_figures(const Figures& figures);
// As Google Benchmark writes its results, so that what reads those reads these: {"context": {..},
// "benchmarks":
// [{"name", .., "real_time", ..}], "counts": {..}}; docs/files.md tells all of it. `command` is what was
// measured, in the words of the command line.
std::string figures_json(const Figures& figures, const std::string& command);

}  // namespace flaneur
