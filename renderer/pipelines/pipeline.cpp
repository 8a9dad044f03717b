#include "renderer/pipelines/pipeline.h"

#include <array>
#include <cstddef>

#include "renderer/device/check.h"
#include "renderer/device/names.h"
#include "renderer/scene.h"

namespace flaneur {
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
    raster.depthClampEnable = shape.is_shadow && device.clamps_depth;
    raster.polygonMode = shape.fill;
    raster.cullMode = shape.cull;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.depthBiasEnable = shape.is_shadow;
    raster.depthBiasConstantFactor = 1;
    raster.depthBiasSlopeFactor = 1.5f;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = shape.depth != VK_FORMAT_UNDEFINED;
    depth.depthWriteEnable = shape.writes_depth;
    depth.depthCompareOp = shape.is_shadow ? VK_COMPARE_OP_LESS : shape.depth_test;
    constexpr VkColorComponentFlags everything = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                 VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    std::array<VkPipelineColorBlendAttachmentState, 2> blend{};
    blend[0].colorWriteMask = everything;
    blend[0].blendEnable = shape.blend != Blend::none;
    if (shape.blend == Blend::darkens) {
        blend[0].srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
        blend[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        blend[0].colorWriteMask = VK_COLOR_COMPONENT_A_BIT;
    } else if (shape.blend == Blend::covers) {
        blend[0].srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
        blend[0].srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        blend[0].dstColorBlendFactor = blend[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    } else if (shape.blend == Blend::adds) {
        blend[0].srcColorBlendFactor = blend[0].dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
        blend[0].colorWriteMask &= ~VkColorComponentFlags{VK_COLOR_COMPONENT_A_BIT};
    }
    // What blends leaves the surface what it was.
    blend[1].colorWriteMask = shape.blend == Blend::none ? everything : 0;
    const VkFormat formats[] = {shape.colour, shape.surface};
    VkPipelineColorBlendStateCreateInfo blending{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount =
        uint32_t{shape.colour != VK_FORMAT_UNDEFINED} + uint32_t{shape.surface != VK_FORMAT_UNDEFINED};
    blending.pAttachments = blend.data();
    const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamic_states;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = blending.attachmentCount;
    rendering.pColorAttachmentFormats = formats;
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

}  // namespace

Result<void> make_pipeline(const Device& device, VkPipelineLayout layout, const std::string& name,
                           const PipelineShape& shape, VkPipeline& pipeline) {
    VkShaderModule shaders[2] = {};
    const size_t count = shape.fragment.empty() ? 1 : 2;
    Result<void> result = make_shader(device, shape.vertex, shaders[0]);
    if (result && count == 2) result = make_shader(device, shape.fragment, shaders[1]);
    for (size_t i = 0; i < count; ++i)
        if (shaders[i]) name_object(device, shaders[i], name + (i == 0 ? ", vertices" : ", fragments"));
    if (result) result = make_pipeline(device, layout, shape, std::span(shaders, count), pipeline);
    if (result) name_object(device, pipeline, name);
    for (VkShaderModule shader : shaders)
        if (shader) vkDestroyShaderModule(device.handle, shader, nullptr);
    return result;
}

Attributes city_attributes() {
    return {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(CityVertex, position)},
            {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(CityVertex, colour)},
            {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(CityVertex, uv)},
            {3, 0, VK_FORMAT_R8G8B8A8_SNORM, offsetof(CityVertex, normal)},
            {4, 0, VK_FORMAT_R16G16_UINT, offsetof(CityVertex, material)},
            {5, 0, VK_FORMAT_R32_UINT, offsetof(CityVertex, house)},
            {6, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(CityVertex, id)}};
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

}  // namespace flaneur
