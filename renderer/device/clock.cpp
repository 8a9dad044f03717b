#include "renderer/device/clock.h"

#include <cmath>

#include "sim/base/zone.h"

namespace flaneur {

std::optional<ClockPair> read_clocks(const Device& device) {
    if (device.has_clocks) {
        VkCalibratedTimestampInfoEXT wanted[2] = {{VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT},
                                                  {VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT}};
        wanted[0].timeDomain = VK_TIME_DOMAIN_DEVICE_EXT;
        wanted[1].timeDomain = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT;
        uint64_t times[2] = {}, deviation = 0;
        if (vkGetCalibratedTimestampsEXT(device.handle, 2, wanted, times, &deviation) != VK_SUCCESS)
            return std::nullopt;
        return ClockPair{times[0], static_cast<int64_t>(times[1])};
    }
    if (device.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) return std::nullopt;
    const int64_t now = trace_now();
    return ClockPair{static_cast<uint64_t>(now), now};
}

int64_t host_time(const Device& device, const ClockPair& clocks, uint64_t timestamp) {
    const uint64_t ticks = (clocks.device - timestamp) & device.timestamp_mask;
    const double period = static_cast<double>(device.properties.limits.timestampPeriod);
    return clocks.host - std::llround(static_cast<double>(ticks) * period);
}

}  // namespace flaneur
