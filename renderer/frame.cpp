#include "renderer/frame.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "renderer/check.h"

namespace flaneur {
namespace {

constexpr VkBufferUsageFlags k_storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

template <class T>
Result<void> upload(const Device& device, std::span<const T> first, std::span<const T> second,
                    VkBufferUsageFlags usage, Buffer& buffer) {
    FLANEUR_TRY(
        reserve_buffer(device, first.size_bytes() + second.size_bytes(), usage, MemoryKind::upload, buffer));
    auto* out = static_cast<std::byte*>(buffer.mapped);
    if (!first.empty()) std::memcpy(out, first.data(), first.size_bytes());
    if (!second.empty()) std::memcpy(out + first.size_bytes(), second.data(), second.size_bytes());
    return {};
}

void update_descriptors(const Renderer& renderer, const FrameSlot& slot) {
    const VkDescriptorBufferInfo buffers[] = {{slot.constants.handle, 0, VK_WHOLE_SIZE},
                                              {slot.instances.handle, 0, VK_WHOLE_SIZE},
                                              {slot.palette.handle, 0, VK_WHOLE_SIZE},
                                              {slot.impostors.handle, 0, VK_WHOLE_SIZE},
                                              {renderer.scene.impostors.cells.handle, 0, VK_WHOLE_SIZE}};
    const PictureTargets& targets = renderer.targets;
    const VkImageView none = targets.colour.view;  // where no pipeline looks
    const VkDescriptorImageInfo images[] = {
        {renderer.pipelines.shadow_sampler, renderer.shadows.map.view, k_sampled.layout},
        {renderer.pipelines.texture_sampler, renderer.scene.textures.view, k_sampled.layout},
        {renderer.pipelines.texture_sampler, renderer.targets.colour.view, k_sampled.layout},
        {renderer.pipelines.atlas_sampler, renderer.scene.impostors.atlas.view, k_sampled.layout},
        {renderer.pipelines.texture_sampler, renderer.scene.scenery.view, k_sampled.layout},
        {renderer.pipelines.lamp_sampler, renderer.scene.lamps.view, k_sampled.layout},
        {renderer.pipelines.atlas_sampler, renderer.quality.has_occlusion ? targets.depth.view : none,
         k_sampled.layout},
        {renderer.pipelines.atlas_sampler, renderer.quality.has_occlusion ? targets.occlusion.view : none,
         k_sampled.layout}};
    VkWriteDescriptorSet writes[k_bindings] = {};
    for (uint32_t i = 0; i < k_bindings; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = slot.set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = i == k_binding_frame   ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                   : i <= k_binding_cells ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                                          : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        if (i <= k_binding_cells)
            writes[i].pBufferInfo = &buffers[i];
        else
            writes[i].pImageInfo = &images[i - k_binding_shadow];
    }
    vkUpdateDescriptorSets(renderer.device.handle, k_bindings, writes, 0, nullptr);
}

Result<void> upload_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input, const FramePlan& plan,
                          VkExtent2D extent) {
    const Device& device = renderer.device;
    const uint64_t limit = device.properties.limits.maxStorageBufferRange;
    if (input.palette.size_bytes() > limit)
        return Error{"The frame's poses take " + std::to_string(input.palette.size_bytes() >> 20) +
                     " MiB; the device takes " + std::to_string(limit >> 20) +
                     " MiB at once. Draw fewer walkers."};
    const FrameConstants constants = frame_constants(renderer, plan, extent);
    FLANEUR_TRY(upload<FrameConstants>(device, std::span(&constants, 1), {},
                                       VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, slot.constants));
    FLANEUR_TRY(upload<WalkerInstance>(device, renderer.crowd.instances, renderer.casters.instances,
                                       k_storage, slot.instances));
    FLANEUR_TRY(upload<JointTransform>(device, input.palette, {}, k_storage, slot.palette));
    FLANEUR_TRY(upload<ImpostorInstance>(device, renderer.crowd.impostors, renderer.casters.impostors,
                                         k_storage, slot.impostors));
    FLANEUR_TRY(upload<DrawCommand>(device, plan.draws, {}, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, slot.draws));
    FLANEUR_TRY(upload<Contact>(device, plan.contacts, {}, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, slot.contacts));
    if (plan.lines > 0)
        FLANEUR_TRY(
            upload<GizmoLine>(device, input.lines, {}, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, slot.lines));
    if (plan.fills > 0)
        FLANEUR_TRY(
            upload<GizmoCorner>(device, input.fills, {}, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, slot.fills));
    update_descriptors(renderer, slot);
    return {};
}

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

// What is drawn into: several samples a pixel, or the picture before anti-aliasing itself.
const GpuImage& drawn_into(const PictureTargets& targets) {
    return targets.samples.view ? targets.samples : targets.colour;
}

// Begins drawing; `is_fresh`: over nothing, rather than over what is there; `is_last`: samples then become
// pixels.
void begin_picture(const FrameRecord& record, bool is_fresh, bool is_last = false) {
    const PictureTargets& targets = record.renderer.targets;
    const std::optional<glm::vec3>& backdrop = record.plan.backdrop;
    const VkImageView pixels = backdrop ? record.target.view : targets.colour.view;
    // Without a backdrop nothing needs clearing: the sky fills what nothing covers.
    VkRenderingAttachmentInfo colour = attachment(targets.samples.view ? targets.samples.view : pixels,
                                                  !is_fresh  ? VK_ATTACHMENT_LOAD_OP_LOAD
                                                  : backdrop ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                             : VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    if (is_last && targets.samples.view) {
        colour.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        colour.resolveImageView = pixels;
        colour.resolveImageLayout = k_colour_target.layout;
    }
    if (backdrop) colour.clearValue = {{{backdrop->r, backdrop->g, backdrop->b, 1}}};
    const VkRenderingAttachmentInfo depth =
        attachment(targets.depth.view, is_fresh ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = record.target.extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, record.target.extent);
}

bool has_overlay(const FramePlan& plan) { return plan.lines > 0 || plan.fills > 0 || plan.are_ghosts; }
void depth_barrier(const FrameRecord& record, Access from) {
    image_barrier(record.commands, record.renderer.targets.depth.handle, VK_IMAGE_ASPECT_DEPTH_BIT, from,
                  k_depth_target);
}
constexpr Access k_old_depth = {k_sampled.stage | k_depth_target.stage,
                                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED};

// Crowd, city and sky, lit and tone-mapped: one stage, or, where each one's time is asked for, one each that
// waits for the one before, for lavapipe draws lazily.
void draw_scene(const FrameRecord& record) {
    const PictureTargets& targets = record.renderer.targets;
    auto colour_barrier = [&](Access from, Access to) {
        image_barrier(record.commands, drawn_into(targets).handle, VK_IMAGE_ASPECT_COLOR_BIT, from, to);
    };
    colour_barrier({k_sampled.stage | k_colour_target.stage, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_UNDEFINED},
                   k_colour_target);
    depth_barrier(record, k_old_depth);
    if (targets.samples.view)
        image_barrier(record.commands, targets.colour.handle, VK_IMAGE_ASPECT_COLOR_BIT, discarded(k_sampled),
                      k_colour_target);
    const bool is_last = !has_overlay(record.plan);
    if (record.plan.surfaces_view != Surfaces::lit) {
        begin_stage(record, "paint");
        begin_picture(record, true, is_last);
        draw_paint(record);
        vkCmdEndRendering(record.commands);
        end_stage(record);
        return;
    }
    const bool is_split = record.plan.times_passes;
    auto next_pass = [&](const char* name, bool is_end) {
        if (!is_split) return;
        vkCmdEndRendering(record.commands);
        colour_barrier(k_colour_target, k_colour_target);
        depth_barrier(record, k_depth_target);
        end_stage(record);
        begin_stage(record, name);
        begin_picture(record, false, is_end && is_last);
    };
    begin_stage(record, is_split ? "crowd" : "scene");
    begin_picture(record, true, !is_split && is_last);
    if (!record.plan.are_ghosts) draw_crowd(record);
    draw_impostors(record);
    next_pass("city", false);
    draw_city(record);
    next_pass("sky", true);
    draw_contacts(record);
    draw_sky(record);
    vkCmdEndRendering(record.commands);
    end_stage(record);
}

// What comes after the scene: the overlay into the same samples, then what works on pixels.
void finish_picture(const FrameRecord& record) {
    const PictureTargets& targets = record.renderer.targets;
    auto barrier = [&](const GpuImage& image, Access from, Access to) {
        image_barrier(record.commands, image.handle, aspect_of(image.format), from, to);
    };
    const bool is_laid_over = has_overlay(record.plan);
    if (is_laid_over) {
        begin_stage(record, "overlay");
        barrier(drawn_into(targets), k_colour_target, k_colour_target);
        barrier(targets.depth, k_depth_target, k_depth_target);
        begin_picture(record, false, true);
        draw_overlay(record);
        vkCmdEndRendering(record.commands);
        end_stage(record);
    }
    // Occlusion would darken the overlay by what lies behind it.
    if (record.renderer.quality.has_occlusion && record.plan.surfaces_view == Surfaces::lit &&
        !is_laid_over) {
        begin_stage(record, "occlusion");
        barrier(targets.colour, k_colour_target, k_colour_target);
        draw_occlusion(record);
        end_stage(record);
    }
    barrier(targets.colour, k_colour_target, k_sampled);
}

// City and crowd before the backdrop, straight into the target.
void draw_plain(const FrameRecord& record) {
    const ShadowMaps& maps = record.renderer.shadows;
    image_barrier(record.commands, maps.map.handle, VK_IMAGE_ASPECT_DEPTH_BIT, discarded(k_sampled),
                  k_sampled);
    begin_stage(record, "crowd");
    depth_barrier(record, k_old_depth);
    if (const GpuImage& samples = record.renderer.targets.samples; samples.view)
        image_barrier(record.commands, samples.handle, VK_IMAGE_ASPECT_COLOR_BIT, discarded(k_colour_target),
                      k_colour_target);
    begin_picture(record, true, true);
    draw_crowd(record);
    draw_impostors(record);
    draw_city(record);
    vkCmdEndRendering(record.commands);
    end_stage(record);
}

// To the host.
void copy_picture(const FrameRecord& record) {
    const PictureTarget& target = record.target;
    begin_stage(record, "copy");
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {target.extent.width, target.extent.height, 1};
    vkCmdCopyImageToBuffer(record.commands, target.image, target.after.layout, target.readback, 1, &region);
    end_stage(record);
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(record.commands, &info);
}

// Between two empty barriers, which cost nothing but make lavapipe draw what it has put off: it would take
// the time only after the draws that follow.
void write_timestamp(const FrameRecord& record, uint32_t number) {
    if (!record.slot.timestamps) return;
    const VkDependencyInfo nothing{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    vkCmdPipelineBarrier2(record.commands, &nothing);
    vkCmdWriteTimestamp2(record.commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, record.slot.timestamps,
                         number);
    vkCmdPipelineBarrier2(record.commands, &nothing);
}

Result<void> record_frame(const FrameRecord& record) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    const Renderer& renderer = record.renderer;
    FLANEUR_VK(vkResetCommandPool(renderer.device.handle, record.slot.pool, 0), "record a frame");
    FLANEUR_VK(vkBeginCommandBuffer(record.commands, &begin), "record a frame");
    if (record.slot.timestamps)
        vkCmdResetQueryPool(record.commands, record.slot.timestamps, 0, k_max_stages + 1);
    if (record.slot.counters) vkCmdResetQueryPool(record.commands, record.slot.counters, 0, k_max_stages);
    write_timestamp(record, 0);
    vkCmdBindDescriptorSets(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, renderer.pipelines.layout, 0, 1,
                            &record.slot.set, 0, nullptr);
    vkCmdBindIndexBuffer(record.commands, renderer.scene.indices.handle, 0, VK_INDEX_TYPE_UINT32);
    // Beginning to count, lavapipe looks at the pipeline.
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, renderer.pipelines.fxaa_image);

    const bool is_plain = record.plan.backdrop.has_value();
    if (!is_plain) {
        draw_shadows(record);
        draw_scene(record);
        finish_picture(record);
    }
    image_barrier(record.commands, record.target.image, VK_IMAGE_ASPECT_COLOR_BIT, record.target.before,
                  k_colour_target);
    if (is_plain) {
        draw_plain(record);
    } else {
        begin_stage(record, "fxaa");
        draw_fxaa(record);
        end_stage(record);
    }
    image_barrier(record.commands, record.target.image, VK_IMAGE_ASPECT_COLOR_BIT, k_colour_target,
                  record.target.after);
    if (record.target.readback) copy_picture(record);

    FLANEUR_VK(vkEndCommandBuffer(record.commands), "record a frame");
    return {};
}

Result<void> submit(Renderer& renderer, FrameSlot& slot, VkSemaphore wait, VkSemaphore signal) {
    VkSemaphoreSubmitInfo waits{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    waits.semaphore = wait;
    waits.stageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    VkSemaphoreSubmitInfo signals{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    signals.semaphore = signal;
    signals.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commands.commandBuffer = slot.commands;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.waitSemaphoreInfoCount = wait ? 1 : 0;
    info.pWaitSemaphoreInfos = &waits;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    info.signalSemaphoreInfoCount = signal ? 1 : 0;
    info.pSignalSemaphoreInfos = &signals;
    FLANEUR_VK(vkResetFences(renderer.device.handle, 1, &slot.done), "submit a frame");
    FLANEUR_VK(vkQueueSubmit2(renderer.device.queue, 1, &info, slot.done), "submit a frame");
    slot.is_pending = true;
    return {};
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
    stats.direct_draws = plan.backdrop ? 0 : 2;  // sky, fxaa
    if (renderer.quality.has_occlusion && !plan.backdrop) stats.direct_draws += 2;
    for (bool is_drawn : {!plan.contacts.empty(), stats.impostors > 0, !renderer.casters.impostors.empty()})
        stats.direct_draws += is_drawn;
    stats.direct_draws += (plan.fills > 0) + 2 * (plan.lines > 0);
    stats.triangles = renderer.crowd.triangles + renderer.casters.triangles;
    for (DrawRange range :
         {plan.facades, plan.props, plan.surfaces[0], plan.surfaces[1], plan.surfaces[2], plan.scenery,
          plan.shades, plan.near_city, plan.far_city, plan.near_scenery, plan.far_scenery})
        for (uint32_t i = 0; i < range.count; ++i)
            stats.triangles += plan.draws[range.first + i].index_count / 3;
}

}  // namespace

void begin_stage(const FrameRecord& record, const char* name) {
    if (record.slot.counters)
        vkCmdBeginQuery(record.commands, record.slot.counters,
                        static_cast<uint32_t>(record.slot.stages.size()), 0);
    record.slot.stages.emplace_back(name);
    if (!record.renderer.device.has_labels) return;
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = name;
    vkCmdBeginDebugUtilsLabelEXT(record.commands, &label);
}

void end_stage(const FrameRecord& record) {
    if (record.renderer.device.has_labels) vkCmdEndDebugUtilsLabelEXT(record.commands);
    const uint32_t count = static_cast<uint32_t>(record.slot.stages.size());
    write_timestamp(record, count);
    if (record.slot.counters) vkCmdEndQuery(record.commands, record.slot.counters, count - 1);
}

const LitPipelines& lit_pipelines(const FrameRecord& record) {
    return record.renderer.pipelines.lit[record.plan.light_kind];
}

void draw_indirect(const FrameRecord& record, DrawRange range) {
    if (range.count == 0) return;
    vkCmdDrawIndexedIndirect(record.commands, record.slot.draws.handle, sizeof(DrawCommand) * range.first,
                             range.count, sizeof(DrawCommand));
}

void draw_over(const FrameRecord& record, VkImageView view, VkExtent2D extent, VkAttachmentLoadOp load,
               VkPipeline pipeline) {
    const VkRenderingAttachmentInfo colour = attachment(view, load);
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    vkCmdBeginRendering(record.commands, &info);
    set_viewport(record.commands, extent);
    vkCmdBindPipeline(record.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(record.commands, 3, 1, 0, 0);
    vkCmdEndRendering(record.commands);
}

void set_viewport(VkCommandBuffer commands, VkExtent2D extent) {
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

Result<void> draw_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                        const PictureTarget& target, VkSemaphore wait, VkSemaphore signal) {
    const auto begin = std::chrono::steady_clock::now();
    if (input.surfaces == Surfaces::wireframe && !renderer.device.has_wireframe)
        return Error{
            "This device draws no wireframe (it lacks fillModeNonSolid): look at normals instead, or "
            "try another --device."};
    FramePlan plan;
    plan_frame(renderer, input, target.extent, plan);
    FLANEUR_TRY(make_view_pipelines(renderer.device, view_pipelines_for(input), renderer.pipelines));
    FLANEUR_TRY(fit_targets(renderer, target.extent));
    FLANEUR_TRY(make_lit_pipelines(renderer.device, plan.light_kind, renderer.pipelines));
    FLANEUR_TRY(skin_people(renderer, slot, input, target.extent, plan));
    FLANEUR_TRY(upload_frame(renderer, slot, input, plan, target.extent));
    slot.stages.clear();
    FLANEUR_TRY(record_frame({renderer, slot, plan, target, slot.commands}));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    FLANEUR_TRY(submit(renderer, slot, wait, signal));
    renderer.shadows.near_box = plan.has_shadows ? plan.near_box : ShadowBox{};
    renderer.shadows.far_box = plan.has_shadows ? plan.far_box : ShadowBox{};
    renderer.stats.cpu_record_ms = took.count();
    count_frame(plan, renderer);
    return {};
}

Result<void> finish_slot(Renderer& renderer, FrameSlot& slot) {
    if (!slot.is_pending) return {};
    FLANEUR_VK(vkWaitForFences(renderer.device.handle, 1, &slot.done, VK_TRUE, UINT64_MAX), "finish a frame");
    slot.is_pending = false;
    std::vector<FrameStats::Stage>& stages = renderer.stats.stages;
    stages.clear();
    for (const std::string& name : slot.stages) stages.push_back({name});
    const uint32_t count = static_cast<uint32_t>(stages.size());
    if (slot.timestamps) {
        uint64_t times[k_max_stages + 1] = {};
        FLANEUR_VK(vkGetQueryPoolResults(renderer.device.handle, slot.timestamps, 0, count + 1, sizeof times,
                                         times, sizeof(uint64_t), VK_QUERY_RESULT_64_BIT),
                   "read a frame's times");
        const double ms = static_cast<double>(renderer.device.properties.limits.timestampPeriod) * 1e-6;
        for (uint32_t i = 0; i < count; ++i)
            stages[i].gpu_ms = static_cast<double>(times[i + 1] - times[i]) * ms;
    }
    if (slot.counters) {
        uint64_t shaded[k_max_stages][2] = {};  // in the order of the counters' bits
        FLANEUR_VK(vkGetQueryPoolResults(renderer.device.handle, slot.counters, 0, count, sizeof shaded,
                                         shaded, sizeof shaded[0], VK_QUERY_RESULT_64_BIT),
                   "read a frame's counters");
        for (uint32_t i = 0; i < count; ++i)
            stages[i].vertices = shaded[i][0], stages[i].fragments = shaded[i][1];
    }
    return {};
}

}  // namespace flaneur
