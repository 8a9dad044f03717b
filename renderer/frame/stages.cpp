#include "renderer/frame/stages.h"

#include <cassert>

#include "renderer/device/check.h"
#include "renderer/device/clock.h"
#include "renderer/device/names.h"
#include "sim/base/zone.h"

namespace flaneur {
namespace {

// Between two empty barriers, which cost nothing but make lavapipe draw what it has put off: it would take
// the time only after the draws that follow.
void write_timestamp(VkCommandBuffer commands, const Stages& stages, uint32_t number) {
    if (!stages.timestamps) return;
    const VkDependencyInfo nothing{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    vkCmdPipelineBarrier2(commands, &nothing);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, stages.timestamps, number);
    vkCmdPipelineBarrier2(commands, &nothing);
}

void trace_stages(const Device& device, const Stages& stages, const uint64_t* times) {
    const std::optional<ClockPair> clock = is_tracing() ? read_clocks(device) : std::nullopt;
    if (!clock) return;
    for (size_t i = 0; i < stages.names.size(); ++i)
        record_trace({stages.names[i], host_time(device, *clock, times[i]),
                      host_time(device, *clock, times[i + 1]), 0, TraceKind::device_zone});
}

}  // namespace

Result<void> make_stages(const Device& device, Stages& stages) {
    stages.has_labels = device.has_labels;
    VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    if (device.timestamp_mask != 0) {
        queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
        queries.queryCount = k_max_stages + 1;
        FLANEUR_VK(vkCreateQueryPool(device.handle, &queries, nullptr, &stages.timestamps), "make timers");
        name_object(device, stages.timestamps, "stage times");
    }
    if (device.has_counters) {
        queries.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
        queries.queryCount = k_max_stages;
        queries.pipelineStatistics = VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                                     VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT;
        FLANEUR_VK(vkCreateQueryPool(device.handle, &queries, nullptr, &stages.counters), "make counters");
        name_object(device, stages.counters, "stage counters");
    }
    return {};
}

void destroy_stages(const Device& device, Stages& stages) {
    if (stages.timestamps) vkDestroyQueryPool(device.handle, stages.timestamps, nullptr);
    if (stages.counters) vkDestroyQueryPool(device.handle, stages.counters, nullptr);
    stages = {};
}

void begin_stages(VkCommandBuffer commands, Stages& stages, bool is_counted) {
    stages.names.clear();
    stages.is_counted = is_counted && stages.counters;
    stages.is_recorded = true;
    if (stages.timestamps) vkCmdResetQueryPool(commands, stages.timestamps, 0, k_max_stages + 1);
    if (stages.is_counted) vkCmdResetQueryPool(commands, stages.counters, 0, k_max_stages);
    write_timestamp(commands, stages, 0);
}

void begin_stage(VkCommandBuffer commands, Stages& stages, const char* name) {
    const auto number = static_cast<uint32_t>(stages.names.size());
    assert(number < k_max_stages);
    if (stages.is_counted) vkCmdBeginQuery(commands, stages.counters, number, 0);
    stages.names.push_back(name);
    if (!stages.has_labels) return;
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = name;
    vkCmdBeginDebugUtilsLabelEXT(commands, &label);
}

void end_stage(VkCommandBuffer commands, const Stages& stages) {
    if (stages.has_labels) vkCmdEndDebugUtilsLabelEXT(commands);
    const auto count = static_cast<uint32_t>(stages.names.size());
    write_timestamp(commands, stages, count);
    if (stages.is_counted) vkCmdEndQuery(commands, stages.counters, count - 1);
}

Result<void> read_stages(const Device& device, Stages& stages, std::vector<FrameStats::Stage>& read) {
    if (!stages.is_recorded) return {};
    read.clear();
    for (const char* name : stages.names) read.push_back({name});
    const auto count = static_cast<uint32_t>(read.size());
    if (stages.timestamps) {
        uint64_t times[k_max_stages + 1] = {};
        FLANEUR_VK(vkGetQueryPoolResults(device.handle, stages.timestamps, 0, count + 1, sizeof times, times,
                                         sizeof(uint64_t), VK_QUERY_RESULT_64_BIT),
                   "read a frame's times");
        const double ms = static_cast<double>(device.properties.limits.timestampPeriod) * 1e-6;
        for (uint32_t i = 0; i < count; ++i)
            read[i].gpu_ms = static_cast<double>((times[i + 1] - times[i]) & device.timestamp_mask) * ms;
        trace_stages(device, stages, times);
    }
    if (stages.is_counted) {
        uint64_t shaded[k_max_stages][2] = {};  // in the order of the counters' bits
        FLANEUR_VK(vkGetQueryPoolResults(device.handle, stages.counters, 0, count, sizeof shaded, shaded,
                                         sizeof shaded[0], VK_QUERY_RESULT_64_BIT),
                   "read a frame's counters");
        for (uint32_t i = 0; i < count; ++i)
            read[i].vertices = shaded[i][0], read[i].fragments = shaded[i][1];
    }
    stages.is_recorded = false;
    return {};
}

}  // namespace flaneur
