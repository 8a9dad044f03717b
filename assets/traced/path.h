// One person's path on the ground, out of spots.
#pragma once

#include <vector>

#include "assets/traced/spline.h"
#include "assets/traced/sway.h"

namespace flaneur {

// `x` and `z` over the same times.
struct Path {
    Spline x, z;
};

// Of spots in the order of time, with what is quicker than `cutoff`, 1/s, left out.
Path smooth_path(const std::vector<SeenAt>& spots, double cutoff);

// The smoothest path by them, between times that are `stretches` steps apart: calm, with k_calmest left, but
// for where the spots, k_mean seconds of them taken together, lie more than k_off from it, or one more than
// k_off_alone; there as lively as that takes, and k_liveliest at most. So the jitter of a camera shakes
// nobody, who stands stands, and who stops at once does.
Path follow_spots(const std::vector<SeenAt>& spots, double begin, double step, size_t stretches);
inline constexpr double k_calmest = 0.3, k_liveliest = 2;  // 1/s
inline constexpr double k_mean = 0.4;                      // seconds
inline constexpr double k_off = 0.03, k_off_alone = 0.11;  // metres

// Where a body on that path faces, which is not wrapped: along the path where it goes on, smoothed, so that
// half turns take as long as people take for them, and on as before where it stands; one that only stands
// faces `stands`.
Spline heading_along(const Path& path, double stands);
// The same by what was measured, in the order of time: yaws.
Spline heading_of_measured(const Path& path, const std::vector<double>& times, const std::vector<float>& yaws,
                           const std::vector<double>& weights);

}  // namespace flaneur
