#include "renderer/frame.h"

namespace flaneur {

void draw_crowd(const FrameRecord& record) {
    const Renderer& renderer = record.renderer;
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(record.commands, 0, 1, &renderer.scene.person_vertices.handle, &offset);
    const int textured = renderer.scene.is_textured && !record.plan.are_tinted;
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      lit_pipelines(record).crowd_smooth[textured]);
    draw_indirect(record, record.plan.crowd_smooth);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      lit_pipelines(record).crowd_rigid[textured]);
    draw_indirect(record, record.plan.crowd_rigid);
}

void draw_contacts(const FrameRecord& record) {
    const uint32_t count = static_cast<uint32_t>(record.plan.contacts.size());
    if (count == 0) return;
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(record.commands, 0, 1, &record.slot.contacts.handle, &offset);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, lit_pipelines(record).contact);
    vkCmdDraw(record.commands, 6, count, 0, 0);
}

}  // namespace flaneur
