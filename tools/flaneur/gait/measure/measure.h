// The quantities of gait analysis, out of a recorded walk. Angles in degrees, lengths as the names say;
// percent of the gait cycle from initial contact of the same side.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/flaneur/gait/measure/reference.h"
#include "tools/flaneur/gait/measure/walk.h"

namespace flaneur {

// One of a crowd, in one of its ticks.
struct Moment {
    size_t walker = 0;
    uint32_t tick = 0;
};

// `name` ends in the unit, or in what the number is: "knee_swing_peak.deg", "knee.rmse".
struct Quantity {
    std::string name;
    double value = 0;
    std::optional<Moment> moment{};  // of a crowd's extremes: whose they are
};
using Quantities = std::vector<Quantity>;

void append(Quantities& to, const Quantities& more);
// Not a number if there is none of that name.
double value_of(const Quantities& quantities, std::string_view name);

// One cycle of contacts of one foot: ticks, a half before the one that first showed each event, which is
// where it lies on average.
struct MeasuredStride {
    Side side = k_left;
    double begin = 0, toe_off = 0, end = 0;
    double other_contact = 0, other_toe_off = 0;  // of the other foot, within the stride
};

// Strides that begin at tick `first` or later and end at `last` or sooner.
std::vector<MeasuredStride> strides(const Walk& walk, size_t first, size_t last);

// Mean curves over the strides of both sides.
struct Curves {
    Cycle thigh, knee, ankle, foot_pitch, pelvis_list, pelvis_rotation;
    Cycle trunk_rotation, head_rotation, head_pitch, head_roll, upper_arm, elbow;
    Cycle trunk_lean, trunk_list;      // of the line from pelvis to neck: forward +, towards this side +
    Cycle pelvis_height, pelvis_side;  // mm, mean 0; side: towards the foot that has come down
    Cycle heel_height, toe_height;     // mm of the sole over the ground; toe: the lower one of ball and tip
};
Curves curves_of(const Walk& walk, const std::vector<MeasuredStride>& strides);

// Everything about steady straight walking over ticks [first, last).
struct Level {
    Curves curves;  // of arms: of those that swing, or of both where neither does
    Quantities quantities;
    bool has_free_arm = true;  // whether a hand held nothing all the while
};
Level measure_level(const Walk& walk, size_t first, size_t last);

}  // namespace flaneur
