#include "renderer/frame.h"

namespace flaneur {
namespace {

constexpr VkImageAspectFlags k_depth_aspect = VK_IMAGE_ASPECT_DEPTH_BIT;

// `is_fresh`: begins with nothing, rather than with what is there.
void begin_map(const FrameRecord& record, VkImageView view, const ShadowBox& box, bool is_fresh) {
    VkRenderingAttachmentInfo depth =
        attachment(view, is_fresh ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    depth.clearValue.depthStencil.depth = 1;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    const uint32_t resolution = record.renderer.quality.shadow_resolution;
    info.renderArea.extent = {resolution, resolution};
    info.layerCount = 1;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, info.renderArea.extent);
    vkCmdPushConstants(record.commands, record.renderer.pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof(mat4), &box.map_from_world);
}

void draw_city_into(const FrameRecord& record, VkImageView view, const ShadowBox& box, DrawRange range,
                    DrawRange scenery) {
    begin_map(record, view, box, true);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      record.renderer.pipelines.shadow_city);
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(record.commands, 0, 1, &record.renderer.scene.city_vertices.handle, &offset);
    draw_indirect(record, range);
    if (scenery.count > 0) {
        vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                          record.renderer.pipelines.shadow_scenery);
        draw_indirect(record, scenery);
    }
    vkCmdEndRendering(record.commands);
}

void copy_still_map(const FrameRecord& record) {
    VkImageCopy region{};
    region.srcSubresource = {k_depth_aspect, 0, 0, 1};
    region.dstSubresource = {k_depth_aspect, 0, k_near_layer, 1};
    const ShadowMaps& maps = record.renderer.shadows;
    region.extent = {maps.still.width, maps.still.height, 1};
    vkCmdCopyImage(record.commands, maps.still.handle, k_copied_from.layout, maps.map.handle,
                   k_copied_to.layout, 1, &region);
}

}  // namespace

void draw_shadows(const FrameRecord& record) {
    const ShadowMaps& maps = record.renderer.shadows;
    const FramePlan& plan = record.plan;
    auto barrier = [&](const GpuImage& image, Access from, Access to, LayerRange range = {}) {
        image_barrier(record.commands, image.handle, k_depth_aspect, from, to, range);
    };
    if (!plan.has_shadows) {  // nobody looks at the maps, but they must be such as can be looked at
        barrier(maps.map, discarded(k_sampled), k_sampled);
        return;
    }
    constexpr LayerRange near_layer{k_near_layer, 1}, far_layer{k_far_layer, 1};
    if (plan.refresh_near || plan.refresh_far) {
        begin_stage(record, "city shadows");
        if (plan.refresh_near) {
            barrier(maps.still, discarded(k_copied_from), k_depth_target);
            draw_city_into(record, maps.still.view, plan.near_box, plan.near_city, plan.near_scenery);
            barrier(maps.still, k_depth_target, k_copied_from);
        }
        if (plan.refresh_far) {
            barrier(maps.map, discarded(k_sampled), k_depth_target, far_layer);
            draw_city_into(record, maps.layer_views[k_far_layer], plan.far_box, plan.far_city,
                           plan.far_scenery);
            barrier(maps.map, k_depth_target, k_sampled, far_layer);
        }
        end_stage(record);
    }
    begin_stage(record, "crowd shadows");
    barrier(maps.map, discarded(k_sampled), k_copied_to, near_layer);
    copy_still_map(record);
    barrier(maps.map, k_copied_to, k_depth_target, near_layer);
    if (!record.renderer.casters.instances.empty() || !record.renderer.casters.impostors.empty()) {
        begin_map(record, maps.layer_views[k_near_layer], plan.near_box, false);
        draw_crowd_shadows(record);
        draw_impostor_shadows(record);
        vkCmdEndRendering(record.commands);
    }
    barrier(maps.map, k_depth_target, k_sampled, near_layer);
    end_stage(record);
}

}  // namespace flaneur
