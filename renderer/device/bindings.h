// The one descriptor set that every pipeline uses: what stands at each k_binding_* of shaders/shared.h.
// Layout, pools and writes all follow one table.
#pragma once

#include <array>
#include <span>

#include "renderer/device/device.h"
#include "renderer/shared.h"

namespace flaneur {

enum class SamplerKind : uint8_t {
    blended,  // bilinear, levels blended, repeated
    texels,   // one texel, clamped
};
inline constexpr size_t k_samplers = 2;

struct BindingKind {
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT;
    SamplerKind sampler = SamplerKind::blended;  // of images
};
inline constexpr std::array<BindingKind, k_bindings> k_binding_kinds = [] {
    constexpr VkDescriptorType image = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    constexpr VkShaderStageFlags fragment = VK_SHADER_STAGE_FRAGMENT_BIT,
                                 both = VK_SHADER_STAGE_VERTEX_BIT | fragment;
    std::array<BindingKind, k_bindings> kinds{};
    kinds[k_binding_frame] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, both};
    kinds[k_binding_instances] = {};
    kinds[k_binding_palette] = {};
    kinds[k_binding_impostors] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, both};
    kinds[k_binding_cells] = {};
    kinds[k_binding_sky] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, fragment};
    kinds[k_binding_shadow] = {image, fragment, SamplerKind::texels};
    kinds[k_binding_textures] = {image, fragment, SamplerKind::blended};
    kinds[k_binding_atlas] = {image, fragment, SamplerKind::texels};
    kinds[k_binding_scenery] = {image, fragment, SamplerKind::blended};
    kinds[k_binding_letters] = {image, fragment, SamplerKind::blended};
    for (int texels : {k_binding_lamps, k_binding_colour, k_binding_surface, k_binding_depth,
                       k_binding_occlusion, k_binding_even_occlusion, k_binding_picture, k_binding_overlay})
        kinds[static_cast<size_t>(texels)] = {image, fragment, SamplerKind::texels};
    return kinds;
}();
constexpr bool is_image(const BindingKind& kind) {
    return kind.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

struct Bindings {
    VkDescriptorSetLayout layout = {};
    std::array<VkSampler, k_samplers> samplers = {};  // by SamplerKind
};
// After a failure destroy_bindings() frees what had been made.
Result<void> make_bindings(const Device& device, Bindings& bindings);
void destroy_bindings(const Device& device, Bindings& bindings);

// A pool, and sets out of it.
Result<void> make_binding_sets(const Device& device, const Bindings& bindings, VkDescriptorPool& pool,
                               std::span<VkDescriptorSet> sets);

// What one binding refers to: a buffer, or an image that is ready for sampling.
struct Bound {
    VkBuffer buffer = {};
    VkImageView view = {};
};
// By k_binding_*; those that refer to nothing stay as they are.
void write_bindings(const Device& device, const Bindings& bindings,
                    const std::array<Bound, k_bindings>& bound, VkDescriptorSet set);

}  // namespace flaneur
