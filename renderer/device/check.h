// From VkResult to sentences.
#pragma once

#include <volk.h>

#include <string>

#include "sim/base/result.h"

namespace flaneur {

// "Vulkan could not <doing>: <why, and what to do>."
Error vulkan_error(VkResult result, const std::string& doing);

}  // namespace flaneur

// Leaves the function with an Error unless the Vulkan call succeeds.
#define FLANEUR_VK(call, doing)                                   \
    do {                                                          \
        if (VkResult vk_result = (call); vk_result != VK_SUCCESS) \
            return ::flaneur::vulkan_error(vk_result, doing);     \
    } while (false)

// Leaves the function with the Error of a Result<void> that failed.
#define FLANEUR_TRY(call)                                                     \
    do {                                                                      \
        if (auto try_result = (call); !try_result) return try_result.error(); \
    } while (false)
