#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

constexpr VkImageAspectFlags k_depth_aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
constexpr VkDeviceSize k_shadow_bytes = 2;  // of a texel

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

// Where people's shadows were or will be, the near map is as the city's is.
void take_people_out(const FrameRecord& record) {
    if (record.plan.near_changed.empty()) return;
    GpuImage& map = record.renderer.shadows.map;
    image_to(record.commands, map, k_copied_from, {k_still_layer, 1});
    (record.plan.boxes.is_near_new ? image_freshly_to : image_to)(record.commands, map, k_copied_to, {k_near_layer, 1});
    std::vector<VkImageCopy> regions;
    for (const TexelRect& rect : record.plan.near_changed) {
        VkImageCopy& region = regions.emplace_back();
        region.srcSubresource = {k_depth_aspect, 0, k_still_layer, 1};
        region.dstSubresource = {k_depth_aspect, 0, k_near_layer, 1};
        region.srcOffset = region.dstOffset = {static_cast<int32_t>(rect.x), static_cast<int32_t>(rect.y), 0};
        region.extent = {rect.width, rect.height, 1};
    }
    vkCmdCopyImage(record.commands, map.handle, k_copied_from.layout, map.handle, k_copied_to.layout,
                   static_cast<uint32_t>(regions.size()), regions.data());
}

void draw_crowd_shadows(const FrameRecord& record) {
    ShadowMaps& maps = record.renderer.shadows;
    const CrowdDraws& casters = record.renderer.casters;
    begin_stage(record, "crowd shadows");
    take_people_out(record);
    if (!casters.instances.empty() || !casters.impostors.empty()) {
        image_to(record.commands, maps.map, k_depth_target, {k_near_layer, 1});
        begin_map(record, maps.layer_views[k_near_layer], record.plan.boxes.near, false);
        draw_people_shadows(record);
        vkCmdEndRendering(record.commands);
    }
    end_stage(record);
}

// Of a layer, for the host.
void copy_to_host(const FrameRecord& record, uint32_t layer, std::span<const TexelRect> rects) {
    if (rects.empty()) return;
    GpuImage& map = record.renderer.shadows.map;
    image_to(record.commands, map, k_copied_from, {layer, 1});
    const VkDeviceSize first = VkDeviceSize{map.width} * map.height * layer;
    std::vector<VkBufferImageCopy> regions;
    for (const TexelRect& rect : rects) {
        VkBufferImageCopy& region = regions.emplace_back();
        region.bufferOffset = k_shadow_bytes * (first + VkDeviceSize{rect.y} * map.width + rect.x);
        region.bufferRowLength = map.width;
        region.imageSubresource = {k_depth_aspect, 0, layer, 1};
        region.imageOffset = {static_cast<int32_t>(rect.x), static_cast<int32_t>(rect.y), 0};
        region.imageExtent = {rect.width, rect.height, 1};
    }
    vkCmdCopyImageToBuffer(record.commands, map.handle, k_copied_from.layout, record.renderer.shadows.copy.handle,
                           static_cast<uint32_t>(regions.size()), regions.data());
}

void copy_changed(const FrameRecord& record) {
    const uint32_t resolution = record.renderer.quality.shadow_resolution;
    const TexelRect whole{0, 0, resolution, resolution};
    begin_stage(record, "shadows to host");
    if (record.plan.boxes.is_near_new) copy_to_host(record, k_still_layer, std::span(&whole, 1));
    if (record.plan.boxes.is_far_new) copy_to_host(record, k_far_layer, std::span(&whole, 1));
    copy_to_host(record, k_near_layer, record.plan.near_changed);
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
