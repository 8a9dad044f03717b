#include "renderer/frame/uploads.h"

#include <cstring>

#include "renderer/device/check.h"
#include "sim/base/zone.h"

namespace flaneur {
namespace {

template <class T>
Result<void> upload(const Device& device, std::span<const T> first, std::span<const T> second,
                    VkBufferUsageFlags usage, Buffer& buffer, uint64_t& sum) {
    const uint64_t bytes = first.size_bytes() + second.size_bytes(),
                   most = device.properties.limits.maxStorageBufferRange;
    if (usage == VK_BUFFER_USAGE_STORAGE_BUFFER_BIT && bytes > most)
        return Error{"The frame's walkers take " + std::to_string(bytes >> 20) + " MiB; the device takes " +
                     std::to_string(most >> 20) + " MiB at once. Draw fewer walkers."};
    FLANEUR_TRY(reserve_buffer(device, bytes, usage, MemoryKind::upload, buffer));
    auto* out = static_cast<std::byte*>(buffer.mapped);
    if (!first.empty()) std::memcpy(out, first.data(), first.size_bytes());
    if (!second.empty()) std::memcpy(out + first.size_bytes(), second.data(), second.size_bytes());
    sum += bytes;
    return {};
}

Result<void> upload_panel_buffers(const Device& device, FrameSlot& slot, const Panels& panels,
                                  uint64_t& sum) {
    if (panels.draws.empty()) return {};
    for (const PanelDraw& draw : panels.draws)
        if (uint64_t{draw.first_index} + draw.index_count > panels.indices.size())
            return Error{"A panel refers to index " +
                         std::to_string(uint64_t{draw.first_index} + draw.index_count - 1) +
                         " but there are only " + std::to_string(panels.indices.size()) + "."};
    FLANEUR_TRY(upload<PanelVertex>(device, panels.vertices, {}, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                    slot.panel_vertices, sum));
    return upload<uint16_t>(device, panels.indices, {}, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, slot.panel_indices,
                            sum);
}

Result<void> upload_buffers(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                            const FramePlan& plan) {
    constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 vertices = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    const Device& device = renderer.device;
    uint64_t& sum = renderer.stats.uploaded_bytes;
    FLANEUR_TRY(upload<FrameConstants>(device, std::span(&plan.constants, 1), {},
                                       VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, slot.constants, sum));
    // Of people whom the host has skinned the device need know nothing more.
    const bool is_anyone_left = plan.crowd.count + plan.casters.count > 0;
    auto if_left = [&](auto span) { return is_anyone_left ? span : decltype(span){}; };
    FLANEUR_TRY(upload(device, if_left(std::span<const WalkerInstance>(renderer.crowd.instances)),
                       if_left(std::span<const WalkerInstance>(renderer.casters.instances)), storage,
                       slot.instances, sum));
    FLANEUR_TRY(upload(device, if_left(input.palette), {}, storage, slot.palette, sum));
    FLANEUR_TRY(upload<ImpostorInstance>(device, renderer.crowd.impostors, renderer.casters.impostors,
                                         storage, slot.impostors, sum));
    FLANEUR_TRY(upload<vec4>(device, plan.sky, {}, storage, slot.sky, sum));
    FLANEUR_TRY(
        upload<DrawCommand>(device, plan.draws, {}, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, slot.draws, sum));
    FLANEUR_TRY(upload<Contact>(device, plan.contacts, {}, vertices, slot.contacts, sum));
    if (plan.lines > 0) FLANEUR_TRY(upload<GizmoLine>(device, input.lines, {}, vertices, slot.lines, sum));
    FLANEUR_TRY(upload_panel_buffers(device, slot, input.panels, sum));
    if (plan.fills > 0) FLANEUR_TRY(upload<GizmoCorner>(device, input.fills, {}, vertices, slot.fills, sum));
    return {};
}

void bind_frame(const Renderer& renderer, const FrameSlot& slot) {
    const GpuScene& scene = renderer.scene;
    const PictureTargets& targets = renderer.targets;
    // Where no pipeline looks is something that it could look at.
    auto or_none = [&](const GpuImage& image) { return image.view ? image.view : targets.colour.view; };
    std::array<Bound, k_bindings> bound;
    bound[k_binding_frame].buffer = slot.constants.handle;
    bound[k_binding_instances].buffer = slot.instances.handle;
    bound[k_binding_palette].buffer = slot.palette.handle;
    bound[k_binding_impostors].buffer = slot.impostors.handle;
    bound[k_binding_cells].buffer = scene.impostors.cells.handle;
    bound[k_binding_sky].buffer = slot.sky.handle;
    bound[k_binding_shadow].view = renderer.shadows.map.view;
    bound[k_binding_textures].view = scene.textures.view;
    bound[k_binding_atlas].view = scene.impostors.atlas.view;
    bound[k_binding_scenery].view = scene.scenery.view;
    bound[k_binding_letters].view = or_none(renderer.letters);
    bound[k_binding_lamps].view = scene.lamps.view;
    bound[k_binding_colour].view = targets.colour.view;
    bound[k_binding_surface].view = targets.surface.view;
    bound[k_binding_depth].view = targets.depth.view;
    bound[k_binding_occlusion].view = or_none(targets.occlusion);
    bound[k_binding_even_occlusion].view = or_none(targets.even_occlusion);
    bound[k_binding_picture].view = or_none(targets.picture);
    bound[k_binding_overlay].view = or_none(targets.overlay);
    write_bindings(renderer.device, renderer.pipelines.bindings, bound, slot.set);
}

Result<void> skin_into(Renderer& renderer, const SkinPlan& skin, std::span<const WalkerInstance> instances,
                       std::span<const JointTransform> palette, const SkinView& view, SkinBuffers& buffers,
                       std::span<DrawCommand> draws) {
    if (skin.batches.empty()) return {};
    const Device& device = renderer.device;
    FLANEUR_TRY(reserve_buffer(device, sizeof(SkinnedVertex) * skin.vertices,
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryKind::upload, buffers.vertices));
    FLANEUR_TRY(reserve_buffer(device, sizeof(uint32_t) * skin.indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                               MemoryKind::upload, buffers.indices));
    renderer.stats.uploaded_bytes += sizeof(SkinnedVertex) * skin.vertices + sizeof(uint32_t) * skin.indices;
    renderer.skin_scratch.resize(static_cast<size_t>(thread_count(*renderer.workers)));
    parallel_for(*renderer.workers, skin.batches.size(), 1, [&](size_t begin, size_t end, int thread) {
        for (size_t i = begin; i < end; ++i)
            draws[i] = skin_batch(skin, skin.batches[i], instances, palette, view,
                                  renderer.skin_scratch[static_cast<size_t>(thread)],
                                  static_cast<SkinnedVertex*>(buffers.vertices.mapped),
                                  static_cast<uint32_t*>(buffers.indices.mapped));
    });
    return {};
}

// Those of the crowd, and those who throw shadows.
Result<void> skin_people(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                         FramePlan& plan) {
    auto draws = [&](DrawRange range) { return std::span(plan.draws).subspan(range.first, range.count); };
    FLANEUR_TRY(skin_into(renderer, plan.crowd_skin, renderer.crowd.instances, input.palette,
                          skin_view(plan.view, extent.width * renderer.quality.samples,
                                    extent.height * renderer.quality.samples),
                          slot.crowd, draws(plan.crowd_skinned)));
    return skin_into(renderer, plan.casters_skin, renderer.casters.instances, input.palette,
                     skin_view(plan.near, renderer.quality.shadow_resolution), slot.casters,
                     draws(plan.casters_skinned));
}

}  // namespace

Result<void> upload_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                          FramePlan& plan) {
    renderer.stats.uploaded_bytes = 0;
    {
        FLANEUR_ZONE("skin");
        FLANEUR_TRY(skin_people(renderer, slot, input, extent, plan));
    }
    FLANEUR_ZONE("upload");
    FLANEUR_TRY(upload_buffers(renderer, slot, input, plan));
    bind_frame(renderer, slot);
    return {};
}

Result<void> upload_panels(Renderer& renderer, FrameSlot& slot, const Panels& panels) {
    FLANEUR_TRY(upload_panel_buffers(renderer.device, slot, panels, renderer.stats.uploaded_bytes));
    bind_frame(renderer, slot);
    return {};
}

}  // namespace flaneur
