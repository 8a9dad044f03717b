// What a frame is drawn into before it reaches its picture.
#pragma once

#include "renderer/device/resources.h"
#include "renderer/light/shadow_slices.h"
#include "renderer/pipelines/pipelines.h"
#include "renderer/quality.h"

namespace flaneur {

// What a picture is made of: surfaces in as many samples as a pixel has, and what stands between them and the
// picture. What a quality or a way of lighting has no use for is not made.
struct PictureTargets {
    GpuImage colour{"colour"}, surface{"surface"}, depth{"depth"};  // see shaders/base/surface.glsl
    GpuImage overlay{"overlay"};  // in as many samples; made when it is first wanted
    GpuImage occlusion{"occlusion"},
        even_occlusion{"even occlusion"};    // half as wide and high as the picture; evened out
    GpuImage picture{"unsmoothed picture"};  // lit, before anti-aliasing
    VkExtent2D extent = {};                  // of the picture, pixels
};
// `is_read_by_host`: the host lights what is drawn into them.
Result<void> make_picture_targets(const Device& device, const QualityLevel& quality, bool is_read_by_host,
                                  VkExtent2D extent, PictureTargets& targets);
// What is laid over the picture, once there is something.
Result<void> make_overlay(const Device& device, bool is_read_by_host, PictureTargets& targets);
void destroy_picture_targets(const Device& device, PictureTargets& targets);

// The city's shadows are drawn when their boxes move; each frame takes people's out of a copy of the near
// ones and adds them anew. Far away only the city throws shadows.
struct ShadowMaps {
    GpuImage map{"shadow maps"};  // k_shadow_layers, as shaders read them
    VkImageView layer_views[k_shadow_layers] = {};
    Buffer copy{"shadow maps for the host"};  // where the host reads them, if it lights
    ShadowState state;                        // what they hold
};
Result<void> make_shadow_maps(const Device& device, uint32_t resolution, bool is_read_by_host,
                              ShadowMaps& maps);
void destroy_shadow_maps(const Device& device, ShadowMaps& maps);

}  // namespace flaneur
