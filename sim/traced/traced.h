// People who go where somebody was: along ways that are known from beginning to end, recorded or simulated
// elsewhere. The crowd's places and motions are told, nobody decides or avoids; feet, knees and all else are
// the gait's, as of anybody. Its header lies below the world, its source above.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

struct World;

// A control point of a way: of a uniform cubic B-spline, so that accelerations have no jumps.
struct TraceKnot {
    Vec3 at{};          // metres; what is stood on is looked for within k_trace_step of it
    float heading = 0;  // yaw, not wrapped
};
inline constexpr float k_trace_step = 0.6f;  // metres

// Somebody's way. Who is seen again after a while has another one. Ticks count from k_trace_lead before the
// world's first one: whoever comes is there that long before anybody sees it, and gets into its stride.
struct TracedWay {
    uint32_t id = 0;              // what it was called where it was recorded
    uint32_t begin = 0, end = 0;  // is there from that tick to that one, both included
    uint32_t seen = 0, gone = 0;  // comes into sight within k_shown ticks from the first one on, and is out
                                  // of it at the other
    uint32_t knots = 0;           // the first one's place in Traces::knots
    uint32_t stretch = 6;         // ticks from knot to knot; of n whole stretches there are n + 4 knots
    float height = 0;             // of the body, metres; 0: not known
};
inline constexpr uint32_t k_trace_lead = 90;

struct Traces {
    std::vector<TracedWay> ways;  // by `begin`, then by `id`
    std::vector<TraceKnot> knots;
    uint32_t most = 0;  // who are there at once, at most
};

// Where one is on its way and how it goes. Between the ticks of its way, which hold beyond them too.
struct TracePoint {
    Vec3 at{};
    Vec2 velocity{};  // m/s
    float heading = 0, turn_rate = 0;
};
TracePoint trace_at(const Traces& traces, const TracedWay& way, uint32_t tick);

// Of a world that follows traces. `slots` says which way who is there follows.
struct Traced {
    std::shared_ptr<const Traces> traces;  // null: the crowd goes by itself
    uint32_t next = 0;                     // the way whose turn it is to begin
    std::vector<uint32_t> way_of;          // by slot of the crowd
};
inline bool is_on(const Traced& traced) { return traced.traces != nullptr; }

// From now on, at tick 0 and with nobody in it yet, the world is theirs who follow these; those who are there
// at first are in full stride. Who they are is
// drawn by chance from the world's kinds, by `seed` and `id`, those who push prams left out: where a height
// is known, one whose body has it, scaled by k_most_trace_scale at most. Allocates.
void follow_traces(World& world, std::shared_ptr<const Traces> traces);
inline constexpr float k_most_trace_scale = 1.12f;

// A tick. Who comes or goes does so within k_shown ticks, little by little. Allocates nothing.
void drive_traced(World& world);

}  // namespace flaneur
