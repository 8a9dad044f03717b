#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "tools/flaneur/bench/gauntlet/gauntlet.h"

namespace flaneur {

namespace {

constexpr int k_format = 1;
constexpr size_t k_most_bytes = 4 << 20;  // of a run

const char* kind_name(bool is_quick) { return is_quick ? "quick" : "full"; }

}  // namespace

std::string run_json(const GauntletRun& run) {
    nlohmann::ordered_json json = {
        {"gauntlet", k_format},   {"machine", run.machine},          {"device", run.device},
        {"version", run.version}, {"kind", kind_name(run.is_quick)}, {"seconds", run.seconds},
        {"notes", run.notes}};
    json["scores"] = nlohmann::ordered_json::array();
    for (const GauntletScore& score : run.scores) {
        nlohmann::ordered_json row = {{"part", score.part}, {"name", score.name}};
        if (score.size > 0) row["size"] = score.size;
        row["value"] = score.value;
        row["unit"] = score.unit;
        if (score.low) row["low"] = *score.low;
        if (score.high) row["high"] = *score.high;
        json["scores"].push_back(row);
    }
    return json.dump(2) + "\n";
}

Result<GauntletRun> read_run(std::string_view bytes) {
    if (Result<void> sane = check_json(bytes, 8, 100'000); !sane) return sane.error();
    const nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
    const Error none{
        "is not what bench gauntlet --json writes: run that on the other machine, and copy its file"};
    if (!json.is_object() || !json.contains("gauntlet")) return none;
    GauntletRun run;
    try {
        if (json.at("gauntlet").get<int>() != k_format)
            return Error{"was written by another version of bench gauntlet: run this one there"};
        run.machine = json.at("machine").get<std::string>();
        run.device = json.at("device").get<std::string>();
        run.version = json.at("version").get<std::string>();
        run.is_quick = json.at("kind").get<std::string>() == kind_name(true);
        run.notes = json.at("notes").get<std::vector<std::string>>();
        run.seconds = json.at("seconds").get<double>();
        auto bound = [](const nlohmann::json& row, const char* key) {
            return row.contains(key) ? std::optional(row.at(key).get<double>()) : std::nullopt;
        };
        for (const auto& row : json.at("scores"))
            run.scores.push_back({row.at("part").get<std::string>(), row.at("name").get<std::string>(),
                                  row.value("size", 0.0), row.at("value").get<double>(),
                                  row.at("unit").get<std::string>(), bound(row, "low"), bound(row, "high")});
    } catch (const nlohmann::json::exception&) {
        return none;
    }
    return run;
}

Result<std::vector<GauntletRun>> read_others(const std::string& folder, bool is_quick,
                                             std::vector<std::string>& notes) {
    std::error_code error;
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
    if (error) return Error{"Cannot read the folder " + folder + ": " + error.message() + "."};
    std::sort(paths.begin(), paths.end());
    std::vector<GauntletRun> runs;
    for (const std::string& path : paths) {
        Result<GauntletRun> run = read_parsed<GauntletRun>(path, k_most_bytes, read_run, "A run is left out");
        if (!run)
            notes.push_back(run.error().message);
        else if (run->is_quick != is_quick)
            notes.push_back(path + " is a " + kind_name(run->is_quick) + " run, and this is a " +
                            kind_name(is_quick) + " one: they are not held against each other.");
        else
            runs.push_back(std::move(*run));
    }
    return runs;
}

const GauntletScore* find_score(const GauntletRun& run, std::string_view part, std::string_view name,
                                double size) {
    for (const GauntletScore& score : run.scores)
        if (score.part == part && score.name == name && score.size == size) return &score;
    return nullptr;
}

}  // namespace flaneur
