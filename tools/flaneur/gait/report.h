// What was measured, on paper.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/gait/trials.h"

namespace flaneur {

// The curves by name, for files and pictures; `norm` and `sd` may be missing.
struct NamedCurve {
    const char *name, *title, *unit;
    const Cycle Curves::*curve;
    const Cycle* norm;
    const Cycle* sd;
};
extern const std::vector<NamedCurve> k_named_curves;

int failed_count(const Report& report);

// "<= 4", "14 .. 27", and what was measured, or "none".
std::string bar_text(const Bar& bar);
std::string measured_text(const Verdict& verdict);

// A line for each bar and, with `all`, for each quantity that has none.
void print_report(const Report& report, bool all);

// One row a value: person, trial, quantity, percent of the cycle (curves only), value, norm (curves only),
// low and high of the bar, pass (1, 0 or empty).
std::string reports_csv(const std::vector<Report>& reports);
// {"trials": [{"person"?, "name", "title", "quantities": [{"name", "value", "low"?, "high"?, "stretch"?,
// "source"?, "pass"?}], "curves": {name: [101 values]}}], "norm": {name: [101 values]}}
std::string reports_json(const std::vector<Report>& reports);

// The joint curves of steady walking over the norm's bands, a panel a joint.
std::string curves_svg(const Report& report);

}  // namespace flaneur
