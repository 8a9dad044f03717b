#include "renderer/device/bindings.h"

#include <algorithm>
#include <vector>

#include "renderer/device/check.h"
#include "renderer/device/names.h"
#include "renderer/device/resources.h"

namespace flaneur {
namespace {

Result<void> make_sampler(const Device& device, SamplerKind kind, VkSampler& out) {
    VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    sampler.maxLod = VK_LOD_CLAMP_NONE;
    if (kind == SamplerKind::texels) {
        sampler.magFilter = sampler.minFilter = VK_FILTER_NEAREST;
        sampler.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
        sampler.addressModeU = sampler.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    }
    FLANEUR_VK(vkCreateSampler(device.handle, &sampler, nullptr, &out), "make a sampler");
    name_object(device, out, kind == SamplerKind::texels ? "texels" : "smooth");
    return {};
}

}  // namespace

Result<void> make_bindings(const Device& device, Bindings& bindings) {
    std::array<VkDescriptorSetLayoutBinding, k_bindings> all{};
    for (uint32_t i = 0; i < k_bindings; ++i)
        all[i] = {i, k_binding_kinds[i].type, 1, k_binding_kinds[i].stages, nullptr};
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = k_bindings;
    info.pBindings = all.data();
    FLANEUR_VK(vkCreateDescriptorSetLayout(device.handle, &info, nullptr, &bindings.layout),
               "make a descriptor set layout");
    name_object(device, bindings.layout, "bindings");
    for (size_t i = 0; i < k_samplers; ++i)
        FLANEUR_TRY(make_sampler(device, static_cast<SamplerKind>(i), bindings.samplers[i]));
    return {};
}

void destroy_bindings(const Device& device, Bindings& bindings) {
    for (VkSampler sampler : bindings.samplers)
        if (sampler) vkDestroySampler(device.handle, sampler, nullptr);
    if (bindings.layout) vkDestroyDescriptorSetLayout(device.handle, bindings.layout, nullptr);
    bindings = {};
}

Result<void> make_binding_sets(const Device& device, const Bindings& bindings, VkDescriptorPool& pool,
                               std::span<VkDescriptorSet> sets) {
    const auto count = static_cast<uint32_t>(sets.size());
    std::vector<VkDescriptorPoolSize> sizes;
    for (const BindingKind& kind : k_binding_kinds) {
        auto same = [&](const VkDescriptorPoolSize& size) { return size.type == kind.type; };
        if (auto size = std::find_if(sizes.begin(), sizes.end(), same); size != sizes.end())
            size->descriptorCount += count;
        else
            sizes.push_back({kind.type, count});
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = count;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    FLANEUR_VK(vkCreateDescriptorPool(device.handle, &info, nullptr, &pool), "make a descriptor pool");
    name_object(device, pool, "binding sets");
    const std::vector<VkDescriptorSetLayout> layouts(count, bindings.layout);
    VkDescriptorSetAllocateInfo allocation{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocation.descriptorPool = pool;
    allocation.descriptorSetCount = count;
    allocation.pSetLayouts = layouts.data();
    FLANEUR_VK(vkAllocateDescriptorSets(device.handle, &allocation, sets.data()), "make descriptor sets");
    for (VkDescriptorSet set : sets) name_object(device, set, "binding set");
    return {};
}

void write_bindings(const Device& device, const Bindings& bindings,
                    const std::array<Bound, k_bindings>& bound, VkDescriptorSet set) {
    std::array<VkWriteDescriptorSet, k_bindings> writes{};
    std::array<VkDescriptorBufferInfo, k_bindings> buffers{};
    std::array<VkDescriptorImageInfo, k_bindings> images{};
    uint32_t count = 0;
    for (uint32_t i = 0; i < k_bindings; ++i) {
        const BindingKind& kind = k_binding_kinds[i];
        if (!bound[i].buffer && !bound[i].view) continue;
        buffers[i] = {bound[i].buffer, 0, VK_WHOLE_SIZE};
        images[i] = {bindings.samplers[static_cast<size_t>(kind.sampler)], bound[i].view, k_sampled.layout};
        VkWriteDescriptorSet& write = writes[count++];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = kind.type;
        write.pBufferInfo = &buffers[i];
        write.pImageInfo = &images[i];
    }
    vkUpdateDescriptorSets(device.handle, count, writes.data(), 0, nullptr);
}

}  // namespace flaneur
