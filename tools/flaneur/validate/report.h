// What was validated, as a table for a terminal, as Markdown, JSON and a chart.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/validate/tests.h"

namespace flaneur {

struct Validated {
    const ValidationTest* test = nullptr;
    Findings findings;
    double seconds = 0;  // it took
};

const char* word_of(Validity verdict);
bool is_passed(const Findings& findings);

std::string told_validation(const Validated& validated);
std::string validation_markdown(const std::vector<Validated>& all);
std::string validation_json(const std::vector<Validated>& all);
// Speed over density: ours, Weidmann's curve with 20 % about it, and what was measured.
std::string diagram_svg(const ValidationNotes& notes);

}  // namespace flaneur
