#include "renderer/frame.h"

namespace flaneur {
namespace {

constexpr uint32_t k_corners = 6;  // of two triangles

void draw(const FrameRecord& record, VkPipeline pipeline, size_t first, size_t count) {
    if (count == 0) return;
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(record.commands, k_corners * static_cast<uint32_t>(count), 1,
              k_corners * static_cast<uint32_t>(first), 0);
}

}  // namespace

void draw_impostors(const FrameRecord& record) {
    const Renderer& renderer = record.renderer;
    draw(record, lit_pipelines(record).impostor, 0, renderer.crowd.impostors.size());
}

void draw_impostor_shadows(const FrameRecord& record) {
    const Renderer& renderer = record.renderer;
    draw(record, renderer.pipelines.shadow_impostor, renderer.crowd.impostors.size(),
         renderer.casters.impostors.size());
}

}  // namespace flaneur
