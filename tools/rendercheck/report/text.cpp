#include <array>
#include <cstdio>

#include "tools/rendercheck/report/report.h"

namespace flaneur {
namespace {

std::string seconds(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f s", value);
    return text;
}

std::string told_details(const CaseResult& result) {
    std::string out;
    for (const std::string& detail : result.details)
        if (detail != result.line) out += detail + "\n";
    return out;
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '|') c = ' ';
    return text;
}

std::string indented(const std::string& text) {
    std::string out;
    bool is_start = true;
    for (const char c : text) {
        if (is_start) out += "    ";
        // What a command printed must not steer the terminal.
        out += static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t' ? '?' : c;
        is_start = c == '\n';
    }
    if (!out.empty() && out.back() != '\n') out += '\n';
    return out;
}

}  // namespace

std::string told_case(const CheckReport& report, const CaseResult& result) {
    std::string out = std::string(told_status(result.status)) + " " + result.one->name + " (" +
                      seconds(result.seconds) + ")";
    if (result.status == CaseStatus::passed) {
        for (const PictureResult& picture : result.pictures)
            if (!picture.judgement.is_equal)
                out += ", " + std::to_string(picture.judgement.differing) +
                       " pixels differ within the tolerance";
        return out + "\n";
    }
    out += ": " + result.line + "\n" + indented(told_details(result));
    if (result.status == CaseStatus::failed && !result.log.empty())
        out += indented("It printed:\n" + result.log);
    out += "    By hand: " + result.reproduce + "\n    Again: " + report.command + " --filter " +
           result.one->name + "\n";
    if (result.status == CaseStatus::regression || result.status == CaseStatus::missing)
        out += "    If it is right: " + report.command + " --filter " + result.one->name + " --bless\n";
    return out;
}

std::string told_sum(const std::vector<CaseResult>& results) {
    std::array<size_t, 5> counts{};
    for (const CaseResult& result : results) ++counts[static_cast<size_t>(result.status)];
    std::string out = std::to_string(counts[0]) + " of " + std::to_string(results.size()) + " cases pass";
    const char* joint = "; ";
    constexpr const char* k_words[] = {"", " differ from their references", " are flaky",
                                       " have no reference", " failed"};
    for (size_t n = 1; n < counts.size(); ++n)
        if (counts[n]) out += joint + std::to_string(counts[n]) + k_words[n], joint = ", ";
    return out + ".";
}

std::string junit_report(const CheckReport& report) {
    size_t failures = 0, errors = 0;
    for (const CaseResult& result : *report.results) {
        if (result.status == CaseStatus::failed)
            ++errors;
        else if (result.status != CaseStatus::passed)
            ++failures;
    }
    char time[32];
    std::snprintf(time, sizeof time, "%.3f", report.seconds);
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"" +
                      html_text(report.suite) + "\" tests=\"" + std::to_string(report.results->size()) +
                      "\" failures=\"" + std::to_string(failures) + "\" errors=\"" + std::to_string(errors) +
                      "\" time=\"" + time + "\">\n";
    for (const CaseResult& result : *report.results) {
        std::snprintf(time, sizeof time, "%.3f", result.seconds);
        out += "<testcase classname=\"" + html_text(report.key) + "\" name=\"" + html_text(result.one->name) +
               "\" time=\"" + time + "\"";
        if (result.status == CaseStatus::passed) {
            out += "/>\n";
            continue;
        }
        const char* tag = result.status == CaseStatus::failed ? "error" : "failure";
        out += std::string(">\n<") + tag + " type=\"" + told_status(result.status) + "\" message=\"" +
               html_text(result.line) + "\">" +
               html_text(told_details(result) + "By hand: " + result.reproduce) + "</" + tag + ">\n";
        if (!result.log.empty()) out += "<system-err>" + html_text(result.log) + "</system-err>\n";
        out += "</testcase>\n";
    }
    return out + "</testsuite>\n</testsuites>\n";
}

std::string github_summary(const CheckReport& report) {
    std::string out = "### Render checks: " + told_sum(*report.results) + "\n\n`" + one_line(report.suite) +
                      "`, references of `" + report.key + "`" +
                      (report.device.empty() ? "" : ", drawn by " + one_line(report.device)) + ".\n";
    bool has_table = false;
    for (const CaseResult& result : *report.results) {
        if (result.status == CaseStatus::passed) continue;
        if (!has_table) out += "\n| case | | |\n|---|---|---|\n", has_table = true;
        out += "| " + result.one->name + " | " + told_status(result.status) + " | " +
               one_line(html_text(result.line)) + " |\n";
    }
    return out;
}

std::string github_marks(const CheckReport& report) {
    std::string out;
    for (const CaseResult& result : *report.results)
        if (result.status != CaseStatus::passed)
            out += "::error title=Render check " + result.one->name + "::" + one_line(result.line) + "\n";
    return out;
}

}  // namespace flaneur
