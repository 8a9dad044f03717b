#include "renderer/picture/picture.h"

#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

// What is drawn with depth into the same samples, each a stage of its own that waits for the one before.
struct Pass {
    const char* name;
    void (*draw)(const FrameRecord&);
};

bool has_overlay(const FramePlan& plan) { return plan.lines > 0 || plan.fills > 0 || plan.are_ghosts; }

std::vector<Pass> passes_of(const FramePlan& plan) {
    if (plan.backdrop) return {{"crowd", draw_plain}};
    std::vector<Pass> passes;
    if (plan.surfaces_view != Surfaces::lit)
        passes = {{"paint", draw_paint}};
    else if (plan.times_passes)
        passes = {{"crowd", draw_people}, {"city", draw_city}, {"sky", draw_sky}};
    else
        passes = {{"scene", draw_scene}};
    if (has_overlay(plan)) passes.push_back({"overlay", draw_overlay});
    return passes;
}

// Begins to draw; the first pass over nothing; after the last one samples become pixels.
void begin_pass(const FrameRecord& record, GpuImage& pixels, bool is_first, bool is_last) {
    PictureTargets& targets = record.renderer.targets;
    const std::optional<glm::vec3>& backdrop = record.plan.backdrop;
    const bool has_samples = targets.samples.view != VK_NULL_HANDLE;
    GpuImage& drawn_into = has_samples ? targets.samples : pixels;
    auto ready = is_first ? image_freshly_to : image_to;
    ready(record.commands, drawn_into, k_colour_target, {});
    ready(record.commands, targets.depth, k_depth_target, {});
    // Without a backdrop nothing needs clearing: the sky fills what nothing covers.
    VkRenderingAttachmentInfo colour =
        attachment(drawn_into.view, !is_first  ? VK_ATTACHMENT_LOAD_OP_LOAD
                                    : backdrop ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                               : VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    if (backdrop) colour.clearValue = {{{backdrop->r, backdrop->g, backdrop->b, 1}}};
    if (is_last && has_samples) {
        image_freshly_to(record.commands, pixels, k_colour_target);
        colour.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        colour.resolveImageView = pixels.view;
        colour.resolveImageLayout = k_colour_target.layout;
    }
    const VkRenderingAttachmentInfo depth =
        attachment(targets.depth.view, is_first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent_of(pixels);
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, info.renderArea.extent);
}

void draw_passes(const FrameRecord& record, GpuImage& pixels) {
    const std::vector<Pass> passes = passes_of(record.plan);
    for (const Pass& pass : passes) {
        begin_stage(record, pass.name);
        begin_pass(record, pixels, &pass == &passes.front(), &pass == &passes.back());
        pass.draw(record);
        vkCmdEndRendering(record.commands);
        end_stage(record);
    }
}

// Not below an overlay, which it would darken by what lies behind it.
bool has_occlusion(const FrameRecord& record) {
    return record.renderer.quality.has_occlusion && record.plan.surfaces_view == Surfaces::lit &&
           !has_overlay(record.plan);
}

void draw_stage(const FrameRecord& record, const Pass& pass) {
    begin_stage(record, pass.name);
    pass.draw(record);
    end_stage(record);
}

// To the host.
void copy_picture(const FrameRecord& record) {
    GpuImage& image = record.target.image;
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {image.width, image.height, 1};
    vkCmdCopyImageToBuffer(record.commands, image.handle, k_copied_from.layout, record.target.readback, 1,
                           &region);
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(record.commands, &info);
}

}  // namespace

void record_picture(const FrameRecord& record) {
    const Renderer& renderer = record.renderer;
    // Beginning to count, lavapipe looks at the pipeline.
    bind(record, renderer.pipelines.fxaa_image);
    vkCmdBindDescriptorSets(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, renderer.pipelines.layout, 0, 1,
                            &record.slot.set, 0, nullptr);
    vkCmdBindIndexBuffer(record.commands, renderer.scene.indices.handle, 0, VK_INDEX_TYPE_UINT32);

    begin_stages(record.commands, record.slot.stages);
    draw_shadows(record);
    if (record.plan.backdrop) {
        draw_passes(record, record.target.image);
    } else {
        draw_passes(record, record.renderer.targets.colour);
        if (has_occlusion(record)) draw_stage(record, {"occlusion", draw_occlusion});
        draw_stage(record, {"fxaa", draw_fxaa});
    }
    image_to(record.commands, record.target.image, record.target.after);
    if (record.target.readback) draw_stage(record, {"copy", copy_picture});
}

}  // namespace flaneur
