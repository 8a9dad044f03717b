#include "renderer/passes/passes.h"

namespace flaneur {

void draw_fxaa(const FrameRecord& record) {
    image_to(record.commands, record.renderer.targets.colour, k_sampled);
    image_freshly_to(record.commands, record.target.image, k_colour_target);
    draw_over(record, record.target.image, VK_ATTACHMENT_LOAD_OP_DONT_CARE, record.target.fxaa);
}

}  // namespace flaneur
