#include "renderer/frame/uploads.h"

#include <cstring>

#include "renderer/device/check.h"
#include "renderer/light/look.h"

namespace flaneur {
namespace {

// From which share of their reach on people's shadows fade.
constexpr float k_plain_shadows = 0.8f;

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

FrameConstants frame_constants(const Renderer& renderer, const FramePlan& plan, VkExtent2D extent) {
    auto v4 = [](vec3 v, float w = 0) { return vec4(v, w); };
    FrameConstants out = lit_by(plan.light, plan.lit_windows);
    out.clip_from_world = plan.view.clip_from_world;
    out.shadow_from_world = plan.boxes.near.map_from_world;
    const float ratio = plan.boxes.near.size / plan.boxes.far.size;
    out.far_scale = v4(vec3(ratio));
    out.far_offset = plan.boxes.far.map_from_world[3] - plan.boxes.near.map_from_world[3] * ratio;
    const float resolution = static_cast<float>(renderer.quality.shadow_resolution);
    out.shadow_texels = {plan.boxes.near.texel, plan.boxes.far.texel, resolution, 1 / resolution};
    const float reach = plan.slice.far, faded = reach * reach * (1 - k_plain_shadows * k_plain_shadows);
    out.people_shadows = {reach * reach / faded, 1 / faded, 0, 0};
    out.eye = v4(plan.view.eye);
    out.ray_forward = v4(plan.view.forward, 1 / plan.view.pixels_at_one_metre);
    out.ray_right = v4(plan.view.right);
    out.ray_down = v4(plan.view.down);
    out.sun_direction = plan.has_shadows || plan.backdrop ? v4(plan.light.to_light) : vec4(0, -1, 0, 0);
    out.lamp_map = renderer.scene.lamp_map;
    const vec2 size(extent.width, extent.height);
    out.screen = {size.x, size.y, 1 / size.x, 1 / size.y};
    return out;
}

Result<void> upload_buffers(Renderer& renderer, FrameSlot& slot, const FrameInput& input,
                            const FramePlan& plan, VkExtent2D extent) {
    constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 vertices = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    const Device& device = renderer.device;
    const uint64_t limit = device.properties.limits.maxStorageBufferRange;
    if (input.palette.size_bytes() > limit)
        return Error{"The frame's poses take " + std::to_string(input.palette.size_bytes() >> 20) +
                     " MiB; the device takes " + std::to_string(limit >> 20) +
                     " MiB at once. Draw fewer walkers."};
    const FrameConstants constants = frame_constants(renderer, plan, extent);
    FLANEUR_TRY(upload<FrameConstants>(device, std::span(&constants, 1), {},
                                       VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, slot.constants));
    FLANEUR_TRY(upload<WalkerInstance>(device, renderer.crowd.instances, renderer.casters.instances, storage,
                                       slot.instances));
    FLANEUR_TRY(upload<JointTransform>(device, input.palette, {}, storage, slot.palette));
    FLANEUR_TRY(upload<ImpostorInstance>(device, renderer.crowd.impostors, renderer.casters.impostors,
                                         storage, slot.impostors));
    FLANEUR_TRY(upload<DrawCommand>(device, plan.draws, {}, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, slot.draws));
    FLANEUR_TRY(upload<Contact>(device, plan.contacts, {}, vertices, slot.contacts));
    if (plan.lines > 0) FLANEUR_TRY(upload<GizmoLine>(device, input.lines, {}, vertices, slot.lines));
    if (plan.fills > 0) FLANEUR_TRY(upload<GizmoCorner>(device, input.fills, {}, vertices, slot.fills));
    return {};
}

void bind_frame(const Renderer& renderer, const FrameSlot& slot) {
    const GpuScene& scene = renderer.scene;
    const PictureTargets& targets = renderer.targets;
    const VkImageView none = targets.colour.view;  // where no pipeline looks
    std::array<Bound, k_bindings> bound;
    bound[k_binding_frame].buffer = slot.constants.handle;
    bound[k_binding_instances].buffer = slot.instances.handle;
    bound[k_binding_palette].buffer = slot.palette.handle;
    bound[k_binding_impostors].buffer = slot.impostors.handle;
    bound[k_binding_cells].buffer = scene.impostors.cells.handle;
    bound[k_binding_shadow].view = renderer.shadows.map.view;
    bound[k_binding_textures].view = scene.textures.view;
    bound[k_binding_picture].view = targets.colour.view;
    bound[k_binding_atlas].view = scene.impostors.atlas.view;
    bound[k_binding_scenery].view = scene.scenery.view;
    bound[k_binding_lamps].view = scene.lamps.view;
    bound[k_binding_depth].view = renderer.quality.has_occlusion ? targets.depth.view : none;
    bound[k_binding_occlusion].view = renderer.quality.has_occlusion ? targets.occlusion.view : none;
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
                          skin_view(plan.view, extent.width, extent.height, renderer.quality.samples),
                          slot.crowd, draws(plan.crowd_skinned)));
    return skin_into(renderer, plan.casters_skin, renderer.casters.instances, input.palette,
                     skin_view(plan.boxes.near, renderer.quality.shadow_resolution), slot.casters,
                     draws(plan.casters_skinned));
}

}  // namespace

Result<void> upload_frame(Renderer& renderer, FrameSlot& slot, const FrameInput& input, VkExtent2D extent,
                          FramePlan& plan) {
    FLANEUR_TRY(skin_people(renderer, slot, input, extent, plan));
    FLANEUR_TRY(upload_buffers(renderer, slot, input, plan, extent));
    bind_frame(renderer, slot);
    return {};
}

}  // namespace flaneur
