#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

constexpr VkImageAspectFlags k_depth_aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
constexpr VkDeviceSize k_shadow_bytes = 2;  // of a texel

uint32_t layer_of(int first, uint8_t map) { return static_cast<uint32_t>(first) + map; }
uint32_t seen_layer(const FrameRecord& record, int first) {
    return layer_of(first, record.plan.shadows.seen[0]);
}

// `is_fresh`: begins with nothing, rather than with what is there.
void begin_map(const FrameRecord& record, VkImageView view, const ShadowBox& box, const TexelRect& rows,
               bool is_fresh) {
    VkRenderingAttachmentInfo depth =
        attachment(view, is_fresh ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    depth.clearValue.depthStencil.depth = 1;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    const uint32_t resolution = record.renderer.quality.shadow_resolution;
    info.renderArea = {{static_cast<int32_t>(rows.x), static_cast<int32_t>(rows.y)},
                       {rows.width, rows.height}};
    info.layerCount = 1;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, {resolution, resolution});
    vkCmdSetScissor(record.commands, 0, 1, &info.renderArea);
    vkCmdPushConstants(record.commands, record.renderer.pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof(mat4), &box.map_from_world);
}

void draw_slices(const FrameRecord& record, const ShadowSlices& slices, const CityCasters& casters,
                 uint32_t layer) {
    ShadowMaps& maps = record.renderer.shadows;
    (slices.first == 0 ? image_freshly_to : image_to)(record.commands, maps.map, k_depth_target, {layer, 1});
    begin_map(record, maps.layer_views[layer], slices.box,
              rows_of(slices, record.renderer.quality.shadow_resolution), true);
    bind(record, record.renderer.pipelines.shadow_city);
    bind_vertices(record, record.renderer.scene.city_vertices.handle);
    draw_indirect(record, casters.opaque);
    if (casters.scenery.count > 0) {
        bind(record, record.renderer.pipelines.shadow_scenery);
        draw_indirect(record, casters.scenery);
    }
    vkCmdEndRendering(record.commands);
}

void copy_layer(const FrameRecord& record, uint32_t from, uint32_t to, std::span<const TexelRect> rects,
                bool is_fresh) {
    if (rects.empty()) return;
    GpuImage& map = record.renderer.shadows.map;
    image_to(record.commands, map, k_copied_from, {from, 1});
    (is_fresh ? image_freshly_to : image_to)(record.commands, map, k_copied_to, {to, 1});
    std::vector<VkImageCopy> regions;
    for (const TexelRect& rect : rects) {
        VkImageCopy& region = regions.emplace_back();
        region.srcSubresource = {k_depth_aspect, 0, from, 1};
        region.dstSubresource = {k_depth_aspect, 0, to, 1};
        region.srcOffset = region.dstOffset = {static_cast<int32_t>(rect.x), static_cast<int32_t>(rect.y), 0};
        region.extent = {rect.width, rect.height, 1};
    }
    vkCmdCopyImage(record.commands, map.handle, k_copied_from.layout, map.handle, k_copied_to.layout,
                   static_cast<uint32_t>(regions.size()), regions.data());
}

// Where the host lights, to its own layer `to`.
void copy_to_host(const FrameRecord& record, uint32_t layer, uint32_t to, std::span<const TexelRect> rects) {
    if (rects.empty() || !record.renderer.is_lit_on_host) return;
    GpuImage& map = record.renderer.shadows.map;
    image_to(record.commands, map, k_copied_from, {layer, 1});
    const VkDeviceSize first = VkDeviceSize{map.width} * map.height * to;
    std::vector<VkBufferImageCopy> regions;
    for (const TexelRect& rect : rects) {
        VkBufferImageCopy& region = regions.emplace_back();
        region.bufferOffset = k_shadow_bytes * (first + VkDeviceSize{rect.y} * map.width + rect.x);
        region.bufferRowLength = map.width;
        region.imageSubresource = {k_depth_aspect, 0, layer, 1};
        region.imageOffset = {static_cast<int32_t>(rect.x), static_cast<int32_t>(rect.y), 0};
        region.imageExtent = {rect.width, rect.height, 1};
    }
    vkCmdCopyImageToBuffer(record.commands, map.handle, k_copied_from.layout,
                           record.renderer.shadows.copy.handle, static_cast<uint32_t>(regions.size()),
                           regions.data());
}

void draw_city_shadows(const FrameRecord& record) {
    FLANEUR_ZONE("city shadows", record);
    for (size_t i = 0; i < record.plan.slices.size(); ++i) {
        const ShadowSlices& slices = record.plan.slices[i];
        const TexelRect rows = rows_of(slices, record.renderer.quality.shadow_resolution);
        const bool is_near = slices.reach == Reach::near;
        const uint32_t layer = layer_of(is_near ? k_still_layers : k_far_layers, slices.map);
        draw_slices(record, slices, record.plan.slice_casters[i], layer);
        copy_to_host(record, layer, layer, std::span(&rows, 1));
        if (!is_near) continue;
        const uint32_t near = layer_of(k_near_layers, slices.map);
        copy_layer(record, layer, near, std::span(&rows, 1), slices.first == 0);
        copy_to_host(record, layer, near, std::span(&rows, 1));
    }
}

void draw_crowd_shadows(const FrameRecord& record) {
    ShadowMaps& maps = record.renderer.shadows;
    const CrowdDraws& casters = record.renderer.casters;
    const uint32_t near = seen_layer(record, k_near_layers),
                   resolution = record.renderer.quality.shadow_resolution;
    FLANEUR_ZONE("crowd shadows", record);
    copy_layer(record, seen_layer(record, k_still_layers), near, record.plan.near_changed, false);
    if (!casters.instances.empty() || !casters.impostors.empty()) {
        image_to(record.commands, maps.map, k_depth_target, {near, 1});
        begin_map(record, maps.layer_views[near], record.plan.near, {0, 0, resolution, resolution}, false);
        draw_people_shadows(record);
        vkCmdEndRendering(record.commands);
    }
    if (!record.plan.slices.empty()) wait_between(record.commands, k_copied_to, k_copied_to);
    copy_to_host(record, near, near, record.plan.near_changed);
}

}  // namespace

void draw_shadows(const FrameRecord& record) {
    if (record.plan.has_shadows) {
        if (!record.plan.slices.empty()) draw_city_shadows(record);
        draw_crowd_shadows(record);
    }
    // Also maps that nobody looks at must be such as can be looked at.
    image_to(record.commands, record.renderer.shadows.map, k_sampled);
}

}  // namespace flaneur
