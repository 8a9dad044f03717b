#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

// What was copied before may be read by the host.
void host_reads(VkCommandBuffer commands) {
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

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
    GpuImage& image = *record.target.image;
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {image.width, image.height, 1};
    vkCmdCopyImageToBuffer(record.commands, image.handle, k_copied_from.layout, record.target.readback, 1,
                           &region);
    host_reads(record.commands);
}

void hand_to_host(const FrameRecord& record) {
    PictureTargets& targets = record.renderer.targets;
    image_to(record.commands, targets.colour, k_read_by_host);
    if (record.plan.surfaces_view == Surfaces::lit)
        image_to(record.commands, targets.surface, k_read_by_host);
    if (has_overlay(record.plan)) image_to(record.commands, targets.overlay, k_read_by_host);
    image_to(record.commands, targets.depth, k_copied_from);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    region.imageExtent = {targets.depth.width, targets.depth.height, 1};
    vkCmdCopyImageToBuffer(record.commands, targets.depth.handle, k_copied_from.layout,
                           targets.depth_copy.handle, 1, &region);
    host_reads(record.commands);
}

void take_from_host(const FrameRecord& record) {
    GpuImage& image = *record.target.image;
    image_freshly_to(record.commands, image, k_copied_to);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {image.width, image.height, 1};
    vkCmdCopyBufferToImage(record.commands, record.target.staging, image.handle, k_copied_to.layout, 1,
                           &region);
    image_to(record.commands, image, record.target.after);
}

}  // namespace flaneur
