// What gait analysis does with a row of samples: filtering, derivatives, cycles, comparing curves.
#pragma once

#include <vector>

#include "sim/base/vec.h"
#include "tools/flaneur/gait/measure/reference.h"

namespace flaneur {

using Samples = std::vector<double>;  // one value a tick

// Fourth-order zero-phase low-pass at `cutoff` Hz of a series of `rate` Hz: a second-order Butterworth filter
// run forward and backward, its cutoff corrected for the two passes (Winter 2009, 2.2.4.4). Ends are extended
// by reflection.
Samples low_pass(const Samples& values, double rate, double cutoff);

// Mean length of the third derivative of a path after a 10 Hz low-pass, over ticks [begin, end), in m/s3.
double mean_jerk(const std::vector<Vec3>& path, double rate, size_t begin, size_t end);

// The value at a time between ticks, linear; clamped to the ends.
double sample_at(const Samples& values, double tick);

// One cycle from `begin` to `end` (ticks, fractions welcome) at 0, 1, .. 100 percent.
Cycle cycle_of(const Samples& values, double begin, double end);

// The mean of a curve's 0 .. 99 percent.
double mean(const Cycle& c);
// The curve less its mean.
Cycle centred(const Cycle& c);
double range(const Cycle& c);
double rmse(const Cycle& a, const Cycle& b);
// Pearson's r.
double correlation(const Cycle& a, const Cycle& b);

// Percent of the highest (or lowest) value within [first, last] percent; wraps round where these lie outside
// 0 .. 100. Refined by a parabola through the neighbours.
struct Peak {
    double percent = 0, value = 0;
};
Peak highest(const Cycle& c, int first, int last);
Peak lowest(const Cycle& c, int first, int last);

// Amplitude and phase (degrees, [0, 360)) of the k-th harmonic of a cycle.
struct Wave {
    double amplitude = 0, phase = 0;
};
Wave harmonic(const Cycle& c, int k);
// b's phase less a's, [0, 360).
double phase_between(Wave a, Wave b);

}  // namespace flaneur
