#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "assets/files/words.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/validate/report.h"

namespace flaneur {
namespace {

bool is_chosen(const ValidateOptions& options, const ValidationTest& test) {
    if (!options.tests.empty())
        return std::find(options.tests.begin(), options.tests.end(), test.id) != options.tests.end();
    return test.run != test_rerun || !options.measured.empty();
}

Result<void> check_chosen(const ValidateOptions& options) {
    std::vector<std::string> ids;
    for (const ValidationTest& test : validation_tests()) ids.emplace_back(test.id);
    for (const std::string& name : options.tests)
        if (std::find(ids.begin(), ids.end(), name) == ids.end())
            return Error{"There is no test " + name + ": " + joined(ids) + " are there."};
    if (!options.svg.empty() && !options.tests.empty() &&
        std::find(options.tests.begin(), options.tests.end(), "R4") == options.tests.end())
        return Error{"--svg draws what R4 measures: leave R4 in, or --svg out."};
    if (std::find(options.tests.begin(), options.tests.end(), "BI") != options.tests.end() &&
        options.measured.empty())
        return Error{"BI walks a measured corridor again: say which, with --measured FILE."};
    return {};
}

}  // namespace

Result<void> run_validate(const Options& options) {
    const ValidateOptions& validate = options.validation;
    if (validate.list) {
        for (const ValidationTest& test : validation_tests())
            std::printf("%-5s %s: %s\n", std::string(test.id).c_str(), std::string(test.name).c_str(),
                        std::string(test.set_up).c_str());
        return {};
    }
    if (Result<void> chosen = check_chosen(validate); !chosen) return chosen;
    ValidationNotes notes;
    for (const std::string& path : validate.measured) {
        Result<Trajectories> tracks = read_trajectories(path);
        if (!tracks) return tracks.error();
        notes.measured.push_back(
            {printable(std::filesystem::path(path).filename().string()), std::move(*tracks)});
    }
    Result<PartFilePtr> json = open_if_asked(options.json);
    if (!json) return json.error();
    Result<PartFilePtr> markdown = open_if_asked(validate.markdown);
    if (!markdown) return markdown.error();
    Result<PartFilePtr> svg = open_if_asked(validate.svg);
    if (!svg) return svg.error();

    std::vector<Validated> all;
    size_t missed = 0;
    for (const ValidationTest& test : validation_tests()) {
        if (!is_chosen(validate, test)) continue;
        show_progress("validating, " + std::string(test.id) + ", " + std::string(test.name));
        const auto start = std::chrono::steady_clock::now();
        Result<Findings> findings = test.run(notes);
        if (!findings) return findings.error();
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        all.push_back({&test, std::move(*findings), spent.count()});
        clear_progress();
        std::fputs(told_validation(all.back()).c_str(), stdout);
        std::fflush(stdout);
        missed += !is_passed(all.back().findings);
    }
    if (*json)
        if (Result<void> kept = write_file(std::move(*json), validation_json(all)); !kept) return kept;
    if (*markdown)
        if (Result<void> kept = write_file(std::move(*markdown), validation_markdown(all)); !kept)
            return kept;
    if (*svg)
        if (Result<void> kept = write_file(std::move(*svg), diagram_svg(notes)); !kept) return kept;
    if (missed == 0) return {};
    return Error{std::to_string(missed) + " of " + std::to_string(all.size()) +
                 " tests are not passed; the lines above say in what."};
}

}  // namespace flaneur
