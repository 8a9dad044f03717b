#include "renderer/frame/record.h"

#include <algorithm>

namespace flaneur {

VkExtent2D extent_of(const GpuImage& image) { return {image.width, image.height}; }

void set_viewport(VkCommandBuffer commands, VkExtent2D extent) {
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

void bind(const FrameRecord& record, VkPipeline pipeline) {
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
}

void bind_vertices(const FrameRecord& record, VkBuffer vertices) {
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(record.commands, 0, 1, &vertices, &offset);
}

void draw_indirect(const FrameRecord& record, DrawRange range) {
    draw_indexed_indirect(record.renderer.device, record.commands, record.slot.draws.handle, range.first,
                          range.count);
}

void begin_over(const FrameRecord& record, const GpuImage& image, VkAttachmentLoadOp load) {
    const VkRenderingAttachmentInfo colour = attachment(image.view, load);
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent_of(image);
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, info.renderArea.extent);
}

void draw_over(const FrameRecord& record, const GpuImage& image, VkAttachmentLoadOp load,
               VkPipeline pipeline) {
    begin_over(record, image, load);
    bind(record, pipeline);
    vkCmdDraw(record.commands, 3, 1, 0, 0);
    vkCmdEndRendering(record.commands);
}

}  // namespace flaneur
