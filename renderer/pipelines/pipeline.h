// One pipeline, by what sets it apart from others, and the formats that pipelines draw into.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/device/device.h"
#include "renderer/shared.h"

namespace flaneur {

inline constexpr VkFormat k_picture_format =
    VK_FORMAT_R8G8B8A8_UNORM;  // holds display-ready sRGB; luma in alpha
// What surfaces are, as shaders/base/surface.glsl keeps it.
inline constexpr VkFormat k_colour_format = VK_FORMAT_R8G8B8A8_UNORM,
                          k_surface_format = VK_FORMAT_R32G32_UINT;
inline constexpr VkFormat k_depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat k_shadow_format = VK_FORMAT_D16_UNORM;
inline constexpr VkFormat k_occlusion_format = VK_FORMAT_R8_UNORM;
inline constexpr VkFormat k_atlas_format =
    VK_FORMAT_R32_UINT;  // of impostors; see shaders/people/impostor.glsl

enum class Blend {
    none,
    darkens,  // multiplies the alpha that is there by 1 - alpha
    covers,   // by alpha, which is gathered
    adds,
};
using Attributes = std::vector<VkVertexInputAttributeDescription>;

struct PipelineShape {
    std::span<const uint32_t> vertex, fragment;  // an empty fragment shader: depth alone
    Attributes attributes;
    uint32_t stride = 0;
    bool is_instanced = false;                                             // attributes advance by instance
    VkFormat colour = VK_FORMAT_UNDEFINED, surface = VK_FORMAT_UNDEFINED;  // surface: beside the colour
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_test = VK_COMPARE_OP_GREATER;
    bool writes_depth = true;
    bool is_shadow = false;  // depth grows away from the sun, is clamped, and biased
    Blend blend = Blend::none;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkPolygonMode fill = VK_POLYGON_MODE_FILL;
    int32_t constants[k_constants] = {0, 1, 0};  // by k_constant_*
};
// `name`: that debuggers show.
Result<void> make_pipeline(const Device& device, VkPipelineLayout layout, const std::string& name,
                           const PipelineShape& shape, VkPipeline& pipeline);
Attributes city_attributes();    // of CityVertex
Attributes person_attributes();  // of PersonVertex

}  // namespace flaneur
