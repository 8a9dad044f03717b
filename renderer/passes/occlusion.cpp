#include "renderer/passes/passes.h"

namespace flaneur {

void draw_occlusion(const FrameRecord& record) {
    const Pipelines& pipelines = record.renderer.pipelines;
    PictureTargets& targets = record.renderer.targets;
    image_to(record.commands, targets.depth, k_sampled);
    image_freshly_to(record.commands, targets.occlusion, k_colour_target);
    draw_over(record, targets.occlusion, VK_ATTACHMENT_LOAD_OP_DONT_CARE, pipelines.occlusion);
    image_to(record.commands, targets.occlusion, k_sampled);
    image_freshly_to(record.commands, targets.even_occlusion, k_colour_target);
    draw_over(record, targets.even_occlusion, VK_ATTACHMENT_LOAD_OP_DONT_CARE, pipelines.even_out);
    image_to(record.commands, targets.even_occlusion, k_sampled);
    image_to(record.commands, targets.colour, k_colour_target);
    draw_over(record, targets.colour, VK_ATTACHMENT_LOAD_OP_LOAD, pipelines.occlude);
}

}  // namespace flaneur
