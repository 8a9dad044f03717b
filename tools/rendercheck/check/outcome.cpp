#include "tools/rendercheck/check/outcome.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "assets/files/words.h"
#include "tools/flaneur/options/shell_words.h"
#include "tools/rendercheck/files/disk.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

constexpr size_t k_most_log = size_t{1} << 23, k_told_log = 4000, k_most_file = size_t{1} << 30;

Result<std::string> path_in(const PlannedRun& run, const std::string& file) {
    Result<std::string> whole = filled(file, run.placeholders);
    if (!whole) return whole;
    return (fs::path(run.dir) / *whole).lexically_normal().string();
}

std::string read_pictures(const SuiteCase& one, const PlannedRun& run, RunOutcome& out) {
    for (const std::string& file : one.pictures) {
        Result<std::string> path = path_in(run, file);
        if (!path) return path.error().message;
        std::error_code failed;
        const std::string name = fs::path(*path).filename().string();
        if (!fs::exists(*path, failed)) return "It wrote no " + (one.is_stdout ? "picture" : name) + ".";
        Result<std::vector<uint8_t>> bytes = read_whole(*path, k_most_file);
        if (!bytes) return bytes.error().message;
        if (bytes->empty() && one.is_stdout) return "It printed no picture.";
        Result<CheckedPicture> picture = read_picture(*bytes);
        if (!picture) return name + " " + picture.error().message;
        if (one.width > 0 && (picture->width != one.width || picture->height != one.height))
            return name + " has " + told_size(*picture) + " pixels, and the suite says " +
                   std::to_string(one.width) + "x" + std::to_string(one.height) + ".";
        out.files.push_back(std::move(*bytes));
        out.pictures.push_back(std::move(*picture));
    }
    return "";
}

void read_parts(const SuiteCase& one, const PlannedRun& run, RunOutcome& out) {
    for (const SuitePart& part : one.parts) {
        Result<std::string> path = path_in(run, part.file);
        Result<std::vector<uint8_t>> bytes = path ? read_whole(*path, k_most_file) : path.error();
        out.parts.push_back(bytes ? std::optional(std::move(*bytes)) : std::nullopt);
        std::string text;
        if (!part.legend.empty())
            if (Result<std::string> legend = path_in(run, part.legend))
                if (Result<std::vector<uint8_t>> read = read_whole(*legend, k_most_log))
                    text.assign(read->begin(), read->end());
        out.legends.push_back(std::move(text));
    }
}

}  // namespace

Result<PlannedRun> plan_run(const Suite& suite, const SuiteCase& one, const std::string& dir) {
    PlannedRun run;
    run.dir = dir + "/files";
    std::error_code failed;
    fs::create_directories(run.dir, failed);
    if (failed) return Error{"No folder " + run.dir + " can be made: " + failed.message() + "."};
    run.placeholders = placeholders_of(suite, run.dir);
    Result<std::vector<std::string>> words = command_of(one, run.placeholders);
    if (!words) return words.error();
    Result<Environment> env = environment_of(suite, one, run.placeholders);
    if (!env) return env.error();
    Result<std::string> folder = filled(one.folder, run.placeholders);
    if (!folder) return Error{"case " + one.name + ": folder: " + folder.error().message};
    run.process.words = std::move(*words);
    run.process.env = {env->begin(), env->end()};
    run.process.folder =
        folder->empty() ? suite.folder : (fs::path(suite.folder) / *folder).lexically_normal().string();
    run.process.stdout_file = one.is_stdout ? run.dir + "/stdout" : dir + "/stdout.txt";
    run.process.stderr_file = dir + "/stderr.txt";
    run.process.watched = dir;
    run.process.time_limit = one.time_limit;
    run.process.disk_limit = static_cast<size_t>(one.disk_limit * (1 << 20));
    return run;
}

// A command may print any bytes, and may be cut within a letter: reports are UTF-8.
std::string valid_text(const std::string& text) {
    using Json = nlohmann::json;
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string validation_message(const std::string& log) {
    for (const std::string_view line : split(log, '\n'))
        if (line.find("VUID-") != std::string_view::npos ||
            line.find("Validation Error") != std::string_view::npos)
            return valid_text(std::string(line.substr(0, 400)));
    return "";
}

RunOutcome outcome_of(const SuiteCase& one, const PlannedRun& run, const ProcessEnd& end) {
    RunOutcome out;
    out.seconds = end.seconds;
    out.left_over = end.left_over;
    std::string log = one.is_stdout ? "" : tail_of(run.process.stdout_file, k_most_log);
    log += tail_of(run.process.stderr_file, k_most_log);
    out.log = valid_text(log.size() > k_told_log ? log.substr(log.size() - k_told_log) : log);
    const std::string complaint = validation_message(log);
    if (end.how != HowEnded::exited || end.code != 0) {
        const std::string program = one.is_shell ? "The command" : run.process.words.front();
        out.problem = program + " " + told_end(end, run.process) + ".";
    } else if (!complaint.empty()) {
        out.problem = "The validation layer says: " + complaint;
    } else {
        out.problem = read_pictures(one, run, out);
        if (out.problem.empty()) read_parts(one, run, out);
    }
    return out;
}

}  // namespace flaneur
