#include "renderer/picture/draw.h"

#include <algorithm>
#include <chrono>

#include "renderer/device/check.h"
#include "renderer/frame/uploads.h"
#include "renderer/passes/passes.h"
#include "renderer/picture/picture.h"

namespace flaneur {
namespace {

Result<void> fit_targets(Renderer& renderer, VkExtent2D extent) {
    PictureTargets& targets = renderer.targets;
    if (targets.colour.view && targets.depth.view && targets.colour.width == extent.width &&
        targets.colour.height == extent.height)
        return {};
    FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
    destroy_picture_targets(renderer.device, targets);
    Result<void> result =
        make_picture_targets(renderer.device, renderer.quality, extent.width, extent.height, targets);
    if (!result) destroy_picture_targets(renderer.device, targets);
    return result;
}

Result<void> record_frame(const FrameRecord& record) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    FLANEUR_VK(vkResetCommandPool(record.renderer.device.handle, record.slot.pool, 0), "record a frame");
    FLANEUR_VK(vkBeginCommandBuffer(record.commands, &begin), "record a frame");
    record_picture(record);
    FLANEUR_VK(vkEndCommandBuffer(record.commands), "record a frame");
    return {};
}

// After a frame was recorded in part and given up.
void forget_images(Renderer& renderer, GpuImage& picture) {
    PictureTargets& targets = renderer.targets;
    ShadowMaps& shadows = renderer.shadows;
    for (GpuImage* image :
         {&targets.colour, &targets.samples, &targets.depth, &targets.occlusion, &shadows.map, &picture})
        forget_image(*image);
    shadows.held = {};
}

void count_frame(const FramePlan& plan, Renderer& renderer) {
    FrameStats& stats = renderer.stats;
    stats.impostors = static_cast<uint32_t>(renderer.crowd.impostors.size());
    std::fill(std::begin(stats.meshes), std::end(stats.meshes), 0);
    for (const uint8_t level : renderer.crowd.levels)
        if (level < k_max_lods) ++stats.meshes[level];
    stats.walkers_drawn = static_cast<uint32_t>(renderer.crowd.instances.size()) + stats.impostors;
    stats.walkers_in_shadow =
        static_cast<uint32_t>(renderer.casters.instances.size() + renderer.casters.impostors.size());
    stats.sub_draws = static_cast<uint32_t>(plan.draws.size());
    stats.shadow_maps_drawn = uint32_t{plan.boxes.is_near_new} + uint32_t{plan.boxes.is_far_new};
    stats.direct_draws = plan.backdrop ? 0 : 2;  // sky, fxaa
    if (renderer.quality.has_occlusion && !plan.backdrop) stats.direct_draws += 2;
    for (bool is_drawn : {!plan.contacts.empty(), stats.impostors > 0, !renderer.casters.impostors.empty()})
        stats.direct_draws += is_drawn;
    stats.direct_draws += (plan.fills > 0) + 2 * (plan.lines > 0);
    stats.triangles = renderer.crowd.triangles + renderer.casters.triangles;
    auto count = [&](DrawRange range) {
        for (uint32_t i = 0; i < range.count; ++i)
            stats.triangles += plan.draws[range.first + i].index_count / 3;
    };
    for (DrawRange range : plan.surfaces) count(range);
    for (const CityCasters& casters : {plan.near_casters, plan.far_casters})
        count(casters.opaque), count(casters.scenery);
}

}  // namespace

Result<void> draw_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                        const PictureTarget& target, VkSemaphore wait, VkSemaphore signal) {
    const auto begin = std::chrono::steady_clock::now();
    if (input.surfaces == Surfaces::wireframe && !renderer.device.has_wireframe)
        return Error{
            "This device draws no wireframe (it lacks fillModeNonSolid): look at normals instead, or "
            "try another --device."};
    const VkExtent2D extent = extent_of(target.image);
    FramePlan plan;
    plan_frame(renderer, input, extent, plan);
    FLANEUR_TRY(fit_targets(renderer, extent));
    const uint32_t made_before = renderer.pipelines.made;
    FLANEUR_TRY(make_lit_pipelines(renderer.device, plan.light_kind, renderer.pipelines));
    FLANEUR_TRY(make_view_pipelines(renderer.device, view_pipelines_for(input), renderer.pipelines));
    FLANEUR_TRY(upload_frame(renderer, slot, input, extent, plan));
    Result<void> done = record_frame({renderer, slot, plan, target, slot.commands});
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (done) done = submit_slot(renderer.device, slot, wait, signal);
    if (!done) {
        forget_images(renderer, target.image);
        return done;
    }
    renderer.shadows.held = plan.has_shadows ? plan.boxes : ShadowBoxes{};
    renderer.stats.cpu_record_ms = took.count();
    renderer.stats.pipelines_made = renderer.pipelines.made - made_before;
    count_frame(plan, renderer);
    return {};
}

}  // namespace flaneur
