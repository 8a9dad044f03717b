#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/rendercheck/commands.h"
#include "tools/rendercheck/files/disk.h"
#include "tools/rendercheck/report/report.h"

namespace flaneur {
namespace {

nlohmann::ordered_json box_json(const PixelBox& box) { return {box.left, box.top, box.width, box.height}; }

std::string told_json(const Judgement& judgement) {
    nlohmann::ordered_json out;
    out["passes"] = judgement.passes, out["equal"] = judgement.is_equal, out["reasons"] = judgement.reasons;
    out["pixels"] = judgement.pixels, out["differing"] = judgement.differing, out["over"] = judgement.over;
    for (size_t t = 0; t < k_thresholds.size(); ++t)
        out["beyond"][std::to_string(k_thresholds[t])] = judgement.beyond[t];
    out["worst"] = {{"difference", judgement.worst},
                    {"at", {judgement.worst_x, judgement.worst_y}},
                    {"new", judgement.worst_new},
                    {"reference", judgement.worst_reference}};
    out["densest"] = {{"pixels", judgement.densest}, {"box", box_json(judgement.densest_window)}};
    out["boxes"] = nlohmann::ordered_json::array();
    for (const ChangedBox& box : judgement.boxes)
        out["boxes"].push_back({{"box", box_json(box.box)}, {"pixels", box.pixels}});
    out["flip"] = {{"mean", judgement.mean_flip}, {"max", judgement.max_flip}};
    return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

int run_compare(const CompareOptions& options) {
    SuiteCase one;
    one.name = "compare";
    Result<CheckedPicture> picture = load_picture(options.picture);
    if (!picture) return fail_with(k_exit_failed, picture.error().message);
    Result<CheckedPicture> reference = load_picture(options.reference);
    if (!reference) return fail_with(k_exit_missing, reference.error().message);
    MayDiffer may_differ;
    if (!options.mask.empty()) {
        Result<CheckedPicture> mask = load_picture(options.mask);
        if (!mask) return fail_with(k_exit_usage, mask.error().message);
        may_differ.mask = std::move(*mask);
    }
    PictureResult pair;
    pair.name = options.picture, pair.reference = options.reference, pair.has_reference = true;
    pair.judgement = judge(*picture, *reference, options.tolerance, may_differ);
    pair.picture = std::move(*picture), pair.other = std::move(*reference);
    CaseResult result;
    result.one = &one;
    result.status = pair.judgement.passes ? CaseStatus::passed : CaseStatus::regression;
    result.details = told_judgement(pair.judgement);
    result.line = pair.judgement.reasons.empty() ? "" : pair.judgement.reasons.front();
    const bool passes = pair.judgement.passes, is_equal = pair.judgement.is_equal;
    if (options.is_json) {
        std::fputs(told_json(pair.judgement).c_str(), stdout);
    } else {
        std::printf("%s\n", is_equal ? "Equal." : passes ? "Within the tolerance." : "Different.");
        for (const std::string& line : result.details) std::printf("    %s\n", line.c_str());
    }
    if (!options.html.empty()) {
        result.pictures.push_back(std::move(pair));
        // A pair within the tolerance is looked at too.
        if (passes)
            result.status = CaseStatus::regression, result.line = "Within the tolerance.",
            result.pictures.front().judgement.passes = false;
        const std::vector<CaseResult> results = [&] {
            std::vector<CaseResult> list;
            list.push_back(std::move(result));
            return list;
        }();
        const CheckReport report{options.picture + " against " + options.reference,
                                 "compare",
                                 "",
                                 "rendercheck compare",
                                 &results,
                                 0};
        if (Result<void> written = write_whole(options.html, html_report(report)); !written)
            return fail_with(k_exit_failed, written.error().message);
    }
    return passes ? k_exit_passed : k_exit_regression;
}

}  // namespace flaneur
