// The smoothest curve near measured values: penalised cubic B-splines (Eilers & Marx 1996), by time.
#pragma once

#include <span>
#include <vector>

namespace flaneur {

// A uniform cubic B-spline over time: its control point k is at `begin + (k - 1) * step`.
struct Spline {
    double begin = 0, step = 0.1;  // seconds
    std::vector<double> points;
};
// Between its second control point and its last but one.
double value_at(const Spline& spline, double time);
double slope_at(const Spline& spline, double time);

struct TimedValue {
    double time = 0, value = 0;
    double weight = 0;  // seconds that it stands for
};

// What is kept of slow changes and left out of quick ones: at `cutoff`, 1/s, half of a wave is left, at twice
// that 1/65, as the sum of squares of what is missed and (2 pi cutoff)^-6 times that of the third derivative
// is least. `pull`, seconds squared, times the square of the first derivative is added, which keeps a curve
// level where nothing is measured. From `begin` on over `stretches` steps.
struct Smoothing {
    double cutoff = 1, pull = 0;
};
Spline fit_spline(std::span<const TimedValue> measured, double begin, double step, size_t stretches,
                  Smoothing how);

}  // namespace flaneur
