// Counts of lines and zones (tools/flaneur/measure) as files.
#pragma once

#include <string>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/measure/count.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

// A file for each line and zone of the plan, called by csv_path(). Refuses, before anything is counted, a
// path that cannot be written to.
Result<std::vector<PartFilePtr>> open_counts(const std::string& path, const MeasurePlan& plan);
// `files` are those that open_counts() opened for their plan.
Result<void> write_counts(std::vector<PartFilePtr> files, const Counts& counts);

}  // namespace flaneur
