#include "sim/base/zone.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>

namespace flaneur {
namespace {

// The last events of a thread, round and round. Only the thread writes, but for the end of the trace.
struct Ring {
    std::mutex mutex;
    std::string name;
    std::unique_ptr<TraceEvent[]> events;  // k_trace_events, of which pages are taken as they are written
    uint64_t count = 0;                    // that there have been
    uint64_t trace = 0;                    // the one that they are of
};

// They stay where they are until the program ends: threads go, what they did is kept.
struct Rings {
    std::mutex mutex;
    std::array<std::unique_ptr<Ring>, k_trace_threads> rings;
    size_t count = 0;
};
Rings& all_rings() {
    static Rings* const rings = new Rings;  // never freed: threads may outlive what is freed at the end
    return *rings;
}

std::atomic<uint64_t> traces = 0;  // begun

thread_local const char* thread_kind = "thread";
thread_local int thread_number = 0;
thread_local const char* innermost = nullptr;
thread_local Ring* own_ring = nullptr;
thread_local uint64_t own_trace = 0;  // that own_ring was sought for

std::string thread_name() {
    return thread_number > 0 ? std::string(thread_kind) + " " + std::to_string(thread_number) : thread_kind;
}

// Null where there are too many threads.
Ring* find_ring(uint64_t trace) {
    if (own_trace == trace) return own_ring;
    own_trace = trace;
    Rings& all = all_rings();
    std::lock_guard lock(all.mutex);
    if (!own_ring && all.count < k_trace_threads) {
        std::unique_ptr<Ring>& ring = all.rings[all.count++];
        ring = std::make_unique<Ring>();
        ring->events = std::make_unique_for_overwrite<TraceEvent[]>(k_trace_events);
        own_ring = ring.get();
    }
    if (own_ring) {
        std::lock_guard own(own_ring->mutex);
        own_ring->name = thread_name();
        own_ring->count = 0;
        own_ring->trace = trace;
    }
    return own_ring;
}

}  // namespace

void begin_trace() {
    thread_kind = "main", thread_number = 0;
    ++traces;
    trace_switch = true;
}

std::vector<TraceThread> end_trace() {
    trace_switch = false;
    std::vector<TraceThread> threads;
    Rings& all = all_rings();
    std::lock_guard lock(all.mutex);
    for (size_t i = 0; i < all.count; ++i) {
        Ring& ring = *all.rings[i];
        std::lock_guard own(ring.mutex);
        if (ring.trace != traces || ring.count == 0) continue;
        TraceThread& thread = threads.emplace_back();
        thread.name = ring.name;
        const uint64_t kept = std::min<uint64_t>(ring.count, k_trace_events);
        thread.lost = ring.count - kept;
        thread.events.reserve(kept);
        for (uint64_t e = thread.lost; e < ring.count; ++e)
            thread.events.push_back(ring.events[e % k_trace_events]);
    }
    return threads;
}

void name_trace_thread(const char* kind, int number) {
    thread_kind = kind, thread_number = number;
    own_trace = 0;
}

void record_trace(const TraceEvent& event) {
    Ring* const ring = find_ring(traces.load(std::memory_order_relaxed));
    if (!ring) return;
    std::lock_guard lock(ring->mutex);
    ring->events[ring->count++ % k_trace_events] = event;
}

const char* innermost_zone() { return innermost; }

void Zone::enter(const char* name) {
    name_ = name;
    outer_ = innermost;
    innermost = name;
    begin_ = trace_now();
}

void Zone::leave() {
    const int64_t end = trace_now();
    innermost = outer_;
    record_trace({name_, begin_, end, 0, TraceKind::zone});
}

}  // namespace flaneur
