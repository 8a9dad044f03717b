#include "renderer/check.h"
#include "renderer/frame.h"

namespace flaneur {

namespace {

Result<void> skin_into(Renderer& renderer, const SkinPlan& skin, std::span<const WalkerInstance> instances,
                       std::span<const JointTransform> palette, const SkinView& view, SkinBuffers& buffers,
                       std::span<DrawCommand> draws) {
    if (skin.batches.empty()) return {};
    const Device& device = renderer.device;
    FLANEUR_TRY(reserve_buffer(device, sizeof(SkinnedVertex) * skin.vertices,
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryKind::upload, buffers.vertices));
    FLANEUR_TRY(reserve_buffer(device, sizeof(uint32_t) * skin.indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                               MemoryKind::upload, buffers.indices));
    renderer.skin_scratch.resize(static_cast<size_t>(thread_count(*renderer.workers)));
    parallel_for(*renderer.workers, skin.batches.size(), 1, [&](size_t begin, size_t end, int thread) {
        for (size_t i = begin; i < end; ++i)
            draws[i] = skin_batch(skin, skin.batches[i], instances, palette, view,
                                  renderer.skin_scratch[static_cast<size_t>(thread)],
                                  static_cast<SkinnedVertex*>(buffers.vertices.mapped),
                                  static_cast<uint32_t*>(buffers.indices.mapped));
    });
    return {};
}

// Leaves another index buffer bound.
void draw(const FrameRecord& record, VkPipeline pipeline, VkBuffer vertices, VkBuffer indices,
          DrawRange range) {
    if (range.count == 0) return;
    const VkDeviceSize offset = 0;
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindVertexBuffers(record.commands, 0, 1, &vertices, &offset);
    vkCmdBindIndexBuffer(record.commands, indices, 0, VK_INDEX_TYPE_UINT32);
    draw_indirect(record, range);
}

// Both those that the host has skinned and those that the device skins.
void draw_people(const FrameRecord& record, VkPipeline skinned, const SkinBuffers& buffers,
                 DrawRange skinned_range, VkPipeline pipeline, DrawRange range) {
    const GpuScene& scene = record.renderer.scene;
    draw(record, skinned, buffers.vertices.handle, buffers.indices.handle, skinned_range);
    draw(record, pipeline, scene.person_vertices.handle, scene.indices.handle, range);
    vkCmdBindIndexBuffer(record.commands, scene.indices.handle, 0, VK_INDEX_TYPE_UINT32);
}

}  // namespace

Result<void> skin_people(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                         FramePlan& plan) {
    auto draws = [&](DrawRange range) { return std::span(plan.draws).subspan(range.first, range.count); };
    FLANEUR_TRY(skin_into(renderer, plan.crowd_skin, renderer.crowd.instances, input.palette,
                          skin_view(plan.view, extent.width, extent.height, renderer.quality.samples),
                          slot.crowd, draws(plan.crowd_skinned)));
    return skin_into(renderer, plan.casters_skin, renderer.casters.instances, input.palette,
                     skin_view(plan.near_box, renderer.quality.shadow_resolution), slot.casters,
                     draws(plan.casters_skinned));
}

void draw_crowd(const FrameRecord& record) {
    const LitPipelines& lit = lit_pipelines(record);
    const int textured = record.renderer.scene.is_textured && !record.plan.are_tinted;
    draw_people(record, lit.crowd_skinned[textured], record.slot.crowd, record.plan.crowd_skinned,
                lit.crowd[textured], record.plan.crowd);
}

void draw_crowd_shadows(const FrameRecord& record) {
    const Pipelines& pipelines = record.renderer.pipelines;
    draw_people(record, pipelines.shadow_skinned, record.slot.casters, record.plan.casters_skinned,
                pipelines.shadow_crowd, record.plan.casters);
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
