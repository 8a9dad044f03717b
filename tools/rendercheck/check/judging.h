// Runs of a case held against its references and each other.
#pragma once

#include "tools/rendercheck/check/outcome.h"

namespace flaneur {

struct CaseJudging {
    CaseStatus status = CaseStatus::passed;
    std::vector<PictureResult> pictures;
    std::vector<PartResult> parts;
    std::vector<std::string> details;
    MayDiffer may_differ;
};

// Of a run without a problem. A mask or a reference that cannot be read is a regression that says so.
CaseJudging judge_run(const Suite& suite, const SuiteCase& one, const std::string& golden,
                      const std::string& key, const RunOutcome& run);

// Of all runs, the first of them judged, if it had no problem.
CaseResult conclude(const SuiteCase& one, CaseJudging& first, std::vector<RunOutcome>& runs);

}  // namespace flaneur
