#include "renderer/check.h"
#include "renderer/frame.h"

namespace flaneur {

Result<void> skin_crowd(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                        FramePlan& plan) {
    const SkinPlan& skin = plan.skin;
    if (skin.batches.empty()) return {};
    const Device& device = renderer.device;
    FLANEUR_TRY(reserve_buffer(device, sizeof(SkinnedVertex) * skin.vertices,
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryKind::upload, slot.skinned_vertices));
    FLANEUR_TRY(reserve_buffer(device, sizeof(uint32_t) * skin.indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                               MemoryKind::upload, slot.skinned_indices));
    const SkinView view{plan.view.clip_from_world, static_cast<float>(extent.width),
                        static_cast<float>(extent.height), renderer.quality.samples};
    renderer.skin_scratch.resize(static_cast<size_t>(thread_count(*renderer.workers)));
    parallel_for(*renderer.workers, skin.batches.size(), 1, [&](size_t begin, size_t end, int thread) {
        for (size_t i = begin; i < end; ++i)
            plan.draws[plan.crowd_skinned.first + i] =
                skin_batch(skin, skin.batches[i], renderer.crowd.instances, input.palette, view,
                           renderer.skin_scratch[static_cast<size_t>(thread)],
                           static_cast<SkinnedVertex*>(slot.skinned_vertices.mapped),
                           static_cast<uint32_t*>(slot.skinned_indices.mapped));
    });
    return {};
}

void draw_crowd(const FrameRecord& record) {
    const Renderer& renderer = record.renderer;
    const int textured = renderer.scene.is_textured && !record.plan.are_tinted;
    auto draw = [&](VkPipeline pipeline, VkBuffer vertices, VkBuffer indices, DrawRange range) {
        if (range.count == 0) return;
        const VkDeviceSize offset = 0;
        vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vkCmdBindVertexBuffers(record.commands, 0, 1, &vertices, &offset);
        vkCmdBindIndexBuffer(record.commands, indices, 0, VK_INDEX_TYPE_UINT32);
        draw_indirect(record, range);
    };
    const LitPipelines& lit = lit_pipelines(record);
    draw(lit.crowd_skinned[textured], record.slot.skinned_vertices.handle, record.slot.skinned_indices.handle,
         record.plan.crowd_skinned);
    draw(lit.crowd[textured], renderer.scene.person_vertices.handle, renderer.scene.indices.handle,
         record.plan.crowd);
    vkCmdBindIndexBuffer(record.commands, renderer.scene.indices.handle, 0, VK_INDEX_TYPE_UINT32);
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
