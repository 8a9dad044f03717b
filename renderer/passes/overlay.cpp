// What is drawn over the picture: see-through people, fills on the ground, lines.
#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

constexpr float k_shown_behind = 0.25f;  // of a line behind things

VkPipeline pipeline_of(const FrameRecord& record, ViewPipeline pipeline) {
    return record.renderer.pipelines.views[static_cast<size_t>(pipeline)];
}

void draw_lines(const FrameRecord& record, ViewPipeline pipeline, float shown) {
    bind(record, pipeline_of(record, pipeline));
    vkCmdPushConstants(record.commands, record.renderer.pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof shown, &shown);
    vkCmdDraw(record.commands, 6, record.plan.lines, 0, 0);
}

}  // namespace

void draw_overlay(const FrameRecord& record) {
    if (record.plan.fills > 0) {
        bind_vertices(record, record.slot.fills.handle);
        bind(record, pipeline_of(record, ViewPipeline::fill));
        vkCmdDraw(record.commands, record.plan.fills, 1, 0, 0);
    }
    if (record.plan.are_ghosts) draw_ghosts(record);
    if (record.plan.lines == 0) return;
    bind_vertices(record, record.slot.lines.handle);
    draw_lines(record, ViewPipeline::hidden_line, k_shown_behind);
    draw_lines(record, ViewPipeline::line, 1);
}

}  // namespace flaneur
