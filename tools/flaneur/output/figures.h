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
    std::string within;  // the stage that it is a part of; or empty
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
// Sets json["setting"].
void put_setting(const Figures& figures, nlohmann::ordered_json& json);

// Parts are indented below what they are parts of. Where there is a "frame", a sentence says what takes most
// of it.
void print_figures(const Figures& figures);
// {"setting": {..}, "stages": [{"name", "count", "median_ms", "p5_ms", "p95_ms", "p99_ms", "worst_ms"}],
// "counts": {..}}
std::string figures_json(const Figures& figures);

}  // namespace flaneur
