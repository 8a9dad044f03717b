// What is drawn over the picture: see-through people, fills on the ground, lines.
#include "renderer/frame.h"

namespace flaneur {
namespace {

constexpr float k_shown_behind = 0.25f;  // of a line behind things

void draw_lines(const FrameRecord& record, ViewPipeline pipeline, float shown) {
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      record.renderer.pipelines.views[static_cast<size_t>(pipeline)]);
    vkCmdPushConstants(record.commands, record.renderer.pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof shown, &shown);
    vkCmdDraw(record.commands, 6, record.plan.lines, 0, 0);
}

}  // namespace

void draw_overlay(const FrameRecord& record) {
    const VkDeviceSize offset = 0;
    if (record.plan.fills > 0) {
        vkCmdBindVertexBuffers(record.commands, 0, 1, &record.slot.fills.handle, &offset);
        vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                          record.renderer.pipelines.views[static_cast<size_t>(ViewPipeline::fill)]);
        vkCmdDraw(record.commands, record.plan.fills, 1, 0, 0);
    }
    if (record.plan.are_ghosts) draw_ghosts(record);
    if (record.plan.lines == 0) return;
    vkCmdBindVertexBuffers(record.commands, 0, 1, &record.slot.lines.handle, &offset);
    draw_lines(record, ViewPipeline::hidden_line, k_shown_behind);
    draw_lines(record, ViewPipeline::line, 1);
}

}  // namespace flaneur
