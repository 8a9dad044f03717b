// What one frame in flight owns, and how it is handed to the device and waited for.
#pragma once

#include "renderer/device/resources.h"
#include "renderer/frame/stages.h"

namespace flaneur {

inline constexpr uint32_t k_slots = 2;  // frames in flight in a window

struct SkinBuffers {
    // SkinnedVertex; uint32_t, counted from the vertices of each draw
    Buffer vertices{"skinned vertices"}, indices{"skinned indices"};
};

struct FrameSlot {
    VkCommandPool pool = {};
    VkCommandBuffer commands = {};
    VkFence done = {};
    VkSemaphore image_ready = {};  // of a window
    VkDescriptorSet set = {};
    Stages stages;
    Buffer constants{"frame constants"}, instances{"instances"}, palette{"palette"}, impostors{"impostors"},
        sky{"sky"}, draws{"draws"}, contacts{"contacts"}, lines{"lines"}, fills{"fills"},
        panel_vertices{"panel vertices"}, panel_indices{"panel indices"};
    SkinBuffers crowd, casters;     // skinned by the host
    Buffer picture{"lit picture"};  // lit by the host, on the way into a window
    bool is_pending = false;        // submitted, and not yet waited for
};
Result<void> make_slot(const Device& device, FrameSlot& slot);
Result<void> make_image_ready(const Device& device, FrameSlot& slot);
void destroy_slot(const Device& device, FrameSlot& slot);

// What is waited for, before which stage; null: nothing.
struct Wait {
    VkSemaphore semaphore = {};
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
};
// Hands what was recorded to the device. `signal` may be null.
Result<void> submit_slot(const Device& device, FrameSlot& slot, Wait wait, VkSemaphore signal);

// Waits until the slot's frame, if any, is done, and reads what its stages took.
Result<void> finish_slot(const Device& device, FrameSlot& slot, FrameStats& stats);

}  // namespace flaneur
