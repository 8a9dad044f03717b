// Named stretches of a frame: labelled for debuggers, timed, and counted.
#pragma once

#include <vector>

#include "renderer/device/device.h"
#include "renderer/renderer.h"

namespace flaneur {

inline constexpr uint32_t k_max_stages = 16;  // of a frame

struct Stages {
    VkQueryPool timestamps = {};     // at the start, and at the end of each stage; null: the device has none
    VkQueryPool counters = {};       // of each stage: vertices and fragments shaded; null: it counts none
    std::vector<const char*> names;  // of those recorded
    bool is_recorded = false;        // since they were read
    bool is_counted = false;         // by `counters`, which many devices pay for
    bool has_labels = false;
};
Result<void> make_stages(const Device& device, Stages& stages);
void destroy_stages(const Device& device, Stages& stages);

// Forgets what was recorded before, and begins to take the time, and to count if that is wanted and can be.
void begin_stages(VkCommandBuffer commands, Stages& stages, bool is_counted);

// A stage is timed from the end of the one before to its own. StageZone (record.h) begins and ends them.
void begin_stage(VkCommandBuffer commands, Stages& stages, const char* name);
void end_stage(VkCommandBuffer commands, const Stages& stages);

// Of a frame that the device has finished; what was read before is left as it is. Traces get them too, where
// the device's clock can be told on the host's (device/clock.h).
Result<void> read_stages(const Device& device, Stages& stages, std::vector<FrameStats::Stage>& read);

}  // namespace flaneur
