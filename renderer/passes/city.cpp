#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

// In drawing order: what hides much before what is hidden, and what needs the ground below it last.
struct SurfaceDraw {
    CityClass kind;
    VkPipeline SurfacePipelines::*pipeline;
};
constexpr SurfaceDraw k_surfaces[] = {
    {CityClass::prop, &SurfacePipelines::city_prop},
    {CityClass::detail, &SurfacePipelines::city_surface},
    {CityClass::facade, &SurfacePipelines::city_facade},
    {CityClass::roof, &SurfacePipelines::city_surface},
    {CityClass::ground, &SurfacePipelines::city_surface},
    {CityClass::scenery, &SurfacePipelines::city_scenery},
    {CityClass::shade, &SurfacePipelines::city_shade},
};
static_assert(std::size(k_surfaces) == k_city_classes);

}  // namespace

void draw_city(const FrameRecord& record) {
    bind_vertices(record, record.renderer.scene.city_vertices.handle);
    for (const SurfaceDraw& surface : k_surfaces) {
        const DrawRange range = record.plan.surfaces[static_cast<size_t>(surface.kind)];
        if (range.count == 0) continue;
        bind(record, record.renderer.pipelines.surfaces.*surface.pipeline);
        draw_indirect(record, range);
    }
}

}  // namespace flaneur
