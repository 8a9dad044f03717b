// What one run of a case left.
#pragma once

#include "tools/rendercheck/check/check.h"

namespace flaneur {

struct RunOutcome {
    std::string problem;  // a sentence about what is wrong with the run itself; "": nothing
    std::vector<std::vector<uint8_t>> files;
    std::vector<CheckedPicture> pictures;
    std::vector<std::optional<std::vector<uint8_t>>> parts;  // files as they are
    std::vector<std::string> legends;
    std::string log;
    int left_over = 0;
    double seconds = 0;
};

// A run's folder and files, as placeholders and plan.
struct PlannedRun {
    std::string dir;
    Placeholders placeholders;
    ProcessPlan process;
};
Result<PlannedRun> plan_run(const Suite& suite, const SuiteCase& one, const std::string& dir);

// Reads them. Never fails: what cannot be read is a problem of the run.
RunOutcome outcome_of(const SuiteCase& one, const PlannedRun& run, const ProcessEnd& end);

// The first line of a log that a validation layer wrote; "": none.
std::string validation_message(const std::string& log);

}  // namespace flaneur
