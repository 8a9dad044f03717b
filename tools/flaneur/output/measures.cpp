#include "tools/flaneur/output/measures.h"

#include <utility>

#include "tools/flaneur/measure/csv.h"

namespace flaneur {

Result<std::vector<PartFilePtr>> open_counts(const std::string& path, const MeasurePlan& plan) {
    if (is_stream(path))
        return Error{path +
                     " takes one file, and there is one for each line and zone: give a name, such as "
                     "out/measures.csv."};
    std::vector<PartFilePtr> files;
    auto open = [&](const std::string& name) -> Result<void> {
        Result<PartFilePtr> file = open_file(csv_path(path, name));
        if (!file) return file.error();
        files.push_back(std::move(*file));
        return {};
    };
    for (const CountLine& line : plan.lines)
        if (Result<void> opened = open(line.name); !opened) return opened.error();
    for (const CountZone& zone : plan.zones)
        if (Result<void> opened = open(zone.name); !opened) return opened.error();
    return files;
}

Result<void> write_counts(std::vector<PartFilePtr> files, const Counts& counts) {
    size_t at = 0;
    for (const LineCount& line : counts.lines)
        if (Result<void> kept = write_file(std::move(files[at++]), line_csv(line)); !kept) return kept;
    for (const ZoneCount& zone : counts.zones)
        if (Result<void> kept = write_file(std::move(files[at++]), zone_csv(zone)); !kept) return kept;
    return {};
}

}  // namespace flaneur
