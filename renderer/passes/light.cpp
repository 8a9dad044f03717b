#include "renderer/passes/passes.h"

namespace flaneur {
void draw_light(const FrameRecord& record) {
    PictureTargets& targets = record.renderer.targets;
    for (GpuImage* image : {&targets.colour, &targets.surface, &targets.depth})
        image_to(record.commands, *image, k_sampled);
    image_freshly_to(record.commands, targets.picture, k_colour_target);
    draw_over(record, targets.picture, VK_ATTACHMENT_LOAD_OP_DONT_CARE, record.renderer.pipelines.light);
}

void draw_smooth(const FrameRecord& record) {
    PictureTargets& targets = record.renderer.targets;
    image_to(record.commands, targets.picture, k_sampled);
    if (targets.overlay.view)
        (has_overlay(record.plan) ? image_to : image_freshly_to)(record.commands, targets.overlay, k_sampled,
                                                                 {});
    image_freshly_to(record.commands, *record.target.image, k_colour_target);
    draw_over(record, *record.target.image, VK_ATTACHMENT_LOAD_OP_DONT_CARE, record.target.smooth);
}

void copy_picture(const FrameRecord& record) {
    GpuImage& image = final_image(record);
    const VkBufferImageCopy region = whole_of(image);
    vkCmdCopyImageToBuffer(record.commands, image.handle, k_copied_from.layout, record.target.readback, 1,
                           &region);
    wait_between(record.commands, k_copied_to, k_read_by_host);
}

void hand_surfaces_to_host(const FrameRecord& record) {
    PictureTargets& targets = record.renderer.targets;
    hand_to_host(record.commands, targets.colour);
    if (record.plan.surfaces_view == Surfaces::lit) hand_to_host(record.commands, targets.surface);
    if (has_overlay(record.plan)) hand_to_host(record.commands, targets.overlay);
    hand_to_host(record.commands, targets.depth);
    wait_between(record.commands, k_copied_to, k_read_by_host);
}

void take_from_host(const FrameRecord& record) {
    GpuImage& image = *record.target.image;
    image_freshly_to(record.commands, image, k_copied_to);
    const VkBufferImageCopy region = whole_of(image);
    vkCmdCopyBufferToImage(record.commands, record.target.staging, image.handle, k_copied_to.layout, 1,
                           &region);
}

}  // namespace flaneur
