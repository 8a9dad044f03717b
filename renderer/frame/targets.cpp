#include "renderer/frame/targets.h"

#include "renderer/device/check.h"
#include "renderer/device/names.h"

namespace flaneur {

namespace {

constexpr VkImageUsageFlags k_drawn_and_read =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;

}  // namespace

Result<void> make_picture_targets(const Device& device, const QualityLevel& quality, bool is_read_by_host,
                                  VkExtent2D extent, PictureTargets& targets) {
    targets.extent = extent;
    ImageShape shape{.format = k_colour_format,
                     .width = extent.width * quality.samples,
                     .height = extent.height * quality.samples,
                     .usage = k_drawn_and_read | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                     .is_read_by_host = is_read_by_host};
    FLANEUR_TRY(make_image(device, shape, targets.colour));
    shape.format = k_surface_format;
    shape.usage = k_drawn_and_read;
    FLANEUR_TRY(make_image(device, shape, targets.surface));
    shape.format = k_depth_format;
    shape.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    FLANEUR_TRY(make_image(device, shape, targets.depth));
    ImageShape pixels{.format = k_occlusion_format,
                      .width = (extent.width + 1) / 2,
                      .height = (extent.height + 1) / 2,
                      .usage = k_drawn_and_read};
    if (quality.has_occlusion) {
        FLANEUR_TRY(make_image(device, pixels, targets.occlusion));
        FLANEUR_TRY(make_image(device, pixels, targets.even_occlusion));
    }
    if (is_read_by_host) return {};
    pixels.format = k_picture_format;
    pixels.width = extent.width, pixels.height = extent.height;
    return make_image(device, pixels, targets.picture);
}

Result<void> make_overlay(const Device& device, bool is_read_by_host, PictureTargets& targets) {
    return make_image(device,
                      {.format = k_colour_format,
                       .width = targets.colour.width,
                       .height = targets.colour.height,
                       .usage = k_drawn_and_read,
                       .is_read_by_host = is_read_by_host},
                      targets.overlay);
}

void destroy_picture_targets(const Device& device, PictureTargets& targets) {
    for (GpuImage* image : {&targets.colour, &targets.surface, &targets.depth, &targets.overlay,
                            &targets.occlusion, &targets.even_occlusion, &targets.picture})
        destroy_image(device, *image);
    targets = {};
}

Result<void> make_shadow_maps(const Device& device, uint32_t resolution, bool is_read_by_host,
                              ShadowMaps& maps) {
    if (is_read_by_host)
        FLANEUR_TRY(make_buffer(device, VkDeviceSize{2} * resolution * resolution * k_shadow_layers,
                                VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, maps.copy));
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
        name_object(device, maps.layer_views[layer], "shadow map " + std::to_string(layer));
    }
    return {};
}

void destroy_shadow_maps(const Device& device, ShadowMaps& maps) {
    for (VkImageView view : maps.layer_views)
        if (view) vkDestroyImageView(device.handle, view, nullptr);
    destroy_image(device, maps.map);
    destroy_buffer(device, maps.copy);
    maps = {};
}

}  // namespace flaneur
