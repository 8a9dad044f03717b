// How a file of trajectories is to be read.
#pragma once

#include <optional>
#include <string>

#include "sim/base/vec.h"

namespace flaneur {

// What is known of a file better than it says itself; what is left as it is goes by evidence.
struct TrajectoryReading {
    float unit = 0;                // metres: what 1 is in the file; 0: by evidence
    float fps = 0;                 // frames a second; 0: by evidence
    char up = 0;                   // 'z' or 'y', the axis that points upwards in the file; 0: by evidence
    std::optional<Vec2> origin{};  // a place of the file, in its own unit (east, north), that is to be (0, 0)
    std::string geometry{};        // a file of where people can be; empty: one that lies beside it and fits

    bool operator==(const TrajectoryReading&) const = default;
};

}  // namespace flaneur
