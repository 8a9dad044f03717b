// How fast the simulation's time goes by.
#pragma once

#include <cstdint>
#include <optional>

namespace flaneur {

struct Clock {
    bool is_paused = false;
    float rate = 1;        // seconds of simulation for one that passes, k_least_rate .. k_most_rate
    uint32_t steps = 0;    // ticks to be made though it is paused
    double due = 0;        // seconds of simulation not made yet
    double kept_back = 0;  // and that have been given up, since the machine does not keep up

    // What has become of the rate over the last second or so; see reached_rate.
    struct Pace {
        double passed = 0, made = 0, kept_back = 0;  // seconds so far: real, of simulation, of those given up
        float rate = 0;                              // that was wanted
        float reached = 0;                           // 0: not known, or all that was wanted
    } pace{};
};
inline constexpr float k_least_rate = 0.1f, k_most_rate = 16;

// How many ticks are due after so many seconds. At most those of a tenth of a second of simulation, or as
// many as go by in a fifth of a second at its rate, at once: what is more is given up, so that the window
// keeps answering.
uint32_t ticks_due(Clock& clock, double seconds);

// How far the next picture is between the last two ticks, 0..1; of what stands still the last one is shown.
float between_ticks(const Clock& clock);

// The rate at which time really goes by, where the machine does not keep up with the one that is wanted; else
// none. Measured over a second.
std::optional<float> reached_rate(const Clock& clock);

// One of the usual rates (0.1, 0.25, 0.5, 1, 2, 4, 8, 16) slower or faster.
float slower(float rate);
float faster(float rate);

}  // namespace flaneur
