#include "renderer/frame/targets.h"

#include "renderer/device/check.h"

namespace flaneur {

Result<void> make_picture_targets(const Device& device, const QualityLevel& quality, uint32_t width,
                                  uint32_t height, PictureTargets& targets) {
    ImageShape shape{.format = k_picture_format, .width = width, .height = height};
    shape.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    FLANEUR_TRY(make_image(device, shape, targets.colour));
    if (quality.has_occlusion) {
        ImageShape half = shape;
        half.format = k_occlusion_format;
        half.width = (width + 1) / 2, half.height = (height + 1) / 2;
        FLANEUR_TRY(make_image(device, half, targets.occlusion));
    }
    shape.samples = quality.samples;
    shape.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (quality.samples > 1) FLANEUR_TRY(make_image(device, shape, targets.samples));
    shape.format = k_depth_format;
    shape.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (quality.has_occlusion) shape.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    return make_image(device, shape, targets.depth);
}

void destroy_picture_targets(const Device& device, PictureTargets& targets) {
    destroy_image(device, targets.colour);
    destroy_image(device, targets.samples);
    destroy_image(device, targets.depth);
    destroy_image(device, targets.occlusion);
}

Result<void> make_shadow_maps(const Device& device, uint32_t resolution, ShadowMaps& maps) {
    ImageShape shape{.format = k_shadow_format, .width = resolution, .height = resolution};
    shape.layers = k_shadow_layers;
    shape.is_array = true;
    shape.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                  VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    FLANEUR_TRY(make_image(device, shape, maps.map));
    for (uint32_t layer = 0; layer < k_shadow_layers; ++layer) {
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = maps.map.handle;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = k_shadow_format;
        info.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, layer, 1};
        FLANEUR_VK(vkCreateImageView(device.handle, &info, nullptr, &maps.layer_views[layer]),
                   "make an image view");
    }
    return {};
}

void destroy_shadow_maps(const Device& device, ShadowMaps& maps) {
    for (VkImageView view : maps.layer_views)
        if (view) vkDestroyImageView(device.handle, view, nullptr);
    destroy_image(device, maps.map);
    maps = {};
}

}  // namespace flaneur
