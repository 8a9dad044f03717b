// A fixed score of loads that every machine can play, so that machines can be told apart: what it measures,
// as a file, as a page beside other machines', and beside what the project aims at.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// One measured value; smaller is better, but in gait, where people have bars.
struct GauntletScore {
    std::string part;  // load, sim, frame, peers, pose or gait
    std::string name;  // of what: "tick", "core, avx2"
    double size = 0;   // walkers or copies; 0: none
    double value = 0;
    std::string unit;                           // "ms", "ns"; empty: a count or a share
    std::optional<double> low = {}, high = {};  // that a walk is to keep within
};

struct GauntletRun {
    std::string machine;  // a name for charts: the CPU and its cores
    std::string device;   // that drew; empty: none
    std::string version;  // of this program
    bool is_quick = false;
    double seconds = 0;              // that it took
    std::vector<std::string> notes;  // what was left out, and why
    std::vector<GauntletScore> scores;
};

// {"gauntlet": 1, "machine", "device", "version", "kind": "full" or "quick", "seconds", "notes", "scores":
// [{"part", "name", "size"?, "value", "unit", "low"?, "high"?}]}
std::string run_json(const GauntletRun& run);
// The same back. Refuses, in a sentence, what is none.
Result<GauntletRun> read_run(std::string_view json);
// Those of a folder's .json files that are of the same kind, by name. `notes` gets those that are not.
Result<std::vector<GauntletRun>> read_others(const std::string& folder, bool is_quick,
                                             std::vector<std::string>& notes);

// The value of that score; null: it was not measured.
const GauntletScore* find_score(const GauntletRun& run, std::string_view part, std::string_view name,
                                double size);

// A page on its own: charts, and a table of all scores, of this run and of others beside it.
std::string gauntlet_html(const GauntletRun& run, std::span<const GauntletRun> others);

// Something that the project aims at, in goals.cpp.
struct Goal {
    const char* topic;  // the section that it is told in
    const char* what;
    const char *part, *name;  // of the score that it is about
    double size;
    double most;      // that reaches it
    const char* why;  // it may be missed, a sentence
};
std::span<const Goal> all_goals();
// docs/performance.md: every goal beside what this run measured.
std::string goals_markdown(const GauntletRun& run);

// Runs the whole score, with progress on stderr; prints its scores and gives run_json().
Result<std::string> bench_gauntlet(const Options& options);

}  // namespace flaneur
