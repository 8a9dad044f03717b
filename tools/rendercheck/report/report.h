// What is told of the results of a suite: on a terminal, to CI, and as a page to look at.
#pragma once

#include <string>
#include <vector>

#include "tools/rendercheck/check/check.h"

namespace flaneur {

struct CheckReport {
    std::string suite;    // as it was named
    std::string key;      // of the references
    std::string device;   // that drew; "": not known
    std::string command;  // runs one case again: "rendercheck run suite.json --filter CASE" follows from it
    const std::vector<CaseResult>* results = nullptr;
    double seconds = 0;
};

// A case as it ends: one line where it passed, and all that is known where it did not.
std::string told_case(const CheckReport& report, const CaseResult& result);

// "38 of 40 cases pass; 1 regression, 1 flaky."
std::string told_sum(const std::vector<CaseResult>& results);

// JUnit's XML, as CI systems read it.
std::string junit_report(const CheckReport& report);

// Markdown for a summary of GitHub Actions, and the lines that mark failures there.
std::string github_summary(const CheckReport& report);
std::string github_marks(const CheckReport& report);

// One file that needs no other: new picture, reference, difference and FLIP side by side, with a slider,
// blinking and a zoom that goes over all, the worst case first.
std::string html_report(const CheckReport& report);

// A difference as a picture: black where there is none, and light where it is; small ones can be seen.
std::vector<uint8_t> difference_picture(const std::vector<float>& differences);
// FLIP's errors as colours of magma, from black to white.
std::vector<uint8_t> flip_picture(const std::vector<float>& errors);

std::string html_text(const std::string& text);

}  // namespace flaneur
