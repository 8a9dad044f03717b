#include "renderer/picture/draw.h"

#include <algorithm>

#include "renderer/device/check.h"
#include "renderer/frame/uploads.h"
#include "renderer/passes/passes.h"
#include "renderer/picture/picture.h"
#include "sim/base/zone.h"

namespace flaneur {
namespace {

Result<void> fit_targets(Renderer& renderer, VkExtent2D extent, bool has_overlay) {
    PictureTargets& targets = renderer.targets;
    const bool fits =
        targets.depth.view && targets.extent.width == extent.width && targets.extent.height == extent.height;
    if (fits && (targets.overlay.view || !has_overlay)) return {};
    FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
    auto make = [&]() -> Result<void> {
        if (!fits) {
            destroy_picture_targets(renderer.device, targets);
            FLANEUR_TRY(make_picture_targets(renderer.device, renderer.quality, renderer.is_lit_on_host,
                                             extent, targets));
        }
        return has_overlay ? make_overlay(renderer.device, renderer.is_lit_on_host, targets) : Result<void>();
    };
    Result<void> result = make();
    if (!result) destroy_picture_targets(renderer.device, targets);
    return result;
}

Result<void> record(const FrameRecord& record, void (*draw)(const FrameRecord&)) {
    FLANEUR_ZONE("record");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    FLANEUR_VK(vkResetCommandPool(record.renderer.device.handle, record.slot.pool, 0), "record a frame");
    FLANEUR_VK(vkBeginCommandBuffer(record.commands, &begin), "record a frame");
    draw(record);
    FLANEUR_VK(vkEndCommandBuffer(record.commands), "record a frame");
    return {};
}

// After a frame was recorded in part and given up.
void forget_images(Renderer& renderer, const PictureTarget& target) {
    PictureTargets& targets = renderer.targets;
    ShadowMaps& shadows = renderer.shadows;
    for (GpuImage* image : {&targets.colour, &targets.surface, &targets.depth, &targets.overlay,
                            &targets.occlusion, &targets.even_occlusion, &targets.picture, &shadows.map})
        forget_image(*image);
    if (target.image) forget_image(*target.image);
    if (target.scaled) forget_image(*target.scaled);
    shadows.state = {};
}

// Once the device has drawn what it is of.
void light_on_host(Renderer& renderer, const FramePlan& plan, const PictureTarget& target) {
    const PictureTargets& from = renderer.targets;
    Unlit unlit;
    unlit.frame = &plan.constants;
    unlit.colours = {static_cast<const int32_t*>(from.colour.mapped), from.colour.row_bytes / 4};
    unlit.surfaces = {static_cast<const int32_t*>(from.surface.mapped), from.surface.row_bytes / 8};
    unlit.depths = {static_cast<const float*>(from.depth.mapped), from.depth.row_bytes / 4};
    unlit.overlay = {static_cast<const int32_t*>(from.overlay.mapped), from.overlay.row_bytes / 4};
    unlit.shadows = static_cast<const uint16_t*>(renderer.shadows.copy.mapped);
    unlit.lamps = renderer.scene.lamp_texels;
    unlit.lamps_width = static_cast<int>(renderer.scene.lamps.width);
    unlit.sky = plan.sky;
    unlit.smooths_edges = renderer.quality.smooths_edges;
    FrameStats::Stage& light = renderer.stats.stages.emplace_back();
    light.name = "light";
    FLANEUR_ZONE("light", light.gpu_ms);
    light_picture(unlit, *renderer.workers, renderer.lit, target.is_blue_first, target.pixels);
}

void count_frame(const FramePlan& plan, Renderer& renderer) {
    FrameStats& stats = renderer.stats;
    stats.walkers_drawn = stats.impostors = 0;
    std::fill(std::begin(stats.meshes), std::end(stats.meshes), 0);
    for (const Levels& levels : renderer.crowd.levels) {
        if (levels.fine == k_unseen) continue;
        ++stats.walkers_drawn;
        ++(levels.fine == k_impostor_level ? stats.impostors : stats.meshes[levels.fine]);
    }
    stats.walkers_in_shadow =
        static_cast<uint32_t>(renderer.casters.instances.size() + renderer.casters.impostors.size());
    stats.sub_draws = static_cast<uint32_t>(plan.draws.size());
    stats.shadow_slices_drawn = 0;
    for (const ShadowSlices& slices : plan.slices) stats.shadow_slices_drawn += slices.count;
    const bool is_lit = plan.surfaces_view == Surfaces::lit && !plan.backdrop;
    stats.direct_draws = renderer.is_lit_on_host ? 0 : 2;  // light, anti-aliasing
    if (renderer.quality.has_occlusion && is_lit) stats.direct_draws += 3;
    for (bool is_drawn : {is_lit && plan.light.lamps > 0, !plan.contacts.empty(), stats.impostors > 0,
                          !renderer.casters.impostors.empty()})
        stats.direct_draws += is_drawn;
    stats.direct_draws += (plan.fills > 0) + 2 * (plan.lines > 0);
    stats.triangles = renderer.crowd.triangles + renderer.casters.triangles;
    auto count = [&](DrawRange range) {
        for (uint32_t i = 0; i < range.count; ++i)
            stats.triangles += plan.draws[range.first + i].index_count / 3;
    };
    for (DrawRange range : plan.surfaces) count(range);
    for (const CityCasters& casters : plan.slice_casters) count(casters.opaque), count(casters.scenery);
}

// Curves of a trace.
void trace_counts(const FrameStats& stats) {
    if (!is_tracing()) return;
    constexpr const char* k_level_names[k_max_lods] = {
        "people, level 0", "people, level 1", "people, level 2", "people, level 3", "people, level 4"};
    for (size_t level = 0; level < k_max_lods; ++level)
        trace_counter(k_level_names[level], stats.meshes[level]);
    trace_counter("people as impostors", stats.impostors);
    trace_counter("people in sight", stats.walkers_drawn);
    trace_counter("people who throw shadows", stats.walkers_in_shadow);
    trace_counter("draws", stats.sub_draws + stats.direct_draws);
    trace_counter("triangles", stats.triangles);
    trace_counter("bytes handed to the device", static_cast<double>(stats.uploaded_bytes));
}

}  // namespace

Result<void> draw_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                        const PictureTarget& target, Wait wait, VkSemaphore signal) {
    const int64_t begin = trace_now();
    if (input.surfaces == Surfaces::wireframe && !renderer.device.has_wireframe)
        return Error{
            "This device draws no wireframe (it lacks fillModeNonSolid): look at normals instead, or "
            "try another --device."};
    FramePlan plan;
    {
        FLANEUR_ZONE("cull and plan");
        plan_frame(renderer, input, target.extent, plan);
    }
    FLANEUR_TRY(fit_targets(renderer, target.extent, has_overlay(plan)));
    FLANEUR_TRY(make_view_pipelines(renderer.device, view_pipelines_for(input), renderer.pipelines));
    FLANEUR_TRY(upload_frame(renderer, slot, input, target.extent, plan));
    const FrameRecord frame{renderer, slot, plan, target, slot.commands};
    auto draw = [&]() -> Result<void> {
        FLANEUR_TRY(record(frame, record_picture));
        renderer.stats.cpu_record_ms = static_cast<double>(trace_now() - begin) * 1e-6;
        const bool is_last = !renderer.is_lit_on_host;
        return submit_slot(renderer.device, slot, is_last ? wait : Wait{}, is_last ? signal : VkSemaphore{});
    };
    auto finish_on_host = [&]() -> Result<void> {
        FLANEUR_TRY(finish_slot(renderer.device, slot, renderer.stats));
        light_on_host(renderer, plan, target);
        if (!target.image) return {};
        FLANEUR_TRY(record(frame, record_picture_from_host));
        return submit_slot(renderer.device, slot, wait, signal);
    };
    Result<void> done = draw();
    if (done && renderer.is_lit_on_host) done = finish_on_host();
    if (!done) {
        forget_images(renderer, target);
        return done;
    }
    renderer.shadows.state = std::move(plan.shadows);
    count_frame(plan, renderer);
    trace_counts(renderer.stats);
    return {};
}

Result<void> draw_over_picture(Renderer& renderer, FrameSlot& slot, const Panels& panels,
                               const PictureTarget& target, Wait wait, VkSemaphore signal) {
    if (!slot.constants.handle || !renderer.targets.colour.view)
        return Error{"Nothing has been drawn yet, over which panels could lie."};
    FramePlan plan;
    plan.panels = panels.draws;
    FLANEUR_TRY(upload_panels(renderer, slot, panels));
    FLANEUR_TRY(record({renderer, slot, plan, target, slot.commands}, record_picture_from_host));
    return submit_slot(renderer.device, slot, wait, signal);
}

}  // namespace flaneur
