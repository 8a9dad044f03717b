// Whether two series of times differ, and by how much.
#pragma once

#include <span>

namespace flaneur {

struct Difference {
    double ratio = 1;          // later to earlier: the median of the ratios of all pairs (Hodges and Lehmann)
    double low = 1, high = 1;  // where that is with a confidence of 99 %
    double p = 1;              // that series of the same thing differ as much, by chance: Mann and Whitney's
                               // test, both ways, by its normal approximation with ties
    bool is_enough = false;    // there are samples enough to say so: k_least_samples of each
};
inline constexpr int k_least_samples = 8;

// Times are above 0, in the order in which they were taken. What follows each other resembles each other, as
// when a neighbour on the machine is busy for a while, which the test knows nothing of: so it is done on the
// medians of at most 14 stretches of either series.
Difference difference_of(std::span<const double> earlier, std::span<const double> later);

}  // namespace flaneur
