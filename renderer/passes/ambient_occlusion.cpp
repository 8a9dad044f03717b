#include "renderer/frame.h"

namespace flaneur {

void draw_occlusion(const FrameRecord& record) {
    const PictureTargets& targets = record.renderer.targets;
    auto barrier = [&](const GpuImage& image, Access from, Access to) {
        image_barrier(record.commands, image.handle, aspect_of(image.format), from, to);
    };
    barrier(targets.depth, k_depth_target, k_sampled);
    barrier(targets.occlusion, discarded(k_sampled), k_colour_target);
    const GpuImage &occlusion = targets.occlusion, &colour = targets.colour;
    draw_over(record, occlusion.view, {occlusion.width, occlusion.height}, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
              record.renderer.pipelines.occlusion);
    barrier(targets.occlusion, k_colour_target, k_sampled);
    draw_over(record, colour.view, {colour.width, colour.height}, VK_ATTACHMENT_LOAD_OP_LOAD,
              record.renderer.pipelines.occlude);
}

}  // namespace flaneur
