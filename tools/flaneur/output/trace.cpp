#include "tools/flaneur/output/trace.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {
namespace {

constexpr double k_trace_patience = 30;  // seconds that writing may take after a signal

struct OpenTrace {
    std::mutex mutex;
    PartFilePtr file;  // null: nobody wants one
};
OpenTrace& open_trace() {
    static auto* const one = new OpenTrace;  // never destroyed: the process may be ending
    return *one;
}

// Those of the device come from whoever waited for it; they are of one row, where a new measure of how its
// clock stands to the host's must not let one begin before the last has ended.
std::vector<TraceEvent> device_zones(std::span<const TraceThread> threads) {
    std::vector<TraceEvent> zones;
    for (const TraceThread& thread : threads)
        std::copy_if(thread.events.begin(), thread.events.end(), std::back_inserter(zones),
                     [](const TraceEvent& e) { return e.kind == TraceKind::device_zone; });
    std::stable_sort(zones.begin(), zones.end(),
                     [](const TraceEvent& a, const TraceEvent& b) { return a.begin < b.begin; });
    int64_t last = std::numeric_limits<int64_t>::min();
    for (TraceEvent& zone : zones) {
        zone.begin = std::max(zone.begin, last);
        zone.end = last = std::max(zone.begin, zone.end);
    }
    return zones;
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

// Nanoseconds as microseconds, to the last digit: that zones lie within each other survives.
std::string microseconds(int64_t ns) {
    char text[32];
    std::snprintf(text, sizeof text, "%" PRId64 ".%03" PRId64, ns / 1000, ns % 1000);
    return text;
}

struct EventWriter {
    std::string out;
    int64_t start = 0;

    void add(const std::string& event) {
        out += out.empty() ? "" : ",\n";
        out += event;
    }
    void add_row(size_t row, const std::string& name) {
        const std::string of = "\"ph\": \"M\", \"pid\": 1, \"tid\": " + std::to_string(row) + ", \"args\": ";
        add("{\"name\": \"thread_name\", " + of + "{\"name\": " + quoted(name) + "}}");
        add("{\"name\": \"thread_sort_index\", " + of + "{\"sort_index\": " + std::to_string(row) + "}}");
    }
    void add_zone(size_t row, const TraceEvent& zone) {
        add("{\"name\": " + quoted(zone.name) + ", \"ph\": \"X\", \"pid\": 1, \"tid\": " +
            std::to_string(row) + ", \"ts\": " + microseconds(zone.begin - start) +
            ", \"dur\": " + microseconds(zone.end - zone.begin) + "}");
    }
    void add_counter(const TraceEvent& counter) {
        char value[32];
        std::snprintf(value, sizeof value, "%.17g", counter.value);
        add("{\"name\": " + quoted(counter.name) + ", \"ph\": \"C\", \"pid\": 1, \"tid\": 0, \"ts\": " +
            microseconds(counter.begin - start) + ", \"args\": {\"value\": " + value + "}}");
    }
};

uint64_t lost_events(std::span<const TraceThread> threads) {
    uint64_t lost = 0;
    for (const TraceThread& thread : threads) lost += thread.lost;
    return lost;
}

}  // namespace

std::string trace_json(std::span<const TraceThread> threads) {
    EventWriter writer;
    writer.start = std::numeric_limits<int64_t>::max();
    for (const TraceThread& thread : threads) {
        for (const TraceEvent& event : thread.events) writer.start = std::min(writer.start, event.begin);
    }
    constexpr size_t k_first_row = 1, k_device_row = 2;  // main, the device, and the others
    for (size_t i = 0; i < threads.size(); ++i) {
        const TraceThread& thread = threads[i];
        const size_t row = thread.name == "main" ? k_first_row : k_device_row + 1 + i;
        writer.add_row(row, thread.name);
        for (const TraceEvent& event : thread.events) {
            if (event.kind == TraceKind::zone) writer.add_zone(row, event);
            if (event.kind == TraceKind::counter) writer.add_counter(event);
        }
    }
    const std::vector<TraceEvent> zones = device_zones(threads);
    if (!zones.empty()) writer.add_row(k_device_row, "device");
    for (const TraceEvent& zone : zones) writer.add_zone(k_device_row, zone);
    return "{\"displayTimeUnit\": \"ms\", \"otherData\": {\"program\": \"flaneur " FLANEUR_VERSION
           "\", \"lost\": " +
           std::to_string(lost_events(threads)) + "}, \"traceEvents\": [\n" + writer.out + "\n]}\n";
}

Result<void> start_trace(const std::string& path) {
    if (path.empty()) return {};
    Result<PartFilePtr> file = open_file(path);
    if (!file) return file.error();
    std::lock_guard lock(open_trace().mutex);
    open_trace().file = std::move(*file);
    begin_trace();
    return {};
}

Result<void> finish_trace() {
    PartFilePtr file;
    {
        std::lock_guard lock(open_trace().mutex);
        file = std::move(open_trace().file);
    }
    if (!file) return {};
    be_patient(k_trace_patience);
    const auto threads = end_trace();
    const uint64_t lost = lost_events(threads);
    const std::string path = file->path;
    Result<void> written = write_file(std::move(file), trace_json(threads));
    if (written) {
        say("Wrote " + path + ": open it in ui.perfetto.dev or chrome://tracing" +
            (lost > 0 ? "; it has the end of the run, and not the " + std::to_string(lost) + " events before"
                      : ""));
    }
    return written;
}

}  // namespace flaneur
