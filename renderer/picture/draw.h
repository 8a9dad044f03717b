// One frame, from what moves to a picture: the same for a window and off-screen.
#pragma once

#include "renderer/frame/record.h"

namespace flaneur {

// Draws into `target` with a free slot: culls, uploads, records and submits. `wait` and `signal` may be null.
Result<void> draw_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                        const PictureTarget& target, Wait wait, VkSemaphore signal);

// The same of a picture that lies in `target.staging`: with these panels over it. Refuses before the slot's
// first frame.
Result<void> draw_over_picture(Renderer& renderer, FrameSlot& slot, const Panels& panels,
                               const PictureTarget& target, Wait wait, VkSemaphore signal);

}  // namespace flaneur
