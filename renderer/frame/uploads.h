// What a frame hands to the device: its buffers, and what its bindings refer to.
#pragma once

#include "renderer/frame/plan.h"

namespace flaneur {

// Fills the slot's buffers and descriptor set. People and casters of shadows whom the host skins are skinned
// here, which completes their draws in the plan. Targets must fit.
Result<void> upload_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                          FramePlan& plan);
// Of a frame that is panels alone: theirs, and bindings to what the slot's last frame had.
Result<void> upload_panels(Renderer& renderer, FrameSlot& slot, const Panels& panels);

}  // namespace flaneur
