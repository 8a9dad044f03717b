// The instance, one device, the queue that it draws by and the one that presents.
#pragma once

#include <volk.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "renderer/options.h"
#include "sim/base/result.h"

struct GLFWwindow;

namespace flaneur {

struct Device {
    VkInstance instance = {};
    VkDebugUtilsMessengerEXT messenger = {};
    VkSurfaceKHR surface = {};  // null off-screen
    VkPhysicalDevice physical = {};
    VkDevice handle = {};
    VkQueue queue = {}, present_queue = {};  // graphics and transfer; presentation: often the same
    uint32_t queue_family = 0, present_family = 0;
    VkPhysicalDeviceProperties properties = {};
    VkPhysicalDeviceMemoryProperties memory = {};
    bool has_labels = false;      // VK_EXT_debug_utils
    uint64_t timestamp_mask = 0;  // bits of the queue's timestamps that count; 0: it has none
    bool has_clocks = false;      // VK_EXT_calibrated_timestamps, with CLOCK_MONOTONIC
    bool clamps_depth = false;    // depthClamp
    bool draws_many = false;      // multiDrawIndirect
    bool has_wireframe = false;   // fillModeNonSolid
    bool has_counters = false;    // of what shaders were called for
    std::function<void(const std::string&)> on_message;
    std::atomic<uint32_t> messages = 0;  // from the validation layer
};

// Fills `device`, which must stay where it is; after a failure destroy_device() frees what had been made.
Result<void> make_device(Device& device, const RendererOptions& options, GLFWwindow* window);
void destroy_device(Device& device);

// Sets device.surface to one of the window's.
Result<void> make_surface(Device& device, GLFWwindow* window);

// The place of the wanted device in a list as the driver enumerates it: by its number, else the first whose
// name contains `wanted` (case counts not), else, for an empty `wanted`, the fastest kind. Refuses with the
// list.
struct DeviceChoice {
    std::string name;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    std::string missing;  // what it lacks; empty: it fits
};
Result<size_t> choose_device(const std::vector<DeviceChoice>& devices, const std::string& wanted);

}  // namespace flaneur
