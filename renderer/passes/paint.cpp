// Surfaces without light, for the views that show how the picture is made.
#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

void begin_paint(const FrameRecord& record, ViewPipeline pipeline, uint32_t paint) {
    bind(record, record.renderer.pipelines.views[static_cast<size_t>(pipeline)]);
    vkCmdPushConstants(record.commands, record.renderer.pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof paint, &paint);
}

void draw_meshes(const FrameRecord& record) {
    const GpuScene& scene = record.renderer.scene;
    bind_vertices(record, scene.person_vertices.handle);
    vkCmdBindIndexBuffer(record.commands, scene.person_indices.handle, 0, VK_INDEX_TYPE_UINT32);
    draw_indirect(record, record.plan.crowd);
    vkCmdBindIndexBuffer(record.commands, scene.city_indices.handle, 0, VK_INDEX_TYPE_UINT32);
}

void draw_city_of(const FrameRecord& record, std::initializer_list<CityClass> kinds) {
    bind_vertices(record, record.renderer.scene.city_vertices.handle);
    for (CityClass kind : kinds) draw_indirect(record, record.plan.surfaces[static_cast<size_t>(kind)]);
}

// Shades have no surface of their own.
void draw_ground_and_houses(const FrameRecord& record) {
    draw_city_of(record,
                 {CityClass::facade, CityClass::prop, CityClass::detail, CityClass::roof, CityClass::ground});
}
void draw_scenery(const FrameRecord& record) { draw_city_of(record, {CityClass::scenery}); }

void clear(const FrameRecord& record, glm::vec3 colour) {
    VkClearAttachment all{VK_IMAGE_ASPECT_COLOR_BIT, 0, {}};
    for (int i = 0; i < 3; ++i) all.clearValue.color.float32[i] = colour[i];
    const VkClearRect whole{{{0, 0}, extent_of(record.renderer.targets.colour)}, 0, 1};
    vkCmdClearAttachments(record.commands, 1, &all, 1, &whole);
}

}  // namespace

std::vector<ViewPipeline> view_pipelines_for(const FrameInput& input) {
    using enum ViewPipeline;
    std::vector<ViewPipeline> wanted;
    if (input.surfaces == Surfaces::overdraw)
        wanted = {count_city, count_crowd, count_impostor};
    else if (input.surfaces != Surfaces::lit)
        wanted = {paint_city, paint_crowd, paint_impostor};
    if (input.surfaces == Surfaces::ids) wanted.push_back(id_scenery);
    if (input.surfaces == Surfaces::wireframe) wanted.insert(wanted.end(), {ink_city, ink_crowd});
    if (input.are_ghosts) wanted.push_back(ghost_crowd);
    if (!input.fills.empty()) wanted.push_back(fill);
    if (!input.lines.empty()) wanted.insert(wanted.end(), {line, hidden_line});
    return wanted;
}

void draw_paint(const FrameRecord& record) {
    using enum ViewPipeline;
    const Surfaces surfaces = record.plan.surfaces_view;
    const bool is_count = surfaces == Surfaces::overdraw, is_ink = surfaces == Surfaces::wireframe;
    const bool is_ids = surfaces == Surfaces::ids;
    const uint32_t paint = is_count ? k_paint_count
                           : is_ink ? k_paint_paper
                           : is_ids ? k_paint_ids
                                    : k_paint_normals;
    clear(record, is_ink ? glm::vec3(0.93f, 0.93f, 0.91f) : glm::vec3(0));
    const auto impostors = static_cast<uint32_t>(record.renderer.crowd.impostors.size());
    begin_paint(record, is_count ? count_crowd : paint_crowd, paint);
    if (!record.plan.are_ghosts) draw_meshes(record);
    begin_paint(record, is_count ? count_impostor : paint_impostor, paint);
    if (impostors > 0) vkCmdDraw(record.commands, 6 * impostors, 1, 0, 0);
    begin_paint(record, is_count ? count_city : paint_city, paint);
    draw_ground_and_houses(record);
    if (is_ids) bind(record, record.renderer.pipelines.views[static_cast<size_t>(id_scenery)]);
    draw_scenery(record);
    if (!is_ink) return;
    begin_paint(record, ink_city, k_paint_ink);
    draw_ground_and_houses(record);
    draw_scenery(record);
    if (record.plan.are_ghosts) return;
    begin_paint(record, ink_crowd, k_paint_ink);
    draw_meshes(record);
}

void draw_ghosts(const FrameRecord& record) {
    begin_paint(record, ViewPipeline::ghost_crowd, k_paint_ghost);
    draw_meshes(record);
}

}  // namespace flaneur
