#include "tools/flaneur/gait/measure/running.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flaneur {

namespace {

int feet_down(const Instant& now) { return !now.feet[k_left].swinging + !now.feet[k_right].swinging; }

double knee(const Instant& now, Side side) {
    Vec3 at = place(now, k_limbs[side].lower_leg);
    Vec3 thigh = at - place(now, k_limbs[side].upper_leg), shank = place(now, k_limbs[side].foot) - at;
    return std::atan2(static_cast<double>(length(cross(thigh, shank))),
                      static_cast<double>(dot(thigh, shank))) *
           180 / std::numbers::pi;
}

// The pelvis's acceleration down, m/s2.
double fall_at(const Walk& walk, size_t t) {
    auto y = [&](size_t tick) { return static_cast<double>(place(walk.ticks[tick], hips).y); };
    return (2 * y(t) - y(t - 1) - y(t + 1)) * walk.rate * walk.rate;
}

}  // namespace

Quantities measure_fall(const Walk& walk, size_t first, size_t last) {
    double flight = 0, most = -1e9;
    int ticks = 0;
    for (size_t t = std::max<size_t>(first, 2); t + 2 < std::min(last, walk.ticks.size()); ++t) {
        int least = 2, greatest = 0;
        for (size_t near = t - 1; near <= t + 1; ++near) {
            least = std::min(least, feet_down(walk.ticks[near]));
            greatest = std::max(greatest, feet_down(walk.ticks[near]));
        }
        if (greatest == 0) flight += fall_at(walk, t), ++ticks;
        if (least > 0)
            most = std::max(most, (fall_at(walk, t - 1) + fall_at(walk, t) + fall_at(walk, t + 1)) / 3);
    }
    return {{"flight_fall.m_s2", ticks > 0 ? flight / ticks : 0}, {"stance_fall.m_s2", most}};
}

Quantities measure_change(const Walk& walk, size_t first, size_t last) {
    double bent = 0, between = 0;
    int both = 0, none = 0;
    bool begun = false;
    for (size_t t = std::max<size_t>(first, 1); t < std::min(last, walk.ticks.size()); ++t) {
        const Instant &now = walk.ticks[t], &before = walk.ticks[t - 1];
        int down = feet_down(now);
        if (down > 0) bent = std::max(bent, std::min(knee(now, k_left), knee(now, k_right)));
        bool lands = false;
        for (Side side : {k_left, k_right})
            lands = lands || (before.feet[side].swinging && !now.feet[side].swinging);
        if (lands) {
            between += begun && (both > 0) == (none > 0);
            begun = true;
            both = none = 0;
        }
        both += down == 2;
        none += down == 0;
    }
    return {{"both_knees.deg", bent}, {"between.steps", between}};
}

}  // namespace flaneur
