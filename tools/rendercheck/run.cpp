#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "assets/files/words.h"
#include "tools/flaneur/options/shell_words.h"
#include "tools/flaneur/options/spelling.h"
#include "tools/rendercheck/commands.h"
#include "tools/rendercheck/files/disk.h"
#include "tools/rendercheck/files/scratch.h"
#include "tools/rendercheck/references/device.h"
#include "tools/rendercheck/references/references.h"
#include "tools/rendercheck/report/report.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

std::atomic<int> stopped_by = 0;

// Which references, and which device drew: that is asked for only where it matters.
struct WhichReferences {
    std::string key, device;
    int exit_code = 0;
    std::string message;
};

WhichReferences which_references(const CheckOptions& options, const Suite& suite) {
    WhichReferences out{options.references.empty() ? suite.key : options.references, "", 0, ""};
    if (!out.key.empty() && options.required_device.empty() && suite.device.empty()) return out;
    Result<std::vector<VulkanDriver>> drivers = ask_drivers(own_program(), suite.env);
    Result<VulkanDriver> driver = drivers ? choose_driver(*drivers, suite.device) : drivers.error();
    if (!driver) return {"", "", k_exit_device, driver.error().message};
    out.device = driver->device + ", " + driver->info;
    if (out.key.empty()) out.key = driver->key;
    if (!options.required_device.empty())
        if (Result<VulkanDriver> required = choose_driver({*driver}, options.required_device); !required)
            return {"", "", k_exit_device,
                    "The device is " + driver->device + ", and --require-device says " +
                        options.required_device +
                        ": VK_DRIVER_FILES chooses drivers, and \"device\" in the suite a device."};
    return out;
}

int exit_code(const std::vector<CaseResult>& results) {
    int code = k_exit_passed;
    auto rank = [](int one) {
        return one == k_exit_failed ? 3 : one == k_exit_regression ? 2 : one == k_exit_missing ? 1 : 0;
    };
    for (const CaseResult& result : results) {
        const int one = result.status == CaseStatus::failed    ? k_exit_failed
                        : result.status == CaseStatus::missing ? k_exit_missing
                        : result.status == CaseStatus::passed  ? k_exit_passed
                                                               : k_exit_regression;
        if (rank(one) > rank(code)) code = one;
    }
    return code;
}

Result<void> write_reports(const CheckOptions& options, const CheckReport& report) {
    if (!options.html.empty())
        if (Result<void> written = write_whole(options.html, html_report(report)); !written) return written;
    if (!options.junit.empty())
        if (Result<void> written = write_whole(options.junit, junit_report(report)); !written) return written;
    if (!options.is_github) return {};
    std::fputs(github_marks(report).c_str(), stdout);
    const std::string summary = github_summary(report);
    const char* file = std::getenv("GITHUB_STEP_SUMMARY");
    if (!file || !*file) {
        std::fputs(summary.c_str(), stdout);
        return {};
    }
    FILE* to = std::fopen(file, "a");
    if (!to) return Error{std::string("Cannot write ") + file + ", which GITHUB_STEP_SUMMARY names."};
    std::fputs(summary.c_str(), to);
    return std::fclose(to) == 0 ? Result<void>{} : Error{std::string("Cannot write ") + file + "."};
}

// Who else there are references of, where there are none of ours.
std::string told_others(const std::vector<std::string>& keys) {
    return "There are references of " + joined(keys) + ", and none of this device: ";
}

int bless_all(const std::vector<CaseResult>& results) {
    int pictures = 0;
    std::vector<std::string> left;
    for (const CaseResult& result : results) {
        Result<int> blessed = bless(result);
        if (!blessed) return fail_with(k_exit_failed, blessed.error().message);
        pictures += *blessed;
        if (result.status == CaseStatus::flaky || result.status == CaseStatus::failed)
            left.push_back(result.one->name);
    }
    std::printf(
        "Blessed %d pictures.%s\n", pictures,
        left.empty()
            ? ""
            : (" Not " + joined(left) + ": what failed or differs from itself is no reference.").c_str());
    if (left.empty()) return k_exit_passed;
    return exit_code(results) == k_exit_failed ? k_exit_failed : k_exit_regression;
}

std::string again(const CheckOptions& options) {
    std::vector<std::string> words{"rendercheck", "run", options.suite};
    for (const std::string& program : options.programs) words.insert(words.end(), {"--program", program});
    return shell_line(words);
}

}  // namespace

int fail_with(int code, const std::string& message) {
    std::fprintf(stderr, "rendercheck: %s\n", message.c_str());
    return code;
}

std::string own_program() {
    std::error_code failed;
    const fs::path path = fs::read_symlink("/proc/self/exe", failed);
    return failed ? "rendercheck" : path.string();
}

Result<Suite> load_with_programs(const CheckOptions& options) {
    Result<Suite> suite = load_suite(options.suite);
    if (!suite) return suite;
    std::vector<std::string> known;
    for (const auto& [name, path] : suite->programs) known.push_back(name);
    for (const std::string& program : options.programs) {
        const size_t equals = program.find('=');
        if (equals == std::string::npos || equals + 1 == program.size())
            return Error{"--program " + program + " is not NAME=PATH, as flaneur=build/flaneur."};
        const std::string name = program.substr(0, equals), path = program.substr(equals + 1);
        if (!suite->programs.contains(name))
            return Error{"--program " + name + ": the suite has no such program." +
                         did_you_mean(name, known)};
        std::error_code failed;
        suite->programs[name] = path.find('/') == std::string::npos && !fs::exists(path, failed)
                                    ? path
                                    : fs::absolute(path, failed).string();
    }
    return suite;
}

int run_suite(const CheckOptions& options) {
    Result<Suite> suite = load_with_programs(options);
    if (!suite) return fail_with(k_exit_usage, suite.error().message);
    CheckPlan plan;
    plan.suite = &*suite;
    for (const SuiteCase& one : suite->cases) {
        if (!is_chosen(one, options.filter)) continue;
        plan.cases.push_back(&one);
        if (Result<void> checked = check_filled(*suite, one); !checked)
            return fail_with(k_exit_usage, options.suite + ": " + checked.error().message);
    }
    if (plan.cases.empty()) {
        std::vector<std::string> names;
        for (const SuiteCase& one : suite->cases) names.push_back(one.name);
        return fail_with(k_exit_usage, "--filter " + options.filter + " leaves no case of " +
                                           std::to_string(names.size()) + "." +
                                           did_you_mean(options.filter, names));
    }
    const WhichReferences which = which_references(options, *suite);
    if (which.exit_code) return fail_with(which.exit_code, which.message);
    plan.golden = golden_folder(*suite), plan.key = which.key;
    const std::vector<std::string> keys = keys_in(plan.golden);
    const bool is_foreign = !keys.empty() && std::find(keys.begin(), keys.end(), plan.key) == keys.end();
    if (options.blesses && is_foreign && !options.forces)
        return fail_with(k_exit_device,
                         told_others(keys) + "--force blesses references of " + plan.key + " beside them.");

    ScratchFolder scratch;
    if (options.keep.empty()) {
        Result<ScratchFolder> made = make_scratch();
        if (!made) return fail_with(k_exit_failed, made.error().message);
        scratch = std::move(*made);
        plan.scratch = scratch.path;
    } else {
        std::error_code failed;
        plan.scratch = fs::absolute(options.keep, failed).string();
        plan.keeps = true;
    }
    plan.jobs = options.jobs, plan.runs = options.runs;
    plan.should_stop = [] { return stopped_by != 0; };
    struct sigaction action {};
    action.sa_handler = [](int signal) { stopped_by = signal; };
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);

    CheckReport report{options.suite, plan.key, which.device, again(options), nullptr, 0};
    const auto start = std::chrono::steady_clock::now();
    Result<std::vector<CaseResult>> results = check_cases(plan, [&](const CaseResult& result) {
        std::fputs(told_case(report, result).c_str(), stdout);
        std::fflush(stdout);
    });
    if (!results) return fail_with(k_exit_failed, results.error().message);
    report.results = &*results;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (results->size() > 1 || !plan.keeps) std::printf("%s\n", told_sum(*results).c_str());
    if (is_foreign && !options.blesses)
        std::printf("%srun where one of those draws, or bless references of %s with --bless --force.\n",
                    told_others(keys).c_str(), plan.key.c_str());
    if (Result<void> written = write_reports(options, report); !written)
        return fail_with(k_exit_failed, written.error().message);
    if (stopped_by) {
        std::fprintf(stderr, "rendercheck: Interrupted after %zu of %zu cases.\n", results->size(),
                     plan.cases.size());
        return 128 + stopped_by;
    }
    return options.blesses ? bless_all(*results) : exit_code(*results);
}

}  // namespace flaneur
