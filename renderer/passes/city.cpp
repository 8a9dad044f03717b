#include "renderer/passes/passes.h"

namespace flaneur {
namespace {

// In drawing order: what hides much before what is hidden, and what needs the ground below it last.
struct SurfaceDraw {
    CityClass kind;
    VkPipeline LitPipelines::*pipeline;
};
constexpr SurfaceDraw k_surfaces[] = {
    {CityClass::prop, &LitPipelines::city_prop},      {CityClass::detail, &LitPipelines::city_surface},
    {CityClass::facade, &LitPipelines::city_facade},  {CityClass::roof, &LitPipelines::city_surface},
    {CityClass::ground, &LitPipelines::city_surface}, {CityClass::scenery, &LitPipelines::city_scenery},
    {CityClass::shade, &LitPipelines::city_shade},
};
static_assert(std::size(k_surfaces) == k_city_classes);

}  // namespace

void draw_city(const FrameRecord& record) {
    bind_vertices(record, record.renderer.scene.city_vertices.handle);
    for (const SurfaceDraw& surface : k_surfaces) {
        const DrawRange range = record.plan.surfaces[static_cast<size_t>(surface.kind)];
        if (range.count == 0) continue;
        bind(record, lit_pipelines(record).*surface.pipeline);
        draw_indirect(record, range);
    }
}

}  // namespace flaneur
