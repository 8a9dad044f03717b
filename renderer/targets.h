// What a frame is drawn into before it reaches its picture.
#pragma once

#include "renderer/pipelines.h"
#include "renderer/quality.h"
#include "renderer/resources.h"
#include "renderer/view.h"

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

inline constexpr uint32_t k_near_layer = 0, k_far_layer = 1;

// The city's near shadows are drawn when their box moves and kept in `still`; each frame copies them and adds
// the crowd. Far away only the city throws shadows.
struct ShadowMaps {
    GpuImage map;    // two layers, as shaders read them
    GpuImage still;  // the near layer without the crowd
    VkImageView layer_views[2] = {};
    ShadowBox near_box, far_box;  // what they hold; none at first
};
Result<void> make_shadow_maps(const Device& device, uint32_t resolution, ShadowMaps& maps);
void destroy_shadow_maps(const Device& device, ShadowMaps& maps);

}  // namespace flaneur
