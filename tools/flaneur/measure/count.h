// Counting people: who crosses lines, and how many are in zones, told after every tick.
//
// A crossing is where somebody's way from one tick to the next meets a line, to the fraction of a tick; its
// first end belongs to the line and its last one does not, so that a chain of lines counts everybody once. It
// counts when who crossed has left the line by k_clear, so that nobody is counted who only stands on it or
// steps back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/measures/service.h"
#include "assets/measures/voronoi.h"
#include "sim/crowd/walker_id.h"
#include "tools/flaneur/measure/plan.h"

namespace flaneur {

struct World;

inline constexpr float k_clear = 0.1f;          // metres
inline constexpr double k_flow_seconds = 60;    // over which a flow is told
inline constexpr uint32_t k_sample_ticks = 60;  // between two samples of a zone: a second
inline constexpr CutOff k_zone_cells{3, 24};  // of those by which a zone's density is told; no wall cuts them
inline constexpr uint32_t k_unticked = ~0u;

// Somebody who is there after a tick.
struct Present {
    WalkerId id;
    Vec2 at;
    float speed = 0;      // m/s
    uint32_t person = 0;  // as person_number() has it
};

struct LineCrossing {
    double seconds = 0;  // since the beginning of the simulation
    uint32_t person = 0;
    bool to_right = false;
    float speed = 0;  // m/s, after the tick of the crossing
    Vec2 at;          // on the line
};

struct LineCount {
    CountLine line;
    uint32_t since = 0;                   // tick
    std::vector<LineCrossing> crossings;  // in the order of time
    struct Open {
        WalkerId who;
        LineCrossing crossing;
    };
    std::vector<Open> open;  // of those who have not left the line yet
};

struct ZoneSample {
    uint32_t tick = 0;
    uint32_t people = 0;
    float density = 0;  // people to a square metre: how many over how large
    float voronoi = 0;  // the same by Voronoi cells, see k_zone_cells
    float speed = 0;    // mean of those inside, m/s; 0 where there is nobody
};

struct ZoneCount {
    CountZone zone;
    uint32_t since = 0;               // tick
    double area = 0;                  // square metres
    std::vector<ZoneSample> samples;  // one at each whole second
};

struct Counts {
    std::vector<LineCount> lines;
    std::vector<ZoneCount> zones;
    uint32_t tick = k_unticked;    // the last one
    uint32_t shown = k_unticked;   // of which is told: that one, or an earlier one that is looked at again
    std::vector<Present> present;  // after it
    struct Before {
        uint32_t generation = 0, tick = k_unticked;
        Vec2 at;
    };
    std::vector<Before> before;  // by slot
};

// From `tick` on counts by this plan, all of whose names are given. What is as it was goes on with what it
// has.
void set_plan(Counts& counts, const MeasurePlan& plan, uint32_t tick);
MeasurePlan plan_of(const Counts& counts);
// Forgets what was counted.
void begin_anew(Counts& counts, uint32_t tick);

// After a tick, and before the first one that is to count, for where people are then. One that does not
// follow the last one begins a gap, over which nobody crosses; where it is an earlier one, what came after it
// is forgotten.
void count_people(Counts& counts, uint32_t tick, std::span<const Present> present);
void count_people(Counts& counts, const World& world);

// Whether nobody can cross it, as there is nothing to walk on within a metre of it, on any level.
bool is_off_ground(const CountLine& line, const World& world);

struct Flow {
    uint32_t left = 0, right = 0;
    double seconds = 0;           // over which they were counted
    double per_minute = 0;        // both ways
    double per_metre_second = 0;  // of the line's length
};
// Over less than this a flow is the luck of a few people, and none is told.
inline constexpr double k_settled_seconds = 10;
inline bool is_settled(const Flow& flow) { return flow.seconds >= k_settled_seconds; }
// Of the last `seconds` before a tick, or since counting began if that is less.
Flow flow_of(const LineCount& line, uint32_t tick, double seconds);

// A zone as it was at the tick that is shown: by its samples, or where that is the last one as it is, but for
// `voronoi`, which takes longer: that is of the last sample.
ZoneSample zone_now(const ZoneCount& zone, const Counts& counts);

}  // namespace flaneur
