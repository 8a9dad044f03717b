// What the CPU and its power meter count while something is measured, where the system lets one read that:
// instructions and the like by perf_event_open, energy by RAPL.
#pragma once

#include <array>
#include <optional>

#include "tools/flaneur/output/figures.h"

namespace flaneur {

inline constexpr size_t k_meters = 5;  // instructions, cycles, cache and branch misses; joules
using MeterReading = std::array<std::optional<double>, k_meters>;

// To be called before there are threads: what those do that are started later counts too.
void open_meters();

// Since open_meters(); what cannot be read is left out.
MeterReading read_meters();

// What was counted from a reading to now, for each walker and frame, and joules for each frame; and, as
// settings, what could be read, or why nothing could.
void add_meters(Figures& figures, const MeterReading& before, uint64_t frames, uint64_t walkers);

}  // namespace flaneur
