// Every pipeline, over one layout: a descriptor set (device/bindings.h) and a 4x4 matrix of push constants.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/device/bindings.h"
#include "renderer/pipelines/pipeline.h"
#include "renderer/quality.h"

namespace flaneur {

// Those that draw what surfaces are.
struct SurfacePipelines {
    VkPipeline city_surface = {}, city_facade = {}, city_prop = {}, city_scenery = {}, city_shade = {},
               impostor = {};
    VkPipeline crowd[2] = {}, crowd_skinned[2] = {};  // without and with textures; skinned on the host
    VkPipeline contact = {}, stars = {};
};

// Those of the views for work, each made when it is first wanted.
enum class ViewPipeline {
    paint_city,
    paint_crowd,
    paint_impostor,
    count_city,
    count_crowd,
    count_impostor,
    ink_city,
    ink_crowd,
    ghost_crowd,
    id_scenery,
    fill,
    line,
    hidden_line,
};
inline constexpr size_t k_view_pipelines = 13;

struct Pipelines {
    Bindings bindings;
    VkPipelineLayout layout = {};
    VkPipeline shadow_city = {}, shadow_crowd = {}, shadow_skinned = {}, shadow_impostor = {},
               shadow_scenery = {};
    VkPipeline impostor_bake = {};
    SurfacePipelines surfaces;
    VkPipeline occlusion = {}, even_out = {}, occlude = {};        // made where the quality has occlusion
    VkPipeline light = {}, smooth_image = {}, smooth_window = {};  // made where the device lights
    VkPipeline panels_image = {}, panels_window = {};              // over pictures, and over windows
    std::array<VkPipeline, k_view_pipelines> views = {};           // by ViewPipeline; null until wanted
};

// `window_format` VK_FORMAT_UNDEFINED: no window. After a failure destroy_pipelines() frees what had been
// made.
Result<void> make_pipelines(const Device& device, const QualityLevel& quality, bool is_lit_on_host,
                            VkFormat window_format, Pipelines& pipelines);
void destroy_pipelines(const Device& device, Pipelines& pipelines);

// Makes those of `wanted` that there are not yet.
Result<void> make_view_pipelines(const Device& device, std::span<const ViewPipeline> wanted,
                                 Pipelines& pipelines);

}  // namespace flaneur
