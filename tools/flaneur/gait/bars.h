// What a walk is held against: one row a bar.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/gait/measure.h"

namespace flaneur {

inline constexpr double k_open = 1e9;  // no bound on this side

struct Bar {
    const char* quantity;
    double low, high;
    double stretch;      // a stronger upper bound to strive for; 0: none
    const char* source;  // of the numbers
};

// Bars of level walking at any natural speed; of those that hold at one speed only; and of walks at a given
// speed.
std::vector<Bar> level_bars(double speed);

struct Verdict {
    Bar bar;
    double value = 0;
    bool measured = false, pass = false;
};
// One for each bar, in their order. What was not measured does not pass.
std::vector<Verdict> judge(const Quantities& quantities, const std::vector<Bar>& bars);

}  // namespace flaneur
