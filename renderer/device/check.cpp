#include "renderer/device/check.h"

namespace flaneur {
namespace {

std::string reason(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "the machine is out of memory; try fewer walkers or a smaller city";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "the device is out of memory; try a smaller picture, fewer walkers or another --device";
        case VK_ERROR_DEVICE_LOST:
            return "the device was lost (the driver reset it); start again, or try another --device";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "the window's surface was lost";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "the driver failed to start; try another --device";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no Vulkan driver was found; install mesa-vulkan-drivers or your GPU's driver";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "a layer is missing; install vulkan-validationlayers or run without validation";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "an extension is missing";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "the device lacks a feature";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "the driver allows no more objects of this kind";
        case VK_TIMEOUT:
            return "the device did not answer in time";
        default:
            return "error code " + std::to_string(static_cast<int>(result));
    }
}

}  // namespace

Error vulkan_error(VkResult result, const std::string& doing) {
    return Error{"Vulkan could not " + doing + ": " + reason(result) + "."};
}

}  // namespace flaneur
