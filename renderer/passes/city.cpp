#include "renderer/frame.h"

namespace flaneur {

void draw_city(const FrameRecord& record) {
    const LitPipelines& pipelines = lit_pipelines(record);
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(record.commands, 0, 1, &record.renderer.scene.city_vertices.handle, &offset);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.city_prop);
    draw_indirect(record, record.plan.props);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.city_surface);
    draw_indirect(record, record.plan.surfaces[0]);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.city_facade);
    draw_indirect(record, record.plan.facades);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.city_surface);
    draw_indirect(record, record.plan.surfaces[1]);
    draw_indirect(record, record.plan.surfaces[2]);
    if (record.plan.scenery.count > 0) {
        vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.city_scenery);
        draw_indirect(record, record.plan.scenery);
    }
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.shade);
    draw_indirect(record, record.plan.shades);
}

}  // namespace flaneur
