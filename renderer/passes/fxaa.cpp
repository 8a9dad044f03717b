#include "renderer/frame.h"

namespace flaneur {

void draw_fxaa(const FrameRecord& record) {
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = record.target.view;
    colour.imageLayout = k_colour_target.layout;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = record.target.extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, record.target.extent);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, record.target.fxaa);
    vkCmdDraw(record.commands, 3, 1, 0, 0);
    vkCmdEndRendering(record.commands);
}

}  // namespace flaneur
