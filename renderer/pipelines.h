// Every pipeline, over one descriptor set layout (bindings: shaders/shared.h) and one 4x4 matrix of push
// constants.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/device.h"
#include "renderer/quality.h"
#include "renderer/shared.h"

namespace flaneur {

inline constexpr VkFormat k_picture_format =
    VK_FORMAT_R8G8B8A8_UNORM;  // holds display-ready sRGB; luma in alpha
inline constexpr VkFormat k_depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat k_shadow_format = VK_FORMAT_D16_UNORM;
inline constexpr VkFormat k_occlusion_format = VK_FORMAT_R8_UNORM;
inline constexpr VkFormat k_atlas_format = VK_FORMAT_R32_UINT;  // of impostors; see shaders/impostor.glsl

// Those that draw what is lit.
struct LitPipelines {
    VkPipeline city_surface = {}, city_facade = {}, city_prop = {}, city_scenery = {}, impostor = {};
    VkPipeline crowd[2] = {}, crowd_skinned[2] = {};  // without and with textures; skinned on the host
    VkPipeline shade = {}, contact = {}, sky = {};
};

// Those of the views for work, each made when it is first wanted.
enum class ViewPipeline {
    paint_city,
    paint_crowd,
    paint_impostor,
    count_city,
    count_crowd,
    count_impostor,
    ink_city,
    ink_crowd,
    ghost_crowd,
    fill,
    line,
    hidden_line,
};
inline constexpr size_t k_view_pipelines = 12;

struct Pipelines {
    VkDescriptorSetLayout set_layout = {};
    VkPipelineLayout layout = {};
    VkSampler shadow_sampler = {}, texture_sampler = {}, atlas_sampler = {}, lamp_sampler = {};
    VkPipeline shadow_city = {}, shadow_crowd = {}, shadow_skinned = {}, shadow_impostor = {},
               shadow_scenery = {};
    VkPipeline impostor_bake = {};
    LitPipelines lit[k_lights];               // by k_light_*; night's and plain ones made when first wanted
    VkPipeline occlusion = {}, occlude = {};  // made where the quality has occlusion
    uint32_t samples = 1;                     // of what lit ones draw into
    VkPipeline fxaa_image = {}, fxaa_window = {};
    std::array<VkPipeline, k_view_pipelines> views = {};  // by ViewPipeline; null until wanted
};

// `window_format` VK_FORMAT_UNDEFINED: no window. After a failure destroy_pipelines() frees what had been
// made.
Result<void> make_pipelines(const Device& device, const QualityLevel& quality, VkFormat window_format,
                            Pipelines& pipelines);
// Makes pipelines.lit[light] if there are none yet.
Result<void> make_lit_pipelines(const Device& device, int light, Pipelines& pipelines);
void destroy_pipelines(const Device& device, Pipelines& pipelines);

// Makes those of `wanted` that there are not yet.
Result<void> make_view_pipelines(const Device& device, std::span<const ViewPipeline> wanted,
                                 Pipelines& pipelines);

enum class Blend {
    none,
    darkens,  // multiplies what is there by 1 - alpha
    covers,   // by alpha; luma stays what it was, so that anti-aliasing does not touch what it covers with
    adds,
};
using Attributes = std::vector<VkVertexInputAttributeDescription>;

struct PipelineShape {
    std::span<const uint32_t> vertex, fragment;  // an empty fragment shader: depth alone
    Attributes attributes;
    uint32_t stride = 0;
    bool is_instanced = false;  // attributes advance by instance
    VkFormat colour = VK_FORMAT_UNDEFINED, depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_test = VK_COMPARE_OP_GREATER;
    bool writes_depth = true;
    bool is_shadow = false;  // depth grows away from the sun, is clamped, and biased
    Blend blend = Blend::none;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkPolygonMode fill = VK_POLYGON_MODE_FILL;
    uint32_t samples = 1;
    int32_t constants[k_constants] = {0, 0, 1};  // by k_constant_*
};
Result<void> make_pipeline(const Device& device, VkPipelineLayout layout, const PipelineShape& shape,
                           VkPipeline& pipeline);
Attributes city_attributes();    // of CityVertex
Attributes person_attributes();  // of PersonVertex

}  // namespace flaneur
