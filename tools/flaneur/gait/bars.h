// What a walk is held against: one row a bar.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

inline constexpr double k_open = 1e9;        // no bound on this side
inline constexpr double k_run_froude = 0.5;  // beyond this Froude number people run

struct Bar {
    const char* quantity;
    double low, high;
    double stretch;              // a stronger upper bound to strive for; 0: none
    const char* source;          // of the numbers
    const char* also = nullptr;  // of how they were carried over to others
};

// Bars of level walking at a speed, or of a run where it is one (beyond k_run_froude), for a leg's length
// in metres. Bars that hold at natural speed only are among them from 1.2 to 1.4 m/s.
std::vector<Bar> level_bars(double speed, double leg);
std::vector<Bar> stand_bars();
std::vector<Bar> turn_bars(double degrees);
std::vector<Bar> stairs_bars(bool up, double leg);
std::vector<Bar> stairs_run_bars(bool up);
std::vector<Bar> slope_bars(double percent);
std::vector<Bar> kerb_bars();
std::vector<Bar> leap_bars(double width);
std::vector<Bar> bends_bars();
std::vector<Bar> gaits_bars();
std::vector<Bar> change_bars();
// How people spread is asked of ten steady walkers or more.
std::vector<Bar> crowd_bars(size_t steady_walkers);

struct Verdict {
    Bar bar;
    double value = 0;
    bool measured = false, pass = false;
};
// One for each bar, in their order. What was not measured does not pass.
std::vector<Verdict> judge(const Quantities& quantities, const std::vector<Bar>& bars);

}  // namespace flaneur
