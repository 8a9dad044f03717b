// Where time goes, for --trace: what the zones of sim/base/zone.h record, as Chrome's trace events, which
// ui.perfetto.dev and chrome://tracing open; docs/files.md tells the format.
#pragma once

#include <span>
#include <string>

#include "sim/base/result.h"
#include "sim/base/zone.h"

namespace flaneur {

// Records from now on, on all threads, what finish_trace() writes. Refuses at once a place that cannot be
// written to. An empty path records nothing.
Result<void> start_trace(const std::string& path);

// Writes what was recorded; success where nothing was, or it was written before. Any thread may call it when
// the process is about to end.
Result<void> finish_trace();

// A row for each thread, and one for the device. Times are microseconds since the first event.
std::string trace_json(std::span<const TraceThread> threads);

}  // namespace flaneur
