#include "renderer/frame.h"

namespace flaneur {
namespace {

void draw_over(const FrameRecord& record, const GpuImage& image, VkAttachmentLoadOp load,
               VkPipeline pipeline) {
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = image.view;
    colour.imageLayout = k_colour_target.layout;
    colour.loadOp = load;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {image.width, image.height};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, info.renderArea.extent);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(record.commands, 3, 1, 0, 0);
    vkCmdEndRendering(record.commands);
}

}  // namespace

void draw_occlusion(const FrameRecord& record) {
    const PictureTargets& targets = record.renderer.targets;
    auto barrier = [&](const GpuImage& image, Access from, Access to) {
        image_barrier(record.commands, image.handle, aspect_of(image.format), from, to);
    };
    barrier(targets.depth, k_depth_target, k_sampled);
    barrier(targets.occlusion, discarded(k_sampled), k_colour_target);
    draw_over(record, targets.occlusion, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
              record.renderer.pipelines.occlusion);
    barrier(targets.occlusion, k_colour_target, k_sampled);
    draw_over(record, targets.colour, VK_ATTACHMENT_LOAD_OP_LOAD, record.renderer.pipelines.occlude);
}

}  // namespace flaneur
