#include <cstddef>

#include "renderer/device/check.h"
#include "renderer/pipelines/pipelines.h"
#include "renderer/scene.h"
#include "spirv/id_scenery.frag.h"
#include "spirv/id_scenery.vert.h"
#include "spirv/overlay_fill.vert.h"
#include "spirv/overlay_line.frag.h"
#include "spirv/overlay_line.vert.h"
#include "spirv/paint.frag.h"
#include "spirv/paint_city.vert.h"
#include "spirv/paint_crowd.frag.h"
#include "spirv/paint_crowd.vert.h"
#include "spirv/paint_impostor.frag.h"
#include "spirv/paint_impostor.vert.h"

namespace flaneur {
namespace {

PipelineShape painted_city() {
    const Attributes city = city_attributes();
    return {.vertex = k_spirv_paint_city_vert,
            .fragment = k_spirv_paint_frag,
            .attributes = {city[0], city[1], city[3], city[6]},
            .stride = sizeof(CityVertex),
            .colour = k_colour_format,
            .depth = k_depth_format,
            .cull = VK_CULL_MODE_BACK_BIT};
}

PipelineShape painted_crowd() {
    const Attributes person = person_attributes();
    PipelineShape shape = painted_city();
    shape.vertex = k_spirv_paint_crowd_vert;
    shape.fragment = k_spirv_paint_crowd_frag;
    shape.attributes = {person[0], person[1], person[3], person[4], person[5]};
    shape.stride = sizeof(PersonVertex);
    return shape;
}

PipelineShape painted_impostor() {
    return {.vertex = k_spirv_paint_impostor_vert,
            .fragment = k_spirv_paint_impostor_frag,
            .attributes = {},
            .colour = k_colour_format,
            .depth = k_depth_format};
}

// Nothing is there where its pictures are seen through.
PipelineShape id_scenery() {
    const Attributes city = city_attributes();
    PipelineShape shape = painted_city();
    shape.vertex = k_spirv_id_scenery_vert;
    shape.fragment = k_spirv_id_scenery_frag;
    shape.attributes = {city[0], city[2], city[4], city[6]};
    return shape;
}

PipelineShape counted(PipelineShape shape) {
    shape.blend = Blend::adds;
    return shape;
}

PipelineShape inked(PipelineShape shape) {
    shape.fill = VK_POLYGON_MODE_LINE;
    shape.writes_depth = false;
    return shape;
}

PipelineShape ghost() {
    PipelineShape shape = painted_crowd();
    shape.blend = Blend::covers;
    shape.writes_depth = false;
    return shape;
}

PipelineShape overlay_fill() {
    return {.vertex = k_spirv_overlay_fill_vert,
            .fragment = k_spirv_paint_frag,
            .attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(GizmoCorner, place)},
                           {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(GizmoCorner, colour)}},
            .stride = sizeof(GizmoCorner),
            .colour = k_colour_format,
            .depth = k_depth_format,
            .writes_depth = false,
            .blend = Blend::covers};
}

PipelineShape overlay_line(VkCompareOp depth_test) {
    return {.vertex = k_spirv_overlay_line_vert,
            .fragment = k_spirv_overlay_line_frag,
            .attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(GizmoLine, a)},
                           {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(GizmoLine, b)},
                           {2, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(GizmoLine, shift_a)},
                           {3, 0, VK_FORMAT_R32_SFLOAT, offsetof(GizmoLine, pixels)},
                           {4, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(GizmoLine, colour)},
                           {5, 0, VK_FORMAT_R32_UINT, offsetof(GizmoLine, place)}},
            .stride = sizeof(GizmoLine),
            .is_instanced = true,
            .colour = k_colour_format,
            .depth = k_depth_format,
            .depth_test = depth_test,
            .writes_depth = false,
            .blend = Blend::covers};
}

constexpr const char* k_view_pipeline_names[k_view_pipelines] = {
    "paint city", "paint crowd", "paint impostor", "count city", "count crowd", "count impostor", "ink city",
    "ink crowd",  "ghost crowd", "id scenery",     "fill",       "line",        "hidden line"};

PipelineShape shape_of(ViewPipeline pipeline) {
    switch (pipeline) {
        case ViewPipeline::paint_city:
            return painted_city();
        case ViewPipeline::paint_crowd:
            return painted_crowd();
        case ViewPipeline::paint_impostor:
            return painted_impostor();
        case ViewPipeline::count_city:
            return counted(painted_city());
        case ViewPipeline::count_crowd:
            return counted(painted_crowd());
        case ViewPipeline::count_impostor:
            return counted(painted_impostor());
        case ViewPipeline::ink_city:
            return inked(painted_city());
        case ViewPipeline::ink_crowd:
            return inked(painted_crowd());
        case ViewPipeline::ghost_crowd:
            return ghost();
        case ViewPipeline::id_scenery:
            return id_scenery();
        case ViewPipeline::fill:
            return overlay_fill();
        case ViewPipeline::line:
            return overlay_line(VK_COMPARE_OP_GREATER_OR_EQUAL);
        case ViewPipeline::hidden_line:
            break;
    }
    return overlay_line(VK_COMPARE_OP_LESS);
}

}  // namespace

Result<void> make_view_pipelines(const Device& device, std::span<const ViewPipeline> wanted,
                                 Pipelines& pipelines) {
    for (ViewPipeline pipeline : wanted) {
        VkPipeline& made = pipelines.views[static_cast<size_t>(pipeline)];
        if (made) continue;
        PipelineShape shape = shape_of(pipeline);
        FLANEUR_TRY(make_pipeline(device, pipelines.layout,
                                  k_view_pipeline_names[static_cast<size_t>(pipeline)], shape, made));
    }
    return {};
}

}  // namespace flaneur
