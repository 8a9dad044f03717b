// Every pipeline, over one descriptor set layout (bindings: shaders/shared.h) and one 4x4 matrix of push
// constants.
#pragma once

#include "renderer/device.h"
#include "renderer/quality.h"

namespace flaneur {

inline constexpr VkFormat k_picture_format =
    VK_FORMAT_R8G8B8A8_UNORM;  // holds display-ready sRGB; luma in alpha
inline constexpr VkFormat k_depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat k_shadow_format = VK_FORMAT_D16_UNORM;
inline constexpr VkFormat k_occlusion_format = VK_FORMAT_R8_UNORM;
inline constexpr VkFormat k_atlas_format = VK_FORMAT_R32_UINT;  // of impostors; see shaders/impostor.glsl

// Those that draw what is lit.
struct LitPipelines {
    VkPipeline city_surface = {}, city_facade = {}, city_scenery = {}, impostor = {};
    VkPipeline crowd_smooth[2] = {}, crowd_rigid[2] = {};  // without and with textures
    VkPipeline shade = {}, contact = {}, sky = {};
};

struct Pipelines {
    VkDescriptorSetLayout set_layout = {};
    VkPipelineLayout layout = {};
    VkSampler shadow_sampler = {}, texture_sampler = {}, atlas_sampler = {}, lamp_sampler = {};
    VkPipeline shadow_city = {}, shadow_crowd = {}, shadow_impostor = {}, shadow_scenery = {};
    VkPipeline impostor_bake = {};
    LitPipelines lit[2];  // by day, and where lamps are lit; the latter made when first wanted
    VkPipeline occlusion = {}, occlude = {};  // made where the quality has occlusion
    uint32_t samples = 1;                     // of what lit ones draw into
    VkPipeline fxaa_image = {}, fxaa_window = {};
};

// `window_format` VK_FORMAT_UNDEFINED: no window. After a failure destroy_pipelines() frees what had been
// made.
Result<void> make_pipelines(const Device& device, const QualityLevel& quality, VkFormat window_format,
                            Pipelines& pipelines);
// Makes pipelines.lit[1].
Result<void> make_night_pipelines(const Device& device, Pipelines& pipelines);
void destroy_pipelines(const Device& device, Pipelines& pipelines);

}  // namespace flaneur
