// Named stretches of time, for whoever looks for where it goes.
//
//     FLANEUR_ZONE("steer");              // from here to the end of the block
//     FLANEUR_ZONE("steer", world.ms[2])  // and what it took, milliseconds, to be read afterwards
//     FLANEUR_ZONE("light", record);      // a pass of a frame: renderer/frame/record.h
//
// Nothing is recorded until begin_trace(): a zone is a look at a flag then, 1.4 ns. While a trace is on, a
// zone takes 0.1 us, and each thread keeps its last k_trace_events, in memory that it asks for at its first
// one: that a tick allocates nothing does not hold then. Names must live as long as the program, as literals
// do.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flaneur {

inline constexpr size_t k_trace_events = 1 << 16;  // of each thread that are kept, the last
inline constexpr size_t k_trace_threads = 256;     // that are recorded, the first

enum class TraceKind : uint8_t {
    zone,         // of the thread
    device_zone,  // of the graphics device, told by the thread that waited for it
    counter,      // has a value from `begin` on
};

struct TraceEvent {
    const char* name;
    int64_t begin, end;  // nanoseconds of trace_now()
    double value;        // of a counter
    TraceKind kind;
};

// What a thread was about, in the order in which it ended.
struct TraceThread {
    std::string name;  // "main", "worker 2"
    std::vector<TraceEvent> events;
    uint64_t lost = 0;  // before these, for want of room
};

inline std::atomic<bool> trace_switch = false;  // begin_trace()'s and end_trace()'s
inline bool is_tracing() { return trace_switch.load(std::memory_order_relaxed); }

// The clock of all of it: std::chrono::steady_clock, which is CLOCK_MONOTONIC on Linux.
inline int64_t trace_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Forgets what was recorded before, and records from now on. The calling thread is "main".
void begin_trace();
// Records no more, and hands out what was recorded. May be called while other threads are at work; zones that
// they have not left are not among it.
std::vector<TraceThread> end_trace();

// What the calling thread is called in traces from its next event on: "worker" and 2; 0: no number.
void name_trace_thread(const char* kind, int number = 0);
void record_trace(const TraceEvent& event);

// The name of the innermost zone that the calling thread is in; null: in none, or nobody records.
const char* innermost_zone();

// A value from now on, drawn as a curve.
inline void trace_counter(const char* name, double value) {
    if (is_tracing()) record_trace({name, trace_now(), 0, value, TraceKind::counter});
}

class Zone {
  public:
    explicit Zone(const char* name) {
        if (is_tracing()) enter(name);
    }
    ~Zone() {
        if (name_) leave();
    }
    Zone(const Zone&) = delete;
    Zone& operator=(const Zone&) = delete;

  private:
    void enter(const char* name);
    void leave();

    const char* name_ = nullptr;  // null: not recorded
    const char* outer_ = nullptr;
    int64_t begin_ = 0;
};

// A zone whose time somebody wants to know, whether it is recorded or not.
class TimedZone {
  public:
    TimedZone(const char* name, double& ms) : zone_(name), ms_(ms), begin_(trace_now()) {}
    ~TimedZone() { ms_ = static_cast<double>(trace_now() - begin_) * 1e-6; }
    TimedZone(const TimedZone&) = delete;
    TimedZone& operator=(const TimedZone&) = delete;

  private:
    Zone zone_;
    double& ms_;
    int64_t begin_;
};

inline Zone open_zone(const char* name) { return Zone(name); }
inline TimedZone open_zone(const char* name, double& ms) { return {name, ms}; }

}  // namespace flaneur

#define FLANEUR_ZONE_NAMED(line, ...) \
    [[maybe_unused]] const auto zone_of_line_##line = ::flaneur::open_zone(__VA_ARGS__)
#define FLANEUR_ZONE_AT(line, ...) FLANEUR_ZONE_NAMED(line, __VA_ARGS__)
#define FLANEUR_ZONE(...) FLANEUR_ZONE_AT(__LINE__, __VA_ARGS__)
