#include "renderer/pipelines/pipelines.h"

#include <cstddef>
#include <vector>

#include "renderer/device/check.h"
#include "renderer/people/skin.h"
#include "renderer/scene.h"
#include "spirv/contact.frag.h"
#include "spirv/contact.vert.h"
#include "spirv/crowd.frag.h"
#include "spirv/crowd.vert.h"
#include "spirv/facade.frag.h"
#include "spirv/facade.vert.h"
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
#include "spirv/surface.frag.h"
#include "spirv/surface.vert.h"

namespace flaneur {

namespace {

// Of every pipeline.
Result<void> make_layout(const Device& device, Pipelines& pipelines) {
    FLANEUR_TRY(make_bindings(device, pipelines.bindings));
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(mat4)};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &pipelines.bindings.layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    FLANEUR_VK(vkCreatePipelineLayout(device.handle, &info, nullptr, &pipelines.layout),
               "make a pipeline layout");
    return {};
}

}  // namespace

Result<void> make_lit_pipelines(const Device& device, int light, Pipelines& pipelines) {
    LitPipelines& lit = pipelines.lit[light];
    if (lit.sky) return {};  // made last
    auto make = [&](PipelineShape shape, VkPipeline& out) {
        shape.samples = pipelines.samples;
        shape.constants[k_constant_light] = light;
        ++pipelines.made;
        return make_pipeline(device, pipelines.layout, shape, out);
    };
    const Attributes all = city_attributes();
    PipelineShape facade{.vertex = k_spirv_facade_vert,
                         .fragment = k_spirv_facade_frag,
                         .attributes = all,
                         .stride = sizeof(CityVertex),
                         .colour = k_picture_format,
                         .depth = k_depth_format,
                         .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make(facade, lit.city_facade));
    PipelineShape city = facade;
    city.vertex = k_spirv_surface_vert;
    city.fragment = k_spirv_surface_frag;
    city.attributes = {all[0], all[1], all[2], all[3], all[4]};
    FLANEUR_TRY(make(city, lit.city_surface));
    PipelineShape prop = city;
    prop.vertex = k_spirv_prop_vert;
    prop.fragment = k_spirv_prop_frag;
    prop.attributes = {all[0], all[1], all[3], all[4]};
    FLANEUR_TRY(make(prop, lit.city_prop));
    PipelineShape scenery = city;
    scenery.vertex = k_spirv_scenery_vert;
    scenery.fragment = k_spirv_scenery_frag;
    FLANEUR_TRY(make(scenery, lit.city_scenery));

    PipelineShape shade = city;
    shade.vertex = k_spirv_shade_vert;
    shade.fragment = k_spirv_shade_frag;
    shade.attributes = {all[0], all[2]};
    shade.cull = VK_CULL_MODE_NONE;
    shade.writes_depth = false;
    shade.blend = Blend::darkens;
    FLANEUR_TRY(make(shade, lit.city_shade));

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
        .attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16}},
        .stride = 32,
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
    FLANEUR_TRY(make_layout(device, p));
    auto make = [&](const PipelineShape& shape, VkPipeline& out) {
        return make_pipeline(device, p.layout, shape, out);
    };

    PipelineShape shadow{
        .vertex = k_spirv_shadow_city_vert,
        .fragment = {},
        .attributes = {city_attributes()[0]},
        .stride = sizeof(CityVertex),
        .depth = k_shadow_format,
        .is_shadow = true,
        // Also of outlines drawn as hulls turned inside out, which are not to shade what they outline.
        .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make(shadow, p.shadow_city));
    shadow.vertex = k_spirv_shadow_scenery_vert;
    shadow.fragment = k_spirv_shadow_scenery_frag;
    shadow.attributes = {city_attributes()[0], city_attributes()[2], city_attributes()[4]};
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
                               lit.crowd_skinned[1], lit.city_shade, lit.contact, lit.sky});
    for (VkPipeline pipeline : all)
        if (pipeline) vkDestroyPipeline(device.handle, pipeline, nullptr);
    for (VkPipeline pipeline : p.views)
        if (pipeline) vkDestroyPipeline(device.handle, pipeline, nullptr);
    if (p.layout) vkDestroyPipelineLayout(device.handle, p.layout, nullptr);
    destroy_bindings(device, p.bindings);
    p = {};
}

}  // namespace flaneur
