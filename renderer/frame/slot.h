// What one frame in flight owns, and how it is handed to the device and waited for.
#pragma once

#include "renderer/device/resources.h"
#include "renderer/frame/stages.h"

namespace flaneur {

inline constexpr uint32_t k_slots = 2;  // frames in flight in a window

struct SkinBuffers {
    Buffer vertices, indices;  // SkinnedVertex; uint32_t, counted from the vertices of each draw
};

struct FrameSlot {
    VkCommandPool pool = {};
    VkCommandBuffer commands = {};
    VkFence done = {};
    VkSemaphore image_ready = {};  // of a window
    VkDescriptorSet set = {};
    Stages stages;
    Buffer constants, instances, palette, impostors, draws, contacts, lines, fills;
    SkinBuffers crowd, casters;  // skinned by the host
    bool is_pending = false;     // submitted, and not yet waited for
};
Result<void> make_slot(const Device& device, FrameSlot& slot);
Result<void> make_image_ready(const Device& device, FrameSlot& slot);
void destroy_slot(const Device& device, FrameSlot& slot);

// Hands what was recorded to the device. `wait` and `signal` may be null.
Result<void> submit_slot(const Device& device, FrameSlot& slot, VkSemaphore wait, VkSemaphore signal);

// Waits until the slot's frame, if any, is done, and reads what its stages took.
Result<void> finish_slot(const Device& device, FrameSlot& slot, FrameStats& stats);

}  // namespace flaneur
