// Loads that change one thing and look how all else follows: the number of walkers, of threads, and what is
// switched off.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/bench/study/fit.h"

namespace flaneur {

// What the stages took with so many walkers or threads.
struct StudyPoint {
    double at = 0;    // walkers, or threads
    Figures figures;  // medians are looked at
};
// The medians of a stage over the points; those without it are left out.
std::vector<PlotPoint> medians(const std::vector<StudyPoint>& points, const std::string& stage);

// How many walkers a sweep from `first` to `last` has at its points, both among them: 1, 2, 5, 10 .. or, by
// `steps`, so many in equal ratios. Rising, none twice.
std::vector<uint32_t> sweep_points(uint32_t first, uint32_t last, int steps);
// As many threads as are tried up to `most`: all of a few, then ever fewer.
std::vector<int> thread_points(int most);

// The stages of a tick and, in builds with Vulkan, of a picture over the number of walkers; see
// docs/profiling.md. Prints a table, and writes after each point, so that
// an interruption leaves the points before, a chart and JSON:
// {"setting", "points": [{"walkers", "blocks"?, "load_s", "ticks", "resident_mb", "stages": {name: median
// ms}}], "fits": [{"stage", "exponent", "factor", "from", "to"}], "real_time": [{"stage", "up_to"}]}.
Result<void> run_sweep(const Options& options);

// The stages of a tick over the number of threads. JSON: {"setting", "points": [{"threads", "stages"}],
// "fits": [{"stage", "serial_ms", "shared_ms", "serial_share"}]}.
Result<std::string> bench_scale(const Options& options);

// What a picture costs without shadows, edges smoothed, levels of detail and so on, and what each of them
// changes in it; and the same of the techniques that pose bodies (sim/pose/techniques.h). JSON: {"setting",
// "picture_ms", "posing_ns", "ablations": [{"name", "unit", "costs", "from", "to", "all_threads",
// "mean_flip"}]}. Only in
// builds with Vulkan.
Result<std::string> bench_ablate(const Options& options);

}  // namespace flaneur
