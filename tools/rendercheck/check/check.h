// Cases run and judged.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/rendercheck/process/process.h"
#include "tools/rendercheck/suite/suite.h"
#include "tools/rendercheck/verdict/verdict.h"

namespace flaneur {

enum class CaseStatus {
    passed,
    regression,  // a picture is not its reference
    flaky,       // it differs from itself from run to run
    missing,     // it has no reference
    failed,      // it crashed, took too long, wrote no picture, or a validation layer complained
};

struct PictureResult {
    std::string name;       // without folder and ending
    std::string reference;  // where it lies, or would
    bool has_reference = false;
    Judgement judgement;  // against the reference; of a flaky case against its first run
    std::vector<uint8_t> file;
    std::optional<CheckedPicture> picture, other;  // new, and what it was held against; of what did not pass
};

enum class PartStatus { same, differs, no_reference };

struct PartResult {
    std::string name;
    PartStatus status = PartStatus::same;
    std::string path;  // of the reference, without ending
    bool is_hashed = false;
    std::vector<uint8_t> file;  // what blessing keeps: a picture, or the hash
    std::string legend;         // and its legend
};

struct CaseResult {
    const SuiteCase* one = nullptr;
    CaseStatus status = CaseStatus::passed;
    std::string line;                  // what is said of it, a sentence
    std::vector<std::string> details;  // what is said beneath
    std::vector<PictureResult> pictures;
    std::vector<PartResult> parts;
    std::string log;        // the end of what it printed
    std::string reproduce;  // as a line for a shell
    double seconds = 0;     // of all its runs
};

// FLIP and shares decide; how bad a case is, for sorting: worse ones are larger.
double badness(const CaseResult& result);

struct CheckPlan {
    const Suite* suite = nullptr;
    std::vector<const SuiteCase*> cases;
    std::string golden, key;
    int jobs = 1;
    int runs = 0;         // of each case; 0: what it says
    std::string scratch;  // a folder for what the commands write
    bool keeps = false;   // what they wrote stays there
    bool (*should_stop)() = nullptr;
};

// In the order of the plan's cases; `say` hears of each as it ends. Fewer where it was stopped. From a
// program of one thread.
Result<std::vector<CaseResult>> check_cases(const CheckPlan& plan,
                                            const std::function<void(const CaseResult&)>& say);

// Why it does not pass, how much differs and where, a sentence each; none where nothing does.
std::vector<std::string> told_judgement(const Judgement& judgement);

const char* told_status(CaseStatus status);

// Keeps what did not pass, or had no reference, as what is right from now on; of what passes, parts without a
// reference. How many pictures.
Result<int> bless(const CaseResult& result);

}  // namespace flaneur
