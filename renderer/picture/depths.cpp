#include "renderer/picture/depths.h"

#include <algorithm>
#include <limits>

#include "renderer/device/check.h"

namespace flaneur {
namespace {

Result<void> copy_depths(const Device& device, GpuImage& depth, Buffer& copy) {
    FLANEUR_TRY(make_buffer(device, VkDeviceSize{sizeof(float)} * depth.width * depth.height,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, copy));
    return run_once(device, [&](VkCommandBuffer commands) {
        image_to(commands, depth, k_copied_from);
        const VkBufferImageCopy region = whole_of(depth);
        vkCmdCopyImageToBuffer(commands, depth.handle, k_copied_from.layout, copy.handle, 1, &region);
        wait_between(commands, k_copied_to, k_read_by_host);
    });
}

}  // namespace

Result<void> read_depths(Renderer& renderer, float near_plane, Image& image) {
    GpuImage& depth = renderer.targets.depth;
    Buffer copy;
    const auto* first = static_cast<const float*>(depth.mapped);
    size_t stride = depth.row_bytes / sizeof(float);
    if (!renderer.is_lit_on_host) {
        if (Result<void> copied = copy_depths(renderer.device, depth, copy); !copied) {
            destroy_buffer(renderer.device, copy);
            return copied;
        }
        first = static_cast<const float*>(copy.mapped);
        stride = depth.width;
    }
    const uint32_t samples = depth.width / image.width;
    image.depths.resize(size_t{image.width} * image.height);
    for (size_t i = 0; i < image.depths.size(); ++i) {
        const float* corner = first + i / image.width * samples * stride + i % image.width * samples;
        float nearest = 0;  // reversed: 1 at the near plane, 0 where nothing is
        uint32_t covered = 0;
        for (uint32_t k = 0; k < samples * samples; ++k) {
            const float value = corner[k / samples * stride + k % samples];
            nearest = std::max(nearest, value);
            covered += value > 0;
        }
        image.depths[i] = nearest > 0 ? near_plane / nearest : std::numeric_limits<float>::infinity();
        image.rgba[4 * i + 3] = static_cast<uint8_t>(255 * covered / (samples * samples));
    }
    destroy_buffer(renderer.device, copy);
    return {};
}

}  // namespace flaneur
