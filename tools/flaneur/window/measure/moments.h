// When what is counted was so: the time that charts show, and their highest moments.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/flaneur/measure/count.h"

namespace flaneur {

struct MeasureRoom;
struct Viewer;
struct World;

inline constexpr double k_step_seconds = 10;  // of the flow over time

// Seconds of the run that a chart shows of what is counted since a tick until the latest: a minute to five of
// them, those in which the shown tick is.
struct Stretch {
    double from = 0, to = 0;
};
Stretch plotted(uint32_t since, uint32_t latest, uint32_t shown);

// Of a chart.
struct Height {
    uint32_t tick = 0;
    float value = 0;
};
// When most people to a square metre were in the zone, and how many; the first such sample from a tick on.
// None where there was nobody.
std::optional<Height> densest(const ZoneCount& zone, uint32_t from);
// The middle of the k_step_seconds in which most crossed the line, both ways, and how many a minute; of those
// that are over at the tick `latest`, and do not begin before `from`.
std::optional<Height> fullest(const LineCount& line, uint32_t from, uint32_t latest);

// Of what is selected and counts, or else of the first that does: that one's highest moment, and in words
// what it is. None where nobody was counted.
struct CountPeak {
    uint32_t tick = 0;
    std::string told;
};
std::optional<CountPeak> peak_of_zones(const MeasureRoom& room, uint32_t from);
std::optional<CountPeak> peak_of_lines(const MeasureRoom& room, uint32_t from);

// There, and stop; says so where there is none.
void go_to_densest(const World& world, Viewer& viewer);
void go_to_fullest(const World& world, Viewer& viewer);

}  // namespace flaneur
