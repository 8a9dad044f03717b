#include "renderer/frame/slot.h"

#include "renderer/device/check.h"
#include "renderer/device/names.h"
#include "sim/base/zone.h"

namespace flaneur {

Result<void> make_image_ready(const Device& device, FrameSlot& slot) {
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    FLANEUR_VK(vkCreateSemaphore(device.handle, &info, nullptr, &slot.image_ready), "make a semaphore");
    name_object(device, slot.image_ready, "window image is there");
    return {};
}

Result<void> make_slot(const Device& device, FrameSlot& slot) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = device.queue_family;
    FLANEUR_VK(vkCreateCommandPool(device.handle, &pool, nullptr, &slot.pool), "make a command pool");
    name_object(device, slot.pool, "frame");
    VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    commands.commandPool = slot.pool;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    FLANEUR_VK(vkAllocateCommandBuffers(device.handle, &commands, &slot.commands), "make a command buffer");
    name_object(device, slot.commands, "frame");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    FLANEUR_VK(vkCreateFence(device.handle, &fence, nullptr, &slot.done), "make a fence");
    name_object(device, slot.done, "frame is done");
    FLANEUR_TRY(make_image_ready(device, slot));
    return make_stages(device, slot.stages);
}

void destroy_slot(const Device& device, FrameSlot& slot) {
    for (Buffer* buffer : {&slot.constants, &slot.instances, &slot.palette, &slot.impostors, &slot.sky,
                           &slot.draws, &slot.contacts, &slot.lines, &slot.fills, &slot.panel_vertices,
                           &slot.panel_indices, &slot.crowd.vertices, &slot.crowd.indices,
                           &slot.casters.vertices, &slot.casters.indices, &slot.picture})
        destroy_buffer(device, *buffer);
    destroy_stages(device, slot.stages);
    if (slot.image_ready) vkDestroySemaphore(device.handle, slot.image_ready, nullptr);
    if (slot.done) vkDestroyFence(device.handle, slot.done, nullptr);
    if (slot.pool) vkDestroyCommandPool(device.handle, slot.pool, nullptr);
}

Result<void> submit_slot(const Device& device, FrameSlot& slot, Wait wait, VkSemaphore signal) {
    FLANEUR_ZONE("submit");
    VkSemaphoreSubmitInfo waits{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    waits.semaphore = wait.semaphore;
    waits.stageMask = wait.stage;
    VkSemaphoreSubmitInfo signals{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    signals.semaphore = signal;
    signals.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commands.commandBuffer = slot.commands;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.waitSemaphoreInfoCount = wait.semaphore ? 1 : 0;
    info.pWaitSemaphoreInfos = &waits;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    info.signalSemaphoreInfoCount = signal ? 1 : 0;
    info.pSignalSemaphoreInfos = &signals;
    FLANEUR_VK(vkResetFences(device.handle, 1, &slot.done), "submit a frame");
    FLANEUR_VK(vkQueueSubmit2(device.queue, 1, &info, slot.done), "submit a frame");
    slot.is_pending = true;
    return {};
}

Result<void> finish_slot(const Device& device, FrameSlot& slot, FrameStats& stats) {
    if (!slot.is_pending) return {};
    FLANEUR_ZONE("wait for the device");
    FLANEUR_VK(vkWaitForFences(device.handle, 1, &slot.done, VK_TRUE, UINT64_MAX), "finish a frame");
    slot.is_pending = false;
    return read_stages(device, slot.stages, stats.stages);
}

}  // namespace flaneur
