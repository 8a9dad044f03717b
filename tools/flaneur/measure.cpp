#include <cstdio>
#include <filesystem>

#include "assets/files/file.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/measure/csv.h"
#include "tools/flaneur/measures/measures.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {
namespace {

Result<void> write_tables(const MeasuredFile& measured, const std::string& path, bool is_folder) {
    auto place_of = [&](const std::string& name) {
        return is_folder ? path + "/" + name + ".csv" : csv_path(path, name);
    };
    for (const MeasuredTable& table : tables_of(measured))
        if (Result<void> kept = write_file(place_of(table.name), table_csv(table)); !kept) return kept;
    if (measured.spaces.empty()) return {};
    return write_file(place_of("individual"), individual_csv(measured));
}

Result<void> write_measures(const MeasuredFile& measured, const std::string& path, const std::string& name) {
    if (has_ending(path, ".csv")) return write_tables(measured, path, false);
    if (has_ending(path, ".json")) return write_file(path, measures_json(measured, name));
    if (has_ending(path, ".svg")) return write_file(path, stacked_charts(measured));
    if (Result<void> kept = write_tables(measured, path, true); !kept) return kept;
    if (Result<void> kept = write_file(path + "/measures.json", measures_json(measured, name)); !kept)
        return kept;
    for (const MeasuredChart& chart : charts_of(measured))
        if (Result<void> kept = write_file(path + "/" + chart.name + ".svg", chart.svg); !kept) return kept;
    return {};
}

// Refuses at once what could not be written in the end.
Result<void> check_place(const std::string& path) {
    if (path.empty()) return {};
    const std::string ending = std::filesystem::path(path).extension().string();
    if (!ending.empty() && !has_ending(path, ".csv") && !has_ending(path, ".json") &&
        !has_ending(path, ".svg"))
        return Error{"--out " + printable(path) +
                     " is no .csv, .json or .svg; and a folder's name has no ending."};
    if (path == "-")
        return Error{"--out - would mix several files: give a name that ends in .csv, .json or .svg."};
    return {};
}

}  // namespace

Result<void> run_measure(const Options& options) {
    if (Result<void> good = check_place(options.out); !good) return good;
    Result<Trajectories> tracks = read_trajectories(options.file, options.reading);
    if (!tracks) return tracks.error();
    const std::string name = printable(std::filesystem::path(options.file).filename().string());
    show_progress("measuring " + name);
    const WorkersPtr workers = make_workers(options.threads);
    MeasuredFile measured;
    Result<void> done = measure_file(std::move(*tracks), options.measure, *workers, measured);
    clear_progress();
    if (!done) return Error{name + ": " + done.error().message};
    std::fputs(told_measures(measured, name).c_str(), stdout);
    if (options.out.empty()) return {};
    return write_measures(measured, options.out, name);
}

}  // namespace flaneur
