#include "tools/rendercheck/check/check.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tools/flaneur/options/shell_words.h"
#include "tools/rendercheck/check/judging.h"
#include "tools/rendercheck/check/outcome.h"
#include "tools/rendercheck/files/disk.h"
#include "tools/rendercheck/files/scratch.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

// A case between its first run and its last.
struct OpenCase {
    size_t at = 0;  // among the plan's
    std::vector<RunOutcome> runs;
    CaseJudging judging;
    ScratchFolder scratch;  // of its runs, where they do not stay
    std::string dir;
    PlannedRun run;
    Process process;
};

Result<void> begin_run(const CheckPlan& plan, OpenCase& open) {
    const SuiteCase& one = *plan.cases[open.at];
    if (open.dir.empty()) {
        open.dir = plan.scratch + "/" + one.name;
        if (!plan.keeps) open.scratch = ScratchFolder(open.dir);
    }
    const std::string dir = open.dir + "/run" + std::to_string(open.runs.size() + 1);
    std::error_code ignored;
    fs::remove_all(dir, ignored);
    Result<PlannedRun> run = plan_run(*plan.suite, one, dir);
    if (!run) return run.error();
    open.run = std::move(*run);
    Result<Process> process = start_process(open.run.process);
    if (!process) return process.error();
    open.process = *process;
    return {};
}

// As a user would type it where the suite lies, with a place for the picture that stays.
std::string reproducing(const Suite& suite, const SuiteCase& one, const PlannedRun& run) {
    Placeholders places = placeholders_of(suite, "/tmp/" + one.name);
    Result<std::vector<std::string>> words = command_of(one, places);
    std::string line =
        "cd " + shell_line({run.process.folder}) + " && mkdir -p " + shell_line({places["dir"]}) + " && ";
    if (Result<Environment> env = environment_of(suite, one, places); env && !env->empty()) {
        line += "env ";
        for (const auto& [name, value] : *env)
            line += value ? shell_line({name + "=" + *value}) + " " : "-u " + name + " ";
    }
    if (!words) return line;
    return line + shell_line(*words) + (one.is_stdout ? " > " + shell_line({places["dir"] + "/stdout"}) : "");
}

int runs_of(const CheckPlan& plan, const SuiteCase& one) { return plan.runs > 0 ? plan.runs : one.runs; }

// Whether it has to run once more: as often as was asked for, and what differs from its reference twice.
bool takes_another(const CheckPlan& plan, OpenCase& open) {
    const SuiteCase& one = *plan.cases[open.at];
    if (!open.runs.back().problem.empty()) return false;
    const size_t wanted = static_cast<size_t>(runs_of(plan, one));
    if (open.runs.size() == 1) {
        open.judging = judge_run(*plan.suite, one, plan.golden, plan.key, open.runs.front());
        if (open.judging.status == CaseStatus::regression) return true;
    }
    return open.runs.size() < wanted;
}

}  // namespace

const char* told_status(CaseStatus status) {
    switch (status) {
        case CaseStatus::passed:
            return "pass";
        case CaseStatus::regression:
            return "REGRESSION";
        case CaseStatus::flaky:
            return "FLAKY";
        case CaseStatus::missing:
            return "NO REFERENCE";
        default:
            return "FAILED";
    }
}

double badness(const CaseResult& result) {
    double worst = 0;
    for (const PictureResult& picture : result.pictures)
        worst = std::max(worst, picture.judgement.mean_flip + (picture.judgement.passes ? 0 : 1e-6));
    constexpr double k_order[] = {0, 20, 30, 10, 40};
    return k_order[static_cast<size_t>(result.status)] + worst;
}

Result<std::vector<CaseResult>> check_cases(const CheckPlan& plan,
                                            const std::function<void(const CaseResult&)>& say) {
    std::vector<std::optional<CaseResult>> results(plan.cases.size());
    std::vector<OpenCase> open;
    size_t next = 0;
    std::optional<Error> failure;
    auto stop = [&] { return failure || (plan.should_stop && plan.should_stop()); };
    while (next < plan.cases.size() || !open.empty()) {
        while (!stop() && next < plan.cases.size() && open.size() < static_cast<size_t>(plan.jobs)) {
            OpenCase fresh;
            fresh.at = next++;
            if (Result<void> begun = begin_run(plan, fresh); !begun) {
                failure = begun.error();
                break;
            }
            open.push_back(std::move(fresh));
        }
        if (stop()) {
            next = plan.cases.size();
            for (const OpenCase& one : open) stop_process(one.process);
        }
        for (size_t n = 0; n < open.size();) {
            OpenCase& one = open[n];
            const std::optional<ProcessEnd> end = poll_process(one.process);
            if (!end) {
                ++n;
                continue;
            }
            bool goes_on = false;
            if (!stop() && end->how != HowEnded::stopped) {
                one.runs.push_back(outcome_of(*plan.cases[one.at], one.run, *end));
                goes_on = takes_another(plan, one);
                if (goes_on) {
                    if (Result<void> begun = begin_run(plan, one); !begun)
                        failure = begun.error(), goes_on = false;
                } else {
                    CaseResult result = conclude(*plan.cases[one.at], one.judging, one.runs);
                    result.reproduce = reproducing(*plan.suite, *plan.cases[one.at], one.run);
                    say(result);
                    results[one.at] = std::move(result);
                }
            }
            if (goes_on)
                ++n;
            else
                open.erase(open.begin() + static_cast<ptrdiff_t>(n));
        }
        if (!open.empty()) usleep(1000);
    }
    if (failure) return *failure;
    std::vector<CaseResult> out;
    for (std::optional<CaseResult>& result : results)
        if (result) out.push_back(std::move(*result));
    return out;
}

Result<int> bless(const CaseResult& result) {
    if (result.status == CaseStatus::flaky || result.status == CaseStatus::failed) return 0;
    const bool has_passed = result.status == CaseStatus::passed;
    int count = 0;
    for (const PictureResult& picture : result.pictures) {
        if (has_passed || (picture.judgement.passes && picture.has_reference)) continue;
        if (Result<void> written = write_whole(picture.reference, picture.file); !written)
            return written.error();
        ++count;
    }
    for (const PartResult& part : result.parts) {
        // Parts that a suite has anew are taken although the picture is right.
        if (part.file.empty() || (has_passed && part.status != PartStatus::no_reference)) continue;
        const std::string path = part.path + (part.is_hashed ? ".hash" : ".png");
        if (Result<void> written = write_whole(path, part.file); !written) return written.error();
        if (part.legend.empty()) continue;
        if (Result<void> written = write_whole(part.path + ".json", part.legend); !written)
            return written.error();
    }
    return count;
}

}  // namespace flaneur
