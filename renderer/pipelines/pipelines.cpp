#include "renderer/pipelines/pipelines.h"

#include <cstddef>
#include <vector>

#include "renderer/device/check.h"
#include "renderer/device/names.h"
#include "renderer/people/skin.h"
#include "renderer/scene.h"
#include "spirv/contact.frag.h"
#include "spirv/contact.vert.h"
#include "spirv/crowd.frag.h"
#include "spirv/crowd.vert.h"
#include "spirv/even_out.frag.h"
#include "spirv/facade.frag.h"
#include "spirv/facade.vert.h"
#include "spirv/fullscreen.vert.h"
#include "spirv/impostor.frag.h"
#include "spirv/impostor.vert.h"
#include "spirv/impostor_bake.frag.h"
#include "spirv/impostor_bake.vert.h"
#include "spirv/light.frag.h"
#include "spirv/occlude.frag.h"
#include "spirv/occlusion.frag.h"
#include "spirv/panel.frag.h"
#include "spirv/panel.vert.h"
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
#include "spirv/smooth.frag.h"
#include "spirv/stars.frag.h"
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
    name_object(device, pipelines.layout, "pipelines");
    return {};
}

Result<void> make_surface_pipelines(const Device& device, Pipelines& pipelines) {
    SurfacePipelines& surfaces = pipelines.surfaces;
    auto make = [&](const char* name, PipelineShape shape, VkPipeline& out) {
        shape.colour = k_colour_format;
        shape.surface = k_surface_format;
        shape.depth = k_depth_format;
        return make_pipeline(device, pipelines.layout, name, shape, out);
    };
    const Attributes all = city_attributes();
    PipelineShape facade{.vertex = k_spirv_facade_vert,
                         .fragment = k_spirv_facade_frag,
                         .attributes = {all[0], all[1], all[2], all[3], all[4], all[5]},
                         .stride = sizeof(CityVertex),
                         .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make("city facade", facade, surfaces.city_facade));
    PipelineShape city = facade;
    city.vertex = k_spirv_surface_vert;
    city.fragment = k_spirv_surface_frag;
    city.attributes = {all[0], all[1], all[2], all[3], all[4]};
    FLANEUR_TRY(make("city surface", city, surfaces.city_surface));
    PipelineShape prop = city;
    prop.vertex = k_spirv_prop_vert;
    prop.fragment = k_spirv_prop_frag;
    prop.attributes = {all[0], all[1], all[2], all[3], all[4]};
    FLANEUR_TRY(make("city prop", prop, surfaces.city_prop));
    PipelineShape scenery = city;
    scenery.vertex = k_spirv_scenery_vert;
    scenery.fragment = k_spirv_scenery_frag;
    FLANEUR_TRY(make("city scenery", scenery, surfaces.city_scenery));

    PipelineShape shade = city;
    shade.vertex = k_spirv_shade_vert;
    shade.fragment = k_spirv_shade_frag;
    shade.attributes = {all[0], all[2]};
    shade.cull = VK_CULL_MODE_NONE;
    shade.writes_depth = false;
    shade.blend = Blend::darkens;
    FLANEUR_TRY(make("city shade", shade, surfaces.city_shade));

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
        FLANEUR_TRY(make(textured ? "crowd, textured" : "crowd", crowd, surfaces.crowd[textured]));
        FLANEUR_TRY(make(textured ? "crowd skinned, textured" : "crowd skinned", skinned,
                         surfaces.crowd_skinned[textured]));
    }
    const PipelineShape impostor{
        .vertex = k_spirv_impostor_vert, .fragment = k_spirv_impostor_frag, .attributes = {}};
    FLANEUR_TRY(make("impostor", impostor, surfaces.impostor));
    const PipelineShape contact{
        .vertex = k_spirv_contact_vert,
        .fragment = k_spirv_contact_frag,
        .attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16}},
        .stride = 32,
        .is_instanced = true,
        .writes_depth = false,
        .blend = Blend::darkens};
    FLANEUR_TRY(make("contact", contact, surfaces.contact));
    const PipelineShape stars{.vertex = k_spirv_fullscreen_vert,
                              .fragment = k_spirv_stars_frag,
                              .attributes = {},
                              .depth_test = VK_COMPARE_OP_GREATER_OR_EQUAL,
                              .writes_depth = false};
    return make("stars", stars, surfaces.stars);
}

// Over pixels.
Result<void> make_picture_pipelines(const Device& device, const QualityLevel& quality, bool is_lit_on_host,
                                    VkFormat window_format, Pipelines& p) {
    auto make = [&](const char* name, const PipelineShape& shape, VkPipeline& out) {
        return make_pipeline(device, p.layout, name, shape, out);
    };
    PipelineShape shape{.vertex = k_spirv_fullscreen_vert, .attributes = {}, .writes_depth = false};
    if (quality.has_occlusion) {
        shape.fragment = k_spirv_occlusion_frag;
        shape.colour = k_occlusion_format;
        FLANEUR_TRY(make("occlusion", shape, p.occlusion));
        shape.fragment = k_spirv_even_out_frag;
        FLANEUR_TRY(make("even out", shape, p.even_out));
        shape.fragment = k_spirv_occlude_frag;
        shape.colour = k_colour_format;
        shape.blend = Blend::darkens;
        FLANEUR_TRY(make("occlude", shape, p.occlude));
        shape.blend = Blend::none;
    }
    PipelineShape panels{.vertex = k_spirv_panel_vert,
                         .fragment = k_spirv_panel_frag,
                         .attributes = {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, place)},
                                        {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, uv)},
                                        {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(PanelVertex, colour)}},
                         .stride = sizeof(PanelVertex),
                         .colour = k_picture_format,
                         .writes_depth = false,
                         .blend = Blend::covers};
    FLANEUR_TRY(make("panels image", panels, p.panels_image));
    panels.colour = window_format;
    if (window_format != VK_FORMAT_UNDEFINED) FLANEUR_TRY(make("panels window", panels, p.panels_window));
    if (is_lit_on_host) return {};
    shape.colour = k_picture_format;
    shape.fragment = k_spirv_light_frag;
    FLANEUR_TRY(make("light", shape, p.light));
    shape.fragment = k_spirv_smooth_frag;
    shape.constants[k_constant_smooth] = quality.smooths_edges;
    FLANEUR_TRY(make("smooth image", shape, p.smooth_image));
    if (window_format == VK_FORMAT_UNDEFINED) return {};
    shape.colour = window_format;
    return make("smooth window", shape, p.smooth_window);
}

}  // namespace

Result<void> make_pipelines(const Device& device, const QualityLevel& quality, bool is_lit_on_host,
                            VkFormat window_format, Pipelines& p) {
    FLANEUR_TRY(make_layout(device, p));
    auto make = [&](const char* name, const PipelineShape& shape, VkPipeline& out) {
        return make_pipeline(device, p.layout, name, shape, out);
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
    shadow.constants[k_constant_clamp] = !device.clamps_depth;
    FLANEUR_TRY(make("shadow city", shadow, p.shadow_city));
    shadow.vertex = k_spirv_shadow_scenery_vert;
    shadow.fragment = k_spirv_shadow_scenery_frag;
    shadow.attributes = {city_attributes()[0], city_attributes()[2], city_attributes()[4]};
    FLANEUR_TRY(make("shadow scenery", shadow, p.shadow_scenery));
    const Attributes person = person_attributes();
    shadow.fragment = {};
    shadow.vertex = k_spirv_shadow_crowd_vert;
    shadow.attributes = {person[0], person[4]};
    shadow.stride = sizeof(PersonVertex);
    FLANEUR_TRY(make("shadow crowd", shadow, p.shadow_crowd));
    shadow.vertex = k_spirv_shadow_city_vert;
    shadow.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SkinnedVertex, place)}};
    shadow.stride = sizeof(SkinnedVertex);
    FLANEUR_TRY(make("shadow skinned", shadow, p.shadow_skinned));
    shadow.cull = VK_CULL_MODE_NONE;
    shadow.vertex = k_spirv_shadow_impostor_vert;
    shadow.fragment = k_spirv_shadow_impostor_frag;
    shadow.attributes = {};
    FLANEUR_TRY(make("shadow impostor", shadow, p.shadow_impostor));

    FLANEUR_TRY(make_surface_pipelines(device, p));
    const PipelineShape bake{.vertex = k_spirv_impostor_bake_vert,
                             .fragment = k_spirv_impostor_bake_frag,
                             .attributes = person,
                             .stride = sizeof(PersonVertex),
                             .colour = k_atlas_format,
                             .depth = k_shadow_format,
                             .cull = VK_CULL_MODE_BACK_BIT};
    FLANEUR_TRY(make("impostor bake", bake, p.impostor_bake));
    return make_picture_pipelines(device, quality, is_lit_on_host, window_format, p);
}

void destroy_pipelines(const Device& device, Pipelines& p) {
    std::vector<VkPipeline> all = {p.shadow_city,    p.shadow_crowd,  p.shadow_impostor, p.shadow_skinned,
                                   p.shadow_scenery, p.impostor_bake, p.occlusion,       p.even_out,
                                   p.occlude,        p.light,         p.smooth_image,    p.smooth_window,
                                   p.panels_image,   p.panels_window};
    const SurfacePipelines& surfaces = p.surfaces;
    all.insert(all.end(),
               {surfaces.city_surface, surfaces.city_facade, surfaces.city_prop, surfaces.city_scenery,
                surfaces.impostor, surfaces.crowd[0], surfaces.crowd[1], surfaces.crowd_skinned[0],
                surfaces.crowd_skinned[1], surfaces.city_shade, surfaces.contact, surfaces.stars});
    for (VkPipeline pipeline : all)
        if (pipeline) vkDestroyPipeline(device.handle, pipeline, nullptr);
    for (VkPipeline pipeline : p.views)
        if (pipeline) vkDestroyPipeline(device.handle, pipeline, nullptr);
    if (p.layout) vkDestroyPipelineLayout(device.handle, p.layout, nullptr);
    destroy_bindings(device, p.bindings);
    p = {};
}

}  // namespace flaneur
