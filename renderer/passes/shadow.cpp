#include "renderer/passes/passes.h"

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

void draw_city_into(const FrameRecord& record, VkImageView view, const ShadowBox& box,
                    const CityCasters& casters) {
    begin_map(record, view, box, true);
    bind(record, record.renderer.pipelines.shadow_city);
    bind_vertices(record, record.renderer.scene.city_vertices.handle);
    draw_indirect(record, casters.opaque);
    if (casters.scenery.count > 0) {
        bind(record, record.renderer.pipelines.shadow_scenery);
        draw_indirect(record, casters.scenery);
    }
    vkCmdEndRendering(record.commands);
}

void draw_city_shadows(const FrameRecord& record) {
    GpuImage& map = record.renderer.shadows.map;
    const ShadowBoxes& boxes = record.plan.boxes;
    auto draw = [&](uint32_t layer, const ShadowBox& box, const CityCasters& casters) {
        image_freshly_to(record.commands, map, k_depth_target, {layer, 1});
        draw_city_into(record, record.renderer.shadows.layer_views[layer], box, casters);
    };
    begin_stage(record, "city shadows");
    if (boxes.is_near_new) draw(k_still_layer, boxes.near, record.plan.near_casters);
    if (boxes.is_far_new) draw(k_far_layer, boxes.far, record.plan.far_casters);
    end_stage(record);
}

void copy_still_layer(const FrameRecord& record) {
    GpuImage& map = record.renderer.shadows.map;
    image_to(record.commands, map, k_copied_from, {k_still_layer, 1});
    image_freshly_to(record.commands, map, k_copied_to, {k_near_layer, 1});
    VkImageCopy region{};
    region.srcSubresource = {k_depth_aspect, 0, k_still_layer, 1};
    region.dstSubresource = {k_depth_aspect, 0, k_near_layer, 1};
    region.extent = {map.width, map.height, 1};
    vkCmdCopyImage(record.commands, map.handle, k_copied_from.layout, map.handle, k_copied_to.layout, 1,
                   &region);
}

void draw_crowd_shadows(const FrameRecord& record) {
    ShadowMaps& maps = record.renderer.shadows;
    const CrowdDraws& casters = record.renderer.casters;
    begin_stage(record, "crowd shadows");
    copy_still_layer(record);
    if (!casters.instances.empty() || !casters.impostors.empty()) {
        image_to(record.commands, maps.map, k_depth_target, {k_near_layer, 1});
        begin_map(record, maps.layer_views[k_near_layer], record.plan.boxes.near, false);
        draw_people_shadows(record);
        vkCmdEndRendering(record.commands);
    }
    end_stage(record);
}

// Where the host lights, what it knows of maps that have changed.
void copy_to_host(const FrameRecord& record, uint32_t layer) {
    GpuImage& map = record.renderer.shadows.map;
    image_to(record.commands, map, k_copied_from, {layer, 1});
    VkBufferImageCopy region{};
    region.bufferOffset = VkDeviceSize{2} * map.width * map.height * layer;
    region.imageSubresource = {k_depth_aspect, 0, layer, 1};
    region.imageExtent = {map.width, map.height, 1};
    vkCmdCopyImageToBuffer(record.commands, map.handle, k_copied_from.layout, record.renderer.shadows.copy.handle, 1,
                           &region);
}

void copy_changed(const FrameRecord& record) {
    begin_stage(record, "shadows to host");
    if (record.plan.boxes.is_near_new) copy_to_host(record, k_still_layer);
    if (record.plan.boxes.is_far_new) copy_to_host(record, k_far_layer);
    copy_to_host(record, k_near_layer);
    end_stage(record);
}

}  // namespace

void draw_shadows(const FrameRecord& record) {
    if (record.plan.has_shadows) {
        if (record.plan.boxes.is_near_new || record.plan.boxes.is_far_new) draw_city_shadows(record);
        draw_crowd_shadows(record);
        if (record.renderer.is_lit_on_host) copy_changed(record);
    }
    // Also maps that nobody looks at must be such as can be looked at.
    image_to(record.commands, record.renderer.shadows.map, k_sampled);
}

}  // namespace flaneur
