#include "renderer/picture/channels.h"

#include <algorithm>
#include <limits>

#include "renderer/device/check.h"
#include "renderer/picture/draw.h"

namespace flaneur {
namespace {

// Rows of a target's samples, 4 bytes each, where the host reads them.
template <class Value>
struct Samples {
    const Value* first;
    size_t stride;
};

// `copy`, of the device's, holds them where the host does not read the target itself.
template <class Value>
Result<Samples<Value>> read_target(const Renderer& renderer, GpuImage& target, Buffer& copy) {
    static_assert(sizeof(Value) == 4);
    if (renderer.is_lit_on_host)
        return Samples<Value>{static_cast<const Value*>(target.mapped), target.row_bytes / 4};
    FLANEUR_TRY(make_buffer(renderer.device, VkDeviceSize{4} * target.width * target.height,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, copy));
    FLANEUR_TRY(run_once(renderer.device, [&](VkCommandBuffer commands) {
        image_to(commands, target, k_copied_from);
        const VkBufferImageCopy region = whole_of(target);
        vkCmdCopyImageToBuffer(commands, target.handle, k_copied_from.layout, copy.handle, 1, &region);
        wait_between(commands, k_copied_to, k_read_by_host);
    }));
    return Samples<Value>{static_cast<const Value*>(copy.mapped), target.width};
}

// Draws ids in place of light, where what surfaces are is kept. People wear theirs.
Result<void> draw_ids(Renderer& renderer, const FrameInput& frame, VkExtent2D extent) {
    std::vector<WalkerDraw> walkers(frame.walkers.begin(), frame.walkers.end());
    for (WalkerDraw& walker : walkers) std::ranges::fill(walker.instance.tints, walker.id);
    FrameInput ids = frame;
    ids.walkers = walkers;
    ids.surfaces = Surfaces::ids;
    ids.people_colours = PeopleColours::own;
    ids.backdrop.reset();
    ids.lines = {}, ids.fills = {}, ids.panels = {};
    ids.times_passes = false;
    FrameSlot& slot = renderer.slots[0];
    std::vector<uint32_t> unseen;
    PictureTarget target{.extent = extent};
    if (renderer.is_lit_on_host) {
        unseen.resize(size_t{extent.width} * extent.height);
        target.pixels = unseen.data();
    } else {
        target.image = &renderer.picture;
        target.smooth = renderer.pipelines.smooth_image;
        target.after = k_copied_from;
    }
    FLANEUR_TRY(draw_frame(renderer, slot, ids, target, {}, {}));
    return finish_slot(renderer.device, slot, renderer.stats);
}

Result<void> read_channels(const Renderer& renderer, PictureTargets& targets, const FrameInput& frame,
                           Buffer (&copies)[2], Image& image) {
    const Result<Samples<float>> depths = read_target<float>(renderer, targets.depth, copies[0]);
    if (!depths) return depths.error();
    Samples<uint32_t> ids{};
    if (frame.wants_ids) {
        Result<Samples<uint32_t>> read = read_target<uint32_t>(renderer, targets.colour, copies[1]);
        if (!read) return read.error();
        ids = *read;
    }
    const size_t samples = targets.depth.width / image.width, pixels = size_t{image.width} * image.height;
    if (frame.wants_depths) image.depths.resize(pixels);
    if (frame.wants_ids) image.ids.resize(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const size_t x = i % image.width * samples, y = i / image.width * samples;
        float nearest = 0;  // reversed: 1 at the near plane, 0 where nothing is
        size_t covered = 0, nearest_x = x, nearest_y = y;
        for (size_t k = 0; k < samples * samples; ++k) {
            const size_t at_x = x + k % samples, at_y = y + k / samples;
            const float value = depths->first[at_y * depths->stride + at_x];
            covered += value > 0;
            if (value > nearest) nearest = value, nearest_x = at_x, nearest_y = at_y;
        }
        constexpr uint32_t opaque = 0xff000000u;
        if (frame.wants_ids && nearest > 0)
            image.ids[i] = ids.first[nearest_y * ids.stride + nearest_x] & ~opaque;
        if (!frame.wants_depths) continue;
        image.depths[i] =
            nearest > 0 ? frame.camera.near_plane / nearest : std::numeric_limits<float>::infinity();
        image.rgba[4 * i + 3] = static_cast<uint8_t>(255 * covered / (samples * samples));
    }
    return {};
}

}  // namespace

Result<void> add_channels(Renderer& renderer, const FrameInput& frame, Image& image) {
    if (!frame.wants_depths && !frame.wants_ids) return {};
    if (frame.wants_ids) FLANEUR_TRY(draw_ids(renderer, frame, {image.width, image.height}));
    Buffer copies[2] = {{"depths for the host"}, {"ids for the host"}};
    Result<void> read = read_channels(renderer, renderer.targets, frame, copies, image);
    for (Buffer& copy : copies) destroy_buffer(renderer.device, copy);
    return read;
}

}  // namespace flaneur
