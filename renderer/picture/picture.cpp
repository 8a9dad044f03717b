#include "renderer/picture/picture.h"

#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

struct Stage {
    const char* name;
    void (*draw)(const FrameRecord&);
};

void draw_stage(const FrameRecord& record, const Stage& stage) {
    FLANEUR_ZONE(stage.name, record);
    stage.draw(record);
}

// What is drawn with depth into the same samples, one after the other.
std::vector<Stage> passes_of(const FramePlan& plan) {
    if (plan.backdrop) return {{"crowd", draw_plain}};
    if (plan.surfaces_view != Surfaces::lit) return {{"paint", draw_paint}};
    if (plan.times_passes) return {{"crowd", draw_people}, {"city", draw_city}, {"sky", draw_sky}};
    return {{"scene", draw_scene}};
}

// Begins to draw into images of one size and the depth, over what is there or over what `load` says.
void begin_drawing(const FrameRecord& record, std::span<GpuImage* const> images, VkAttachmentLoadOp load,
                   bool is_depth_fresh) {
    GpuImage& depth_image = record.renderer.targets.depth;
    std::vector<VkRenderingAttachmentInfo> colours;
    for (GpuImage* image : images) {
        const bool is_fresh = load != VK_ATTACHMENT_LOAD_OP_LOAD;
        (is_fresh ? image_freshly_to : image_to)(record.commands, *image, k_colour_target, {});
        colours.push_back(attachment(image->view, load));
    }
    (is_depth_fresh ? image_freshly_to : image_to)(record.commands, depth_image, k_depth_target, {});
    const VkRenderingAttachmentInfo depth = attachment(
        depth_image.view, is_depth_fresh ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent_of(*images[0]);
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<uint32_t>(colours.size());
    info.pColorAttachments = colours.data();
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, info.renderArea.extent);
}

void draw_surfaces(const FrameRecord& record) {
    PictureTargets& targets = record.renderer.targets;
    std::vector<GpuImage*> images = {&targets.colour};
    if (record.plan.surfaces_view == Surfaces::lit) images.push_back(&targets.surface);
    bool is_first = true;
    for (const Stage& pass : passes_of(record.plan)) {
        FLANEUR_ZONE(pass.name, record);
        // Where depth stays 0 nobody looks at the others.
        begin_drawing(record, images, is_first ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : VK_ATTACHMENT_LOAD_OP_LOAD,
                      is_first);
        pass.draw(record);
        vkCmdEndRendering(record.commands);
        is_first = false;
    }
}

void draw_what_is_over(const FrameRecord& record) {
    GpuImage* const overlay = &record.renderer.targets.overlay;
    begin_drawing(record, std::span(&overlay, 1), VK_ATTACHMENT_LOAD_OP_CLEAR, false);
    draw_overlay(record);
    vkCmdEndRendering(record.commands);
}

}  // namespace

void record_picture(const FrameRecord& record) {
    const Renderer& renderer = record.renderer;
    const FramePlan& plan = record.plan;
    // Beginning to count, lavapipe looks at the pipeline.
    bind(record, renderer.pipelines.surfaces.stars);
    vkCmdBindDescriptorSets(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, renderer.pipelines.layout, 0, 1,
                            &record.slot.set, 0, nullptr);
    vkCmdBindIndexBuffer(record.commands, renderer.scene.city_indices.handle, 0, VK_INDEX_TYPE_UINT32);

    begin_stages(record.commands, record.slot.stages, record.plan.times_passes);
    draw_shadows(record);
    draw_surfaces(record);
    if (renderer.quality.has_occlusion && plan.surfaces_view == Surfaces::lit && !plan.backdrop)
        draw_stage(record, {"occlusion", draw_occlusion});
    if (has_overlay(plan)) draw_stage(record, {"overlay", draw_what_is_over});
    if (renderer.is_lit_on_host) return draw_stage(record, {"surfaces to host", hand_surfaces_to_host});
    draw_stage(record, {"light", draw_light});
    draw_stage(record, {"smooth", draw_smooth});
    if (record.target.scaled) draw_stage(record, {"scale", scale_picture});
    if (!plan.panels.empty()) draw_stage(record, {"panels", draw_panels});
    image_to(record.commands, final_image(record), record.target.after);
    if (record.target.readback) draw_stage(record, {"copy", copy_picture});
}

void record_picture_from_host(const FrameRecord& record) {
    take_from_host(record);
    if (record.target.scaled) scale_picture(record);
    if (!record.plan.panels.empty()) {
        vkCmdBindDescriptorSets(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                record.renderer.pipelines.layout, 0, 1, &record.slot.set, 0, nullptr);
        draw_panels(record);
    }
    image_to(record.commands, final_image(record), record.target.after);
    if (record.target.readback) copy_picture(record);
}

}  // namespace flaneur
