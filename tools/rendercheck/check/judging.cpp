#include "tools/rendercheck/check/judging.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "tools/rendercheck/check/things.h"
#include "tools/rendercheck/files/disk.h"
#include "tools/rendercheck/references/references.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

std::string told_box(const PixelBox& box) {
    return std::to_string(box.width) + "x" + std::to_string(box.height) + " at " + std::to_string(box.left) +
           "," + std::to_string(box.top);
}

std::string told_channels(const std::array<double, 4>& channels) {
    std::string out;
    for (size_t c = 0; c < 4; ++c) {
        char text[32];
        std::snprintf(text, sizeof text, "%s%.4g", c ? " " : "", channels[c]);
        out += text;
    }
    return out;
}

Result<CheckedPicture> read_kept(const std::string& path) { return load_picture(path); }

PartResult judge_part(const SuitePart& part, const std::string& path,
                      const std::optional<std::vector<uint8_t>>& file, const std::string& legend,
                      std::vector<std::string>& details) {
    PartResult out{part.name, PartStatus::no_reference, path, part.is_hashed, {}, ""};
    if (!file) {
        details.push_back("It wrote no " + part.name + ".");
        return out;
    }
    Result<CheckedPicture> picture = read_picture(*file);
    if (!picture) {
        details.push_back(part.name + " " + picture.error().message);
        return out;
    }
    const std::string hash = pixel_hash(*picture);
    out.legend = short_legend(legend);
    if (part.is_hashed) {
        out.file.assign(hash.begin(), hash.end());
        Result<std::vector<uint8_t>> kept = read_whole(path + ".hash", 64);
        if (kept) out.status = *kept == out.file ? PartStatus::same : PartStatus::differs;
        return out;
    }
    if (Result<std::vector<uint8_t>> kept = kept_bytes(*picture, *file)) out.file = std::move(*kept);
    if (Result<CheckedPicture> kept = read_kept(path + ".png"))
        out.status = pixel_hash(*kept) == hash ? PartStatus::same : PartStatus::differs;
    return out;
}

// Which pass differs first, and what is there.
void tell_parts(const SuiteCase& one, const RunOutcome& run, CaseJudging& out) {
    std::string passes;
    for (const PartResult& part : out.parts) {
        if (part.status == PartStatus::no_reference) continue;
        if (!passes.empty()) passes += ", ";
        passes += part.name + (part.status == PartStatus::same ? " is the same" : " differs");
    }
    if (!passes.empty()) {
        const auto first = std::find_if(out.parts.begin(), out.parts.end(), [](const PartResult& part) {
            return part.status == PartStatus::differs;
        });
        out.details.push_back((first == out.parts.end()
                                   ? "No pass before the picture differs: "
                                   : "The first pass that differs is " + first->name + ": ") +
                              passes + ".");
    }
    for (size_t n = 0; n < one.parts.size(); ++n) {
        if (one.parts[n].legend.empty() || out.parts[n].file.empty() || out.pictures.empty()) continue;
        IdPicture now, before;
        if (!read_ids(*run.parts[n], out.parts[n].legend, now)) continue;
        const Result<std::vector<uint8_t>> kept = read_whole(out.parts[n].path + ".png", size_t{1} << 28);
        const Result<std::vector<uint8_t>> legend = read_whole(out.parts[n].path + ".json", size_t{1} << 26);
        const bool has_before =
            kept && legend && read_ids(*kept, std::string(legend->begin(), legend->end()), before);
        for (std::string& line :
             told_things(out.pictures.front().judgement, now, has_before ? &before : nullptr))
            out.details.push_back(std::move(line));
    }
}

}  // namespace

std::vector<std::string> told_judgement(const Judgement& judgement) {
    std::vector<std::string> details = judgement.reasons;
    if (judgement.differing == 0) return details;
    std::string counts = "Pixels that differ by more than";
    for (size_t t = 0; t < k_thresholds.size(); ++t)
        counts +=
            (t ? ", " : " ") + std::to_string(k_thresholds[t]) + ": " + std::to_string(judgement.beyond[t]);
    details.push_back(counts + " (255ths).");
    char text[200];
    std::snprintf(text, sizeof text,
                  "Worst pixel %d,%d by %.4g/255: %s instead of %s. FLIP %.4f in the mean, %.3f at most.",
                  judgement.worst_x, judgement.worst_y, judgement.worst,
                  told_channels(judgement.worst_new).c_str(),
                  told_channels(judgement.worst_reference).c_str(), judgement.mean_flip, judgement.max_flip);
    details.push_back(text);
    std::string boxes = "Changed:";
    const size_t told = std::min<size_t>(judgement.boxes.size(), 6);
    for (size_t n = 0; n < told; ++n)
        boxes += (n ? ", " : " ") + told_box(judgement.boxes[n].box) + " (" +
                 std::to_string(judgement.boxes[n].pixels) + ")";
    if (const size_t more = judgement.boxes.size() - told + judgement.more_boxes)
        boxes += ", and " + std::to_string(more) + " more";
    if (told) details.push_back(boxes + ".");
    return details;
}

CaseJudging judge_run(const Suite& suite, const SuiteCase& one, const std::string& golden,
                      const std::string& key, const RunOutcome& run) {
    CaseJudging out;
    out.may_differ.ignored = one.ignored;
    if (!one.mask.empty()) {
        Result<CheckedPicture> mask = load_picture((fs::path(suite.folder) / one.mask).string());
        if (mask)
            out.may_differ.mask = std::move(*mask);
        else
            out.status = CaseStatus::regression, out.details.push_back("The mask: " + mask.error().message);
    }
    for (size_t n = 0; n < run.pictures.size(); ++n) {
        PictureResult result;
        result.name = fs::path(one.pictures[n] == "{out}" ? one.name : one.pictures[n]).stem().string();
        result.reference = reference_path(golden, key, one, n);
        result.picture = run.pictures[n];
        if (Result<std::vector<uint8_t>> kept = kept_bytes(run.pictures[n], run.files[n]))
            result.file = std::move(*kept);
        std::error_code failed;
        result.has_reference = fs::exists(result.reference, failed);
        const std::string told = run.pictures.size() > 1 ? result.name + ": " : "";
        if (!result.has_reference) {
            if (out.status == CaseStatus::passed) out.status = CaseStatus::missing;
            out.details.push_back(told + "There is no " + result.reference + ".");
        } else if (Result<CheckedPicture> reference = read_kept(result.reference); !reference) {
            out.status = CaseStatus::regression;
            out.details.push_back("The reference " + reference.error().message);
        } else {
            result.judgement = judge(run.pictures[n], *reference, one.tolerance, out.may_differ);
            result.other = std::move(*reference);
            if (!result.judgement.passes) {
                out.status = CaseStatus::regression;
                for (const std::string& line : told_judgement(result.judgement))
                    out.details.push_back(told + line);
            }
        }
        out.pictures.push_back(std::move(result));
    }
    for (size_t n = 0; n < one.parts.size(); ++n)
        out.parts.push_back(judge_part(one.parts[n], part_path(golden, key, one, one.parts[n]), run.parts[n],
                                       run.legends[n], out.details));
    if (out.status == CaseStatus::regression) tell_parts(one, run, out);
    return out;
}

CaseResult conclude(const SuiteCase& one, CaseJudging& first, std::vector<RunOutcome>& runs) {
    CaseResult out;
    out.one = &one;
    int left_over = 0;
    for (const RunOutcome& run : runs)
        out.seconds += run.seconds, left_over = std::max(left_over, run.left_over);
    out.log = runs.back().log;
    if (left_over > 0)
        out.details.push_back("It left " + std::to_string(left_over) +
                              " processes running, which were ended.");
    if (!runs.back().problem.empty()) {
        out.status = CaseStatus::failed;
        out.line = runs.back().problem;
        if (runs.size() > 1)
            out.details.push_back("That was run " + std::to_string(runs.size()) +
                                  "; before it there was a picture.");
        return out;
    }
    out.status = first.status;
    out.parts = std::move(first.parts);
    // From run to run.
    for (size_t n = 1; n < runs.size() && out.status != CaseStatus::flaky; ++n)
        for (size_t p = 0; p < runs[n].pictures.size(); ++p) {
            Judgement itself =
                judge(runs[n].pictures[p], runs.front().pictures[p], one.tolerance, first.may_differ);
            if (itself.is_equal) continue;
            if (itself.passes) {
                out.details.push_back("Run " + std::to_string(n + 1) +
                                      " differs from the first within the tolerance: " +
                                      std::to_string(itself.differing) + " pixels.");
                // On either side of what may differ.
                if (out.status == CaseStatus::regression && first.pictures[p].other &&
                    judge(runs[n].pictures[p], *first.pictures[p].other, one.tolerance, first.may_differ)
                        .passes)
                    out.status = CaseStatus::flaky, out.line = "It passes in one run and not in another.";
                continue;
            }
            out.status = CaseStatus::flaky;
            out.line =
                "It differs from itself: run " + std::to_string(n + 1) + " is not the picture of run 1.";
            for (const std::string& line : told_judgement(itself)) out.details.push_back(line);
            PictureResult& shown = first.pictures[p];
            shown.other = runs.front().pictures[p];
            shown.picture = runs[n].pictures[p];
            shown.judgement = std::move(itself);
            break;
        }
    if (out.status != CaseStatus::flaky) {
        for (std::string& detail : first.details) out.details.push_back(std::move(detail));
        size_t bad = 0;
        const PictureResult* worst = nullptr;
        for (const PictureResult& picture : first.pictures) {
            if (picture.judgement.passes) continue;
            ++bad;
            if (!worst || picture.judgement.mean_flip > worst->judgement.mean_flip) worst = &picture;
        }
        if (out.status == CaseStatus::regression)
            out.line = worst && !worst->judgement.reasons.empty() ? worst->judgement.reasons.front()
                       : out.details.empty()                      ? "It cannot be judged."
                                                                  : out.details.front();
        if (out.status == CaseStatus::missing)
            out.line =
                std::to_string(bad) + (bad == 1 ? " picture has" : " pictures have") + " no reference.";
    }
    out.pictures = std::move(first.pictures);
    if (out.status == CaseStatus::passed)
        for (PictureResult& picture : out.pictures)
            picture.picture.reset(), picture.other.reset(), picture.file.clear();
    return out;
}

}  // namespace flaneur
