// What measured times come to: how they grow with the work, and what of them threads share. Pure functions.
#pragma once

#include <optional>
#include <span>

#include "tools/flaneur/plot/plot.h"

namespace flaneur {

// y = factor * x^exponent.
struct PowerLaw {
    double exponent = 0, factor = 0;
    double from = 0, to = 0;  // of x that it was fitted to
};
// By least squares of the logarithms over the upper half of the points, and three of them at least; `points`
// rise in x. None for fewer than three points, or where x or y of one of them is not above 0.
std::optional<PowerLaw> fit_power(std::span<const PlotPoint> points);

// Where y first passes `level` from below, between two points, by interpolation of the logarithms. None where
// it does not.
std::optional<double> crossing(std::span<const PlotPoint> points, double level);

// Amdahl: ms of n threads = serial_ms + shared_ms / n.
struct Amdahl {
    double serial_ms = 0, shared_ms = 0;
    double serial_share() const { return serial_ms / (serial_ms + shared_ms); }
};
// By least squares; neither part is below 0. `points`: x threads, 1 or more, and y ms. None for fewer than
// two numbers of threads, or where all of them took no time.
std::optional<Amdahl> fit_amdahl(std::span<const PlotPoint> points);

}  // namespace flaneur
