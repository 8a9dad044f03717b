#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

// Leaves another index buffer bound.
void draw_meshes(const FrameRecord& record, VkPipeline pipeline, VkBuffer vertices, VkBuffer indices,
                 DrawRange range) {
    if (range.count == 0) return;
    bind(record, pipeline);
    bind_vertices(record, vertices);
    vkCmdBindIndexBuffer(record.commands, indices, 0, VK_INDEX_TYPE_UINT32);
    draw_indirect(record, range);
}

// Both those that the host has skinned and those that the device skins.
void draw_skinned(const FrameRecord& record, VkPipeline skinned, const SkinBuffers& buffers,
                  DrawRange skinned_range, VkPipeline pipeline, DrawRange range) {
    const GpuScene& scene = record.renderer.scene;
    draw_meshes(record, skinned, buffers.vertices.handle, buffers.indices.handle, skinned_range);
    draw_meshes(record, pipeline, scene.person_vertices.handle, scene.person_indices.handle, range);
    vkCmdBindIndexBuffer(record.commands, scene.city_indices.handle, 0, VK_INDEX_TYPE_UINT32);
}

// `first`: of the slot's impostors.
void draw_impostors(const FrameRecord& record, VkPipeline pipeline, size_t first, size_t count) {
    constexpr uint32_t corners = 6;  // of two triangles
    if (count == 0) return;
    bind(record, pipeline);
    vkCmdDraw(record.commands, corners * static_cast<uint32_t>(count), 1,
              corners * static_cast<uint32_t>(first), 0);
}

}  // namespace

void draw_people(const FrameRecord& record) {
    const SurfacePipelines& surfaces = record.renderer.pipelines.surfaces;
    const FramePlan& plan = record.plan;
    const int textured = record.renderer.scene.is_textured && !plan.are_tinted;
    if (!plan.are_ghosts)
        draw_skinned(record, surfaces.crowd_skinned[textured], record.slot.crowd, plan.crowd_skinned,
                     surfaces.crowd[textured], plan.crowd);
    draw_impostors(record, surfaces.impostor, 0, record.renderer.crowd.impostors.size());
}

void draw_people_shadows(const FrameRecord& record) {
    const Pipelines& pipelines = record.renderer.pipelines;
    draw_skinned(record, pipelines.shadow_skinned, record.slot.casters, record.plan.casters_skinned,
                 pipelines.shadow_crowd, record.plan.casters);
    draw_impostors(record, pipelines.shadow_impostor, record.renderer.crowd.impostors.size(),
                   record.renderer.casters.impostors.size());
}

}  // namespace flaneur
