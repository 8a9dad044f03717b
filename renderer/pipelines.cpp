#include "renderer/pipelines.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/check.h"
#include "renderer/scene.h"
#include "renderer/skin.h"
#include "spirv/city.vert.h"
#include "spirv/city_facade.frag.h"
#include "spirv/city_surface.frag.h"
#include "spirv/contact.frag.h"
#include "spirv/contact.vert.h"
#include "spirv/crowd.frag.h"
#include "spirv/crowd.vert.h"
#include "spirv/fullscreen.vert.h"
#include "spirv/fxaa.frag.h"
#include "spirv/impostor.frag.h"
#include "spirv/impostor.vert.h"
#include "spirv/impostor_bake.frag.h"
#include "spirv/impostor_bake.vert.h"
#include "spirv/occlude.frag.h"
#include "spirv/occlusion.frag.h"
#include "spirv/prop.frag.h"
#include "spirv/prop.vert.h"
#include "spirv/scenery.frag.h"
#include "spirv/scenery.vert.h"
#include "spirv/shade.frag.h"
#include "spirv/shade.vert.h"
#include "spirv/shadow_city.vert.h"
#include "spirv/shadow_crowd.vert.h"
#include "spirv/shadow_impostor.frag.h"
#include "spirv/shadow_impostor.vert.h"
#include "spirv/shadow_scenery.frag.h"
#include "spirv/shadow_scenery.vert.h"
#include "spirv/skinned.vert.h"
#include "spirv/sky.frag.h"
#include "spirv/sky.vert.h"

namespace flaneur {

Attributes city_attributes() {
    return {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(CityVertex, position)},
            {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(CityVertex, colour)},
            {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(CityVertex, uv)},
            {3, 0, VK_FORMAT_R8G8B8A8_SNORM, offsetof(CityVertex, normal)},
            {4, 0, VK_FORMAT_R16G16_UINT, offsetof(CityVertex, material)}};
}

Attributes person_attributes() {
    return {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(PersonVertex, position)},
            {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(PersonVertex, colour)},
            {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PersonVertex, uv)},
            {3, 0, VK_FORMAT_R8G8B8A8_SINT, offsetof(PersonVertex, normal)},
            {4, 0, VK_FORMAT_R8G8B8A8_UINT, offsetof(PersonVertex, joints)},
            {5, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(PersonVertex, weights)},
            {6, 0, VK_FORMAT_R32_UINT, offsetof(PersonVertex, texture)}};
}

namespace {

Result<void> make_shader(const Device& device, std::span<const uint32_t> code, VkShaderModule& module) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    FLANEUR_VK(vkCreateShaderModule(device.handle, &info, nullptr, &module), "load a shader");
    return {};
}

Result<void> make_pipeline(const Device& device, VkPipelineLayout layout, const PipelineShape& shape,
                           std::span<const VkShaderModule> shaders, VkPipeline& pipeline) {
    VkSpecializationMapEntry entries[k_constants];
    for (uint32_t i = 0; i < k_constants; ++i) entries[i] = {i, 4 * i, 4};
    const VkSpecializationInfo constants{k_constants, entries, sizeof shape.constants, shape.constants};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (size_t i = 0; i < shaders.size(); ++i) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = shaders[i];
        stages[i].pName = "main";
        stages[i].pSpecializationInfo = &constants;
    }
    const VkVertexInputBindingDescription binding{
        0, shape.stride, shape.is_instanced ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX};
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = shape.attributes.empty() ? 0 : 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = static_cast<uint32_t>(shape.attributes.size());
    input.pVertexAttributeDescriptions = shape.attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.depthClampEnable = shape.is_shadow;
    raster.polygonMode = shape.fill;
    raster.cullMode = shape.cull;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.depthBiasEnable = shape.is_shadow;
    raster.depthBiasConstantFactor = 1;
    raster.depthBiasSlopeFactor = 1.5f;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = static_cast<VkSampleCountFlagBits>(shape.samples);
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = shape.depth != VK_FORMAT_UNDEFINED;
    depth.depthWriteEnable = shape.writes_depth;
    depth.depthCompareOp = shape.is_shadow ? VK_COMPARE_OP_LESS : shape.depth_test;
    VkPipelineColorBlendAttachmentState blend{};
    blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                           VK_COLOR_COMPONENT_A_BIT;
    if (shape.blend == Blend::darkens) {
        blend.blendEnable = VK_TRUE;
        blend.srcColorBlendFactor = blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
        blend.dstColorBlendFactor = blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    } else if (shape.blend != Blend::none) {
        const bool is_cover = shape.blend == Blend::covers;
        blend.blendEnable = VK_TRUE;
        blend.srcColorBlendFactor = is_cover ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
        blend.dstColorBlendFactor = is_cover ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
        blend.colorWriteMask &= ~VkColorComponentFlags{VK_COLOR_COMPONENT_A_BIT};
    }
    VkPipelineColorBlendStateCreateInfo blending{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = shape.colour == VK_FORMAT_UNDEFINED ? 0 : 1;
    blending.pAttachments = &blend;
    const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamic_states;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = blending.attachmentCount;
    rendering.pColorAttachmentFormats = &shape.colour;
    rendering.depthAttachmentFormat = shape.depth;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = static_cast<uint32_t>(shaders.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    FLANEUR_VK(vkCreateGraphicsPipelines(device.handle, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
               "make a pipeline");
    return {};
}

Result<void> make_layouts(const Device& device, Pipelines& pipelines) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    auto bind = [&](int number, VkDescriptorType type, VkShaderStageFlags stages) {
        bindings.push_back({static_cast<uint32_t>(number), type, 1, stages, nullptr});
    };
    bind(k_binding_frame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
         VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_instances, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT);
    bind(k_binding_palette, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT);
    bind(k_binding_impostors, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
         VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_cells, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT);
    bind(k_binding_shadow, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
         VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_textures, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_picture, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_atlas, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_scenery, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_lamps, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
         VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_depth, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT);
    bind(k_binding_occlusion, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT);
    VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = static_cast<uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    FLANEUR_VK(vkCreateDescriptorSetLayout(device.handle, &set_info, nullptr, &pipelines.set_layout),
               "make a descriptor set layout");
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(mat4)};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &pipelines.set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    FLANEUR_VK(vkCreatePipelineLayout(device.handle, &info, nullptr, &pipelines.layout),
               "make a pipeline layout");

    VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    sampler.maxLod = VK_LOD_CLAMP_NONE;
    FLANEUR_VK(vkCreateSampler(device.handle, &sampler, nullptr, &pipelines.texture_sampler),
               "make a sampler");
    sampler.addressModeU = sampler.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    FLANEUR_VK(vkCreateSampler(device.handle, &sampler, nullptr, &pipelines.lamp_sampler), "make a sampler");
    sampler.magFilter = sampler.minFilter = VK_FILTER_NEAREST;
    sampler.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    sampler.addressModeU = sampler.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    FLANEUR_VK(vkCreateSampler(device.handle, &sampler, nullptr, &pipelines.atlas_sampler), "make a sampler");
    sampler.compareEnable = VK_TRUE;
    sampler.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    FLANEUR_VK(vkCreateSampler(device.handle, &sampler, nullptr, &pipelines.shadow_sampler),
               "make a sampler");
    return {};
}

}  // namespace

Result<void> make_pipeline(const Device& device, VkPipelineLayout layout, const PipelineShape& shape,
                           VkPipeline& pipeline) {
    VkShaderModule shaders[2] = {};
    const size_t count = shape.fragment.empty() ? 1 : 2;
    Result<void> result = make_shader(device, shape.vertex, shaders[0]);
    if (result && count == 2) result = make_shader(device, shape.fragment, shaders[1]);
    if (result) result = make_pipeline(device, layout, shape, std::span(shaders, count), pipeline);
    for (VkShaderModule shader : shaders)
        if (shader) vkDestroyShaderModule(device.handle, shader, nullptr);
    return result;
}

Result<void> make_lit_pipelines(const Device& device, int light, Pipelines& pipelines) {
    LitPipelines& lit = pipelines.lit[light];
    if (lit.sky) return {};  // made last
    auto make = [&](PipelineShape shape, VkPipeline& out) {
        shape.samples = pipelines.samples;
        shape.constants[k_constant_light] = light;
        return make_pipeline(device, pipelines.layout, shape, out);
    };
    PipelineShape city{.vertex = k_spirv_city_vert,
                       .fragment = k_spirv_city_surface_frag,
                       .attributes = city_attributes(),
                       .stride = sizeof(CityVertex),
                       .colour = k_picture_format,
                       .depth = k_depth_format,
                       .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make(city, lit.city_surface));
    city.fragment = k_spirv_city_facade_frag;
    FLANEUR_TRY(make(city, lit.city_facade));
    PipelineShape prop = city;
    prop.vertex = k_spirv_prop_vert;
    prop.fragment = k_spirv_prop_frag;
    std::erase_if(prop.attributes, [](const auto& attribute) { return attribute.location == 2; });  // no uv
    FLANEUR_TRY(make(prop, lit.city_prop));
    PipelineShape scenery = city;
    scenery.vertex = k_spirv_scenery_vert;
    scenery.fragment = k_spirv_scenery_frag;
    FLANEUR_TRY(make(scenery, lit.city_scenery));

    PipelineShape shade = city;
    shade.vertex = k_spirv_shade_vert;
    shade.fragment = k_spirv_shade_frag;
    shade.attributes = {city_attributes()[0], city_attributes()[2]};
    shade.cull = VK_CULL_MODE_NONE;
    shade.writes_depth = false;
    shade.blend = Blend::darkens;
    FLANEUR_TRY(make(shade, lit.shade));

    PipelineShape crowd = city;
    crowd.vertex = k_spirv_crowd_vert;
    crowd.fragment = k_spirv_crowd_frag;
    crowd.attributes = person_attributes();
    crowd.stride = sizeof(PersonVertex);
    PipelineShape skinned = crowd;
    skinned.vertex = k_spirv_skinned_vert;
    skinned.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_UINT, offsetof(SkinnedVertex, place)},
                          {1, 0, VK_FORMAT_R32G32B32A32_UINT, offsetof(SkinnedVertex, uv)},
                          {2, 0, VK_FORMAT_R32_UINT, offsetof(SkinnedVertex, layer)}};
    skinned.stride = sizeof(SkinnedVertex);
    for (int textured = 0; textured < 2; ++textured) {
        crowd.constants[k_constant_textured] = textured;
        skinned.constants[k_constant_textured] = textured;
        FLANEUR_TRY(make(crowd, lit.crowd[textured]));
        FLANEUR_TRY(make(skinned, lit.crowd_skinned[textured]));
    }
    const PipelineShape impostor{.vertex = k_spirv_impostor_vert,
                                 .fragment = k_spirv_impostor_frag,
                                 .attributes = {},
                                 .colour = k_picture_format,
                                 .depth = k_depth_format};
    FLANEUR_TRY(make(impostor, lit.impostor));
    const PipelineShape contact{
        .vertex = k_spirv_contact_vert,
        .fragment = k_spirv_contact_frag,
        .attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32_SFLOAT, 16}},
        .stride = 20,
        .is_instanced = true,
        .colour = k_picture_format,
        .depth = k_depth_format,
        .writes_depth = false,
        .blend = Blend::darkens};
    FLANEUR_TRY(make(contact, lit.contact));
    const PipelineShape sky{.vertex = k_spirv_sky_vert,
                            .fragment = k_spirv_sky_frag,
                            .attributes = {},
                            .colour = k_picture_format,
                            .depth = k_depth_format,
                            .depth_test = VK_COMPARE_OP_GREATER_OR_EQUAL,
                            .writes_depth = false};
    return make(sky, lit.sky);
}

Result<void> make_pipelines(const Device& device, const QualityLevel& quality, VkFormat window_format,
                            Pipelines& p) {
    p.samples = quality.samples;
    FLANEUR_TRY(make_layouts(device, p));
    auto make = [&](const PipelineShape& shape, VkPipeline& out) {
        return make_pipeline(device, p.layout, shape, out);
    };

    PipelineShape shadow{.vertex = k_spirv_shadow_city_vert,
                         .fragment = {},
                         .attributes = {city_attributes()[0]},
                         .stride = sizeof(CityVertex),
                         .depth = k_shadow_format,
                         .is_shadow = true,
                         .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make(shadow, p.shadow_city));
    shadow.vertex = k_spirv_shadow_scenery_vert;
    shadow.fragment = k_spirv_shadow_scenery_frag;
    shadow.attributes = {city_attributes()[0], city_attributes()[2], city_attributes()[4]};
    // Outlines drawn as hulls turned inside out must not shade what they outline.
    shadow.cull = VK_CULL_MODE_BACK_BIT;
    FLANEUR_TRY(make(shadow, p.shadow_scenery));
    const Attributes person = person_attributes();
    shadow.fragment = {};
    shadow.vertex = k_spirv_shadow_crowd_vert;
    shadow.attributes = {person[0], person[4]};
    shadow.stride = sizeof(PersonVertex);
    FLANEUR_TRY(make(shadow, p.shadow_crowd));
    shadow.vertex = k_spirv_shadow_city_vert;
    shadow.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SkinnedVertex, place)}};
    shadow.stride = sizeof(SkinnedVertex);
    FLANEUR_TRY(make(shadow, p.shadow_skinned));
    shadow.cull = VK_CULL_MODE_NONE;
    shadow.vertex = k_spirv_shadow_impostor_vert;
    shadow.fragment = k_spirv_shadow_impostor_frag;
    shadow.attributes = {};
    FLANEUR_TRY(make(shadow, p.shadow_impostor));

    FLANEUR_TRY(make_lit_pipelines(device, k_light_day, p));
    const PipelineShape bake{.vertex = k_spirv_impostor_bake_vert,
                             .fragment = k_spirv_impostor_bake_frag,
                             .attributes = person,
                             .stride = sizeof(PersonVertex),
                             .colour = k_atlas_format,
                             .depth = k_shadow_format,
                             .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make(bake, p.impostor_bake));
    if (quality.has_occlusion) {
        PipelineShape occlusion{.vertex = k_spirv_fullscreen_vert,
                                .fragment = k_spirv_occlusion_frag,
                                .attributes = {},
                                .colour = k_occlusion_format,
                                .writes_depth = false};
        FLANEUR_TRY(make(occlusion, p.occlusion));
        occlusion.fragment = k_spirv_occlude_frag;
        occlusion.colour = k_picture_format;
        occlusion.blend = Blend::darkens;
        FLANEUR_TRY(make(occlusion, p.occlude));
    }
    PipelineShape fxaa{.vertex = k_spirv_fullscreen_vert,
                       .fragment = k_spirv_fxaa_frag,
                       .attributes = {},
                       .colour = k_picture_format,
                       .writes_depth = false};
    fxaa.constants[k_constant_smooth] = quality.smooths_edges;
    FLANEUR_TRY(make(fxaa, p.fxaa_image));
    if (window_format == VK_FORMAT_UNDEFINED) return {};
    fxaa.colour = window_format;
    return make(fxaa, p.fxaa_window);
}

void destroy_pipelines(const Device& device, Pipelines& p) {
    std::vector<VkPipeline> all = {p.shadow_city,    p.shadow_crowd,  p.shadow_impostor, p.shadow_skinned,
                                   p.shadow_scenery, p.impostor_bake, p.occlusion,       p.occlude,
                                   p.fxaa_image,     p.fxaa_window};
    for (const LitPipelines& lit : p.lit)
        all.insert(all.end(), {lit.city_surface, lit.city_facade, lit.city_prop, lit.city_scenery,
                               lit.impostor, lit.crowd[0], lit.crowd[1], lit.crowd_skinned[0],
                               lit.crowd_skinned[1], lit.shade, lit.contact, lit.sky});
    for (VkPipeline pipeline : all)
        if (pipeline) vkDestroyPipeline(device.handle, pipeline, nullptr);
    for (VkPipeline pipeline : p.views)
        if (pipeline) vkDestroyPipeline(device.handle, pipeline, nullptr);
    if (p.shadow_sampler) vkDestroySampler(device.handle, p.shadow_sampler, nullptr);
    if (p.atlas_sampler) vkDestroySampler(device.handle, p.atlas_sampler, nullptr);
    if (p.lamp_sampler) vkDestroySampler(device.handle, p.lamp_sampler, nullptr);
    if (p.texture_sampler) vkDestroySampler(device.handle, p.texture_sampler, nullptr);
    if (p.layout) vkDestroyPipelineLayout(device.handle, p.layout, nullptr);
    if (p.set_layout) vkDestroyDescriptorSetLayout(device.handle, p.set_layout, nullptr);
    p = {};
}

}  // namespace flaneur
