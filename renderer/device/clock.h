// When something was on the device, by the host's clock.
#pragma once

#include <optional>

#include "renderer/device/device.h"

namespace flaneur {

// What both clocks show at one moment.
struct ClockPair {
    uint64_t device = 0;  // ticks, as timestamps have them
    int64_t host = 0;     // nanoseconds of trace_now()
};
// None where the device does not tell. lavapipe, where it does not, takes its times from the host's clock.
std::optional<ClockPair> read_clocks(const Device& device);

// The host's time of a timestamp that was written no later than the clocks were read.
int64_t host_time(const Device& device, const ClockPair& clocks, uint64_t timestamp);

}  // namespace flaneur
