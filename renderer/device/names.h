// What things on the device are called, in debuggers and in what the validation layer says.
#pragma once

#include <string>

#include "renderer/device/device.h"

namespace flaneur {

void name_object(const Device& device, VkObjectType type, uint64_t handle, const std::string& name);

// Which type a handle is of. An instance has no name: loaders hand on their own handle of it, which NVIDIA's
// driver follows to nowhere.
#define FLANEUR_VK_TYPE(Handle, TYPE) \
    inline constexpr VkObjectType object_type(Handle) { return VK_OBJECT_TYPE_##TYPE; }
FLANEUR_VK_TYPE(VkDevice, DEVICE)
FLANEUR_VK_TYPE(VkQueue, QUEUE)
FLANEUR_VK_TYPE(VkBuffer, BUFFER)
FLANEUR_VK_TYPE(VkDeviceMemory, DEVICE_MEMORY)
FLANEUR_VK_TYPE(VkImage, IMAGE)
FLANEUR_VK_TYPE(VkImageView, IMAGE_VIEW)
FLANEUR_VK_TYPE(VkSampler, SAMPLER)
FLANEUR_VK_TYPE(VkCommandPool, COMMAND_POOL)
FLANEUR_VK_TYPE(VkCommandBuffer, COMMAND_BUFFER)
FLANEUR_VK_TYPE(VkFence, FENCE)
FLANEUR_VK_TYPE(VkSemaphore, SEMAPHORE)
FLANEUR_VK_TYPE(VkQueryPool, QUERY_POOL)
FLANEUR_VK_TYPE(VkDescriptorSetLayout, DESCRIPTOR_SET_LAYOUT)
FLANEUR_VK_TYPE(VkDescriptorPool, DESCRIPTOR_POOL)
FLANEUR_VK_TYPE(VkDescriptorSet, DESCRIPTOR_SET)
FLANEUR_VK_TYPE(VkShaderModule, SHADER_MODULE)
FLANEUR_VK_TYPE(VkPipelineLayout, PIPELINE_LAYOUT)
FLANEUR_VK_TYPE(VkPipeline, PIPELINE)
FLANEUR_VK_TYPE(VkSwapchainKHR, SWAPCHAIN_KHR)
#undef FLANEUR_VK_TYPE

// Where there is VK_EXT_debug_utils.
template <class Handle>
void name_object(const Device& device, Handle handle, const std::string& name) {
    name_object(device, object_type(handle), reinterpret_cast<uint64_t>(handle), name);
}

}  // namespace flaneur
