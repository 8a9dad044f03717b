// What a frame is drawn into before it reaches its picture.
#pragma once

#include "renderer/device/resources.h"
#include "renderer/light/shadow_box.h"
#include "renderer/pipelines/pipelines.h"
#include "renderer/quality.h"

namespace flaneur {

// As large as the picture; what a quality has no use for is not made.
struct PictureTargets {
    GpuImage colour;     // one sample a pixel, before anti-aliasing
    GpuImage samples;    // what is drawn into where there are several
    GpuImage depth;      // as many samples
    GpuImage occlusion;  // half as wide and high
};
Result<void> make_picture_targets(const Device& device, const QualityLevel& quality, uint32_t width,
                                  uint32_t height, PictureTargets& targets);
void destroy_picture_targets(const Device& device, PictureTargets& targets);

// The city's shadows are drawn when their boxes move; each frame copies the near ones and adds people. Far
// away only the city throws shadows.
struct ShadowMaps {
    GpuImage map;  // k_shadow_layers, as shaders read them
    VkImageView layer_views[k_shadow_layers] = {};
    ShadowBoxes held;  // what the city's are of; none at first
};
Result<void> make_shadow_maps(const Device& device, uint32_t resolution, ShadowMaps& maps);
void destroy_shadow_maps(const Device& device, ShadowMaps& maps);

}  // namespace flaneur
