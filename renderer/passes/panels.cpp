// What lies over the picture once it is done.
#include <algorithm>

#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

// Within the picture; empty where nothing is left.
VkRect2D scissor_of(const PanelDraw& draw, VkExtent2D extent) {
    const auto width = static_cast<float>(extent.width), height = static_cast<float>(extent.height);
    auto within = [](float x, float low, float high) {
        return x >= low ? std::min(x, high) : low;
    };  // or not a number
    const float left = within(draw.clip.x, 0, width), top = within(draw.clip.y, 0, height);
    const float right = within(draw.clip.z, left, width), bottom = within(draw.clip.w, top, height);
    return {{static_cast<int32_t>(left), static_cast<int32_t>(top)},
            {static_cast<uint32_t>(right - left), static_cast<uint32_t>(bottom - top)}};
}

}  // namespace

void scale_picture(const FrameRecord& record) {
    GpuImage &from = *record.target.image, &to = *record.target.scaled;
    image_to(record.commands, from, k_copied_from);
    image_freshly_to(record.commands, to, k_copied_to);
    VkImageBlit blit{};
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = {static_cast<int32_t>(from.width), static_cast<int32_t>(from.height), 1};
    blit.dstOffsets[1] = {static_cast<int32_t>(to.width), static_cast<int32_t>(to.height), 1};
    vkCmdBlitImage(record.commands, from.handle, k_copied_from.layout, to.handle, k_copied_to.layout, 1,
                   &blit, VK_FILTER_LINEAR);
}

void draw_panels(const FrameRecord& record) {
    GpuImage& image = final_image(record);
    image_to(record.commands, image, k_colour_target);
    begin_over(record, image, VK_ATTACHMENT_LOAD_OP_LOAD);
    bind(record, record.target.panels);
    bind_vertices(record, record.slot.panel_vertices.handle);
    vkCmdBindIndexBuffer(record.commands, record.slot.panel_indices.handle, 0, VK_INDEX_TYPE_UINT16);
    const glm::vec2 scale(2.0f / static_cast<float>(image.width), 2.0f / static_cast<float>(image.height));
    vkCmdPushConstants(record.commands, record.renderer.pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof scale, &scale);
    for (const PanelDraw& draw : record.plan.panels) {
        const VkRect2D scissor = scissor_of(draw, extent_of(image));
        if (draw.index_count == 0 || scissor.extent.width == 0 || scissor.extent.height == 0) continue;
        vkCmdSetScissor(record.commands, 0, 1, &scissor);
        vkCmdDrawIndexed(record.commands, draw.index_count, 1, draw.first_index, draw.vertex_offset, 0);
    }
    vkCmdEndRendering(record.commands);
}

}  // namespace flaneur
