#include "renderer/device/resources.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "renderer/device/check.h"
#include "renderer/device/names.h"

namespace flaneur {
namespace {

// Memory is taken by whole blocks, as drivers hand it out; with odd sizes synchronisation validation
// (1.3.239) takes images that the host reads for the buffers beside them.
constexpr VkDeviceSize k_block = 1u << 16;

// Of the types that fit, those with the best flags first.
std::vector<uint32_t> memory_types(const Device& device, uint32_t allowed, MemoryKind kind) {
    constexpr VkMemoryPropertyFlags host =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryPropertyFlags best = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, good = 0;
    if (kind == MemoryKind::upload) best = host | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, good = host;
    if (kind == MemoryKind::staging) best = good = host;
    if (kind == MemoryKind::readback) best = host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, good = host;
    std::vector<uint32_t> types;
    for (const VkMemoryPropertyFlags flags : {best, good})
        for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
            const bool is_listed = std::find(types.begin(), types.end(), i) != types.end();
            const VkMemoryPropertyFlags has = device.memory.memoryTypes[i].propertyFlags;
            if ((allowed >> i & 1) && (has & flags) == flags && !is_listed) types.push_back(i);
        }
    return types;
}

// Where a kind of memory is full, such as the little that both host and device reach fast, in the next.
Result<void> allocate(const Device& device, const VkMemoryRequirements& needs, MemoryKind kind,
                      VkDeviceMemory& memory) {
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = (needs.size + k_block - 1) / k_block * k_block;
    VkResult result = VK_ERROR_FORMAT_NOT_SUPPORTED;
    for (const uint32_t type : memory_types(device, needs.memoryTypeBits, kind)) {
        info.memoryTypeIndex = type;
        result = vkAllocateMemory(device.handle, &info, nullptr, &memory);
        if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY) break;
    }
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED)
        return Error{"The Vulkan device has no memory of a kind that is needed."};
    FLANEUR_VK(result, "allocate " + std::to_string(needs.size / 1024) + " KiB");
    return {};
}

void barrier(VkCommandBuffer commands, const GpuImage& image, const Access& from, const Access& to,
             VkImageSubresourceRange range) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = from.stage;
    barrier.srcAccessMask = from.access;
    barrier.oldLayout = from.layout;
    barrier.dstStageMask = to.stage;
    barrier.dstAccessMask = to.access;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle;
    range.aspectMask = aspect_of(image.format);
    barrier.subresourceRange = range;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

// One barrier for each run of layers to which the same was done last.
void ready_layers(VkCommandBuffer commands, GpuImage& image, const Access& next, Layers layers, bool keeps) {
    const uint32_t end = layers.first + std::min(layers.count, image.layers - layers.first);
    for (uint32_t first = layers.first, after; first < end; first = after) {
        Access from = image.last[first];
        for (after = first; after < end && image.last[after] == from; ++after) image.last[after] = next;
        if (!keeps) from.layout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier(commands, image, from, next, {0, 0, image.levels, first, after - first});
    }
}

// A host buffer filled with `bytes`, for `use` alone.
Result<void> with_staging(const Device& device, std::span<const std::byte> bytes,
                          const std::function<Result<void>(VkBuffer)>& use) {
    Buffer staging{"staging"};
    Result<void> result =
        make_buffer(device, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::staging, staging);
    if (result) {
        std::memcpy(staging.mapped, bytes.data(), bytes.size());
        result = use(staging.handle);
    }
    destroy_buffer(device, staging);
    return result;
}

}  // namespace

Result<void> make_buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind,
                         Buffer& buffer) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = std::max<VkDeviceSize>(size, 256);
    info.usage = usage;
    FLANEUR_VK(vkCreateBuffer(device.handle, &info, nullptr, &buffer.handle), "make a buffer");
    buffer.size = info.size;
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle, buffer.handle, &needs);
    name_object(device, buffer.handle, buffer.name);
    FLANEUR_TRY(allocate(device, needs, kind, buffer.memory));
    name_object(device, buffer.memory, std::string("memory of ") + buffer.name);
    FLANEUR_VK(vkBindBufferMemory(device.handle, buffer.handle, buffer.memory, 0), "bind a buffer");
    if (kind != MemoryKind::device)
        FLANEUR_VK(vkMapMemory(device.handle, buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped),
                   "map a buffer");
    return {};
}

void destroy_buffer(const Device& device, Buffer& buffer) {
    if (buffer.handle) vkDestroyBuffer(device.handle, buffer.handle, nullptr);
    if (buffer.memory) vkFreeMemory(device.handle, buffer.memory, nullptr);
    buffer = {buffer.name};
}

Result<void> reserve_buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                            MemoryKind kind, Buffer& buffer) {
    if (buffer.memory && size <= buffer.size) return {};
    // Whole buffers are bound: they are not to grow beyond what the device takes at once.
    const VkDeviceSize most = device.properties.limits.maxStorageBufferRange;
    const VkDeviceSize grown = std::max(size, std::min(buffer.size + buffer.size / 2, most));
    destroy_buffer(device, buffer);
    Result<void> result = make_buffer(device, grown, usage, kind, buffer);
    if (!result) destroy_buffer(device, buffer);
    return result;
}

VkRenderingAttachmentInfo attachment(VkImageView view, VkAttachmentLoadOp load) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = view;
    info.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    info.loadOp = load;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

Result<void> run_once(const Device& device, const std::function<void(VkCommandBuffer)>& record) {
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.queueFamilyIndex = device.queue_family;
    VkCommandPool pool = {};
    FLANEUR_VK(vkCreateCommandPool(device.handle, &pool_info, nullptr, &pool), "make a command pool");
    name_object(device, pool, "once");
    auto run = [&]() -> Result<void> {
        VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        info.commandPool = pool;
        info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        info.commandBufferCount = 1;
        VkCommandBuffer commands = {};
        FLANEUR_VK(vkAllocateCommandBuffers(device.handle, &info, &commands), "make a command buffer");
        name_object(device, commands, "once");
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        FLANEUR_VK(vkBeginCommandBuffer(commands, &begin), "record commands");
        record(commands);
        FLANEUR_VK(vkEndCommandBuffer(commands), "record commands");
        VkCommandBufferSubmitInfo command_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
        command_info.commandBuffer = commands;
        VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
        submit.commandBufferInfoCount = 1;
        submit.pCommandBufferInfos = &command_info;
        FLANEUR_VK(vkQueueSubmit2(device.queue, 1, &submit, VK_NULL_HANDLE), "submit commands");
        FLANEUR_VK(vkQueueWaitIdle(device.queue), "finish commands");
        return {};
    };
    Result<void> result = run();
    vkDestroyCommandPool(device.handle, pool, nullptr);
    return result;
}

VkImageAspectFlags aspect_of(VkFormat format) {
    const bool depth = format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_D32_SFLOAT;
    return depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

namespace {

// Whether the host reads such an image where it lies. A CPU draws into any; GPUs that say they draw into rows
// lose themselves where there is depth beside them.
bool can_share(const Device& device, const ImageShape& shape) {
    if (device.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU ||
        aspect_of(shape.format) != VK_IMAGE_ASPECT_COLOR_BIT)
        return false;
    VkImageFormatProperties properties;
    return vkGetPhysicalDeviceImageFormatProperties(device.physical, shape.format, VK_IMAGE_TYPE_2D,
                                                    VK_IMAGE_TILING_LINEAR, shape.usage, 0,
                                                    &properties) == VK_SUCCESS &&
           properties.maxExtent.width >= shape.width && properties.maxExtent.height >= shape.height;
}

// Of the formats that the host reads.
uint32_t texel_bytes(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_D32_SFLOAT:
            return 4;
        default:
            return 8;
    }
}

}  // namespace

Result<void> make_image(const Device& device, const ImageShape& shape, GpuImage& image) {
    image.format = shape.format;
    image.width = shape.width;
    image.height = shape.height;
    image.layers = shape.layers;
    image.levels = shape.levels;
    image.last.assign(shape.layers, {});
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = {shape.width, shape.height, 1};
    info.mipLevels = shape.levels;
    info.arrayLayers = shape.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    const bool is_shared = shape.is_read_by_host && can_share(device, shape);
    const bool is_copied = shape.is_read_by_host && !is_shared;
    info.tiling = is_shared ? VK_IMAGE_TILING_LINEAR : VK_IMAGE_TILING_OPTIMAL;
    info.usage = shape.usage | (is_copied ? VK_IMAGE_USAGE_TRANSFER_SRC_BIT : 0);
    FLANEUR_VK(vkCreateImage(device.handle, &info, nullptr, &image.handle),
               "make an image of " + std::to_string(shape.width) + " x " + std::to_string(shape.height));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle, image.handle, &needs);
    name_object(device, image.handle, image.name);
    FLANEUR_TRY(allocate(device, needs, is_shared ? MemoryKind::readback : MemoryKind::device, image.memory));
    name_object(device, image.memory, std::string("memory of ") + image.name);
    FLANEUR_VK(vkBindImageMemory(device.handle, image.handle, image.memory, 0), "bind an image");
    if (is_shared) {
        void* mapped = nullptr;
        FLANEUR_VK(vkMapMemory(device.handle, image.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "map an image");
        const VkImageSubresource first{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0};
        VkSubresourceLayout layout;
        vkGetImageSubresourceLayout(device.handle, image.handle, &first, &layout);
        image.mapped = static_cast<const std::byte*>(mapped) + layout.offset;
        image.row_bytes = layout.rowPitch;
    }
    if (is_copied) {
        image.row_bytes = size_t{texel_bytes(shape.format)} * shape.width;
        image.copy.name = image.name;
        FLANEUR_TRY(make_buffer(device, VkDeviceSize{image.row_bytes} * shape.height,
                                VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, image.copy));
        image.mapped = image.copy.mapped;
    }
    constexpr VkImageUsageFlags viewed = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (!(shape.usage & viewed)) return {};
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image.handle;
    view.viewType = shape.is_array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    view.format = shape.format;
    view.subresourceRange = {aspect_of(shape.format), 0, shape.levels, 0, shape.layers};
    FLANEUR_VK(vkCreateImageView(device.handle, &view, nullptr, &image.view), "make an image view");
    name_object(device, image.view, image.name);
    return {};
}

VkBufferImageCopy whole_of(const GpuImage& image) {
    VkBufferImageCopy region{};
    region.imageSubresource = {aspect_of(image.format), 0, 0, 1};
    region.imageExtent = {image.width, image.height, 1};
    return region;
}

void wait_between(VkCommandBuffer commands, const Access& before, const Access& after) {
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = before.stage;
    barrier.srcAccessMask = before.access;
    barrier.dstStageMask = after.stage;
    barrier.dstAccessMask = after.access;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

void hand_to_host(VkCommandBuffer commands, GpuImage& image) {
    if (!image.copy.handle) return image_to(commands, image, k_read_by_host);
    image_to(commands, image, k_copied_from);
    const VkBufferImageCopy region = whole_of(image);
    vkCmdCopyImageToBuffer(commands, image.handle, k_copied_from.layout, image.copy.handle, 1, &region);
}

void destroy_image(const Device& device, GpuImage& image) {
    if (image.view) vkDestroyImageView(device.handle, image.view, nullptr);
    if (image.handle) vkDestroyImage(device.handle, image.handle, nullptr);
    if (image.memory) vkFreeMemory(device.handle, image.memory, nullptr);
    destroy_buffer(device, image.copy);
    image = {image.name};
}

void image_to(VkCommandBuffer commands, GpuImage& image, const Access& next, Layers layers) {
    ready_layers(commands, image, next, layers, true);
}

void image_freshly_to(VkCommandBuffer commands, GpuImage& image, const Access& next, Layers layers) {
    ready_layers(commands, image, next, layers, false);
}

void forget_image(GpuImage& image) {
    const Access anything = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                             VK_IMAGE_LAYOUT_UNDEFINED};
    std::fill(image.last.begin(), image.last.end(), anything);
}

void draw_indexed_indirect(const Device& device, VkCommandBuffer commands, VkBuffer draws, uint32_t first,
                           uint32_t count) {
    constexpr uint32_t size = sizeof(VkDrawIndexedIndirectCommand);
    const uint32_t most = device.draws_many ? std::max(device.properties.limits.maxDrawIndirectCount, 1u) : 1;
    for (uint32_t i = 0; i < count; i += most)
        vkCmdDrawIndexedIndirect(commands, draws, VkDeviceSize{size} * (first + i), std::min(most, count - i),
                                 size);
}

Result<void> upload_buffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                           Buffer& buffer) {
    FLANEUR_TRY(make_buffer(device, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                            MemoryKind::device, buffer));
    if (bytes.empty()) return {};
    return with_staging(device, bytes, [&](VkBuffer staging) {
        return run_once(device, [&](VkCommandBuffer commands) {
            const VkBufferCopy region{0, 0, bytes.size()};
            vkCmdCopyBuffer(commands, staging, buffer.handle, 1, &region);
            wait_between(commands, k_copied_to, k_read_by_device);
        });
    });
}

Result<void> upload_layers(const Device& device, std::span<const std::byte> texels, GpuImage& image) {
    return with_staging(device, texels, [&](VkBuffer staging) {
        return run_once(device, [&](VkCommandBuffer commands) {
            constexpr VkImageAspectFlags colour = VK_IMAGE_ASPECT_COLOR_BIT;
            image_freshly_to(commands, image, k_copied_to);
            VkBufferImageCopy region{};
            region.imageSubresource = {colour, 0, 0, image.layers};
            region.imageExtent = {image.width, image.height, 1};
            vkCmdCopyBufferToImage(commands, staging, image.handle, k_copied_to.layout, 1, &region);
            auto size_at = [](uint32_t size, uint32_t level) {
                return static_cast<int32_t>(std::max(1u, size >> level));
            };
            for (uint32_t level = 1; level < image.levels; ++level) {
                barrier(commands, image, k_copied_to, k_copied_from, {0, level - 1, 1, 0, image.layers});
                VkImageBlit blit{};
                blit.srcSubresource = {colour, level - 1, 0, image.layers};
                blit.srcOffsets[1] = {size_at(image.width, level - 1), size_at(image.height, level - 1), 1};
                blit.dstSubresource = {colour, level, 0, image.layers};
                blit.dstOffsets[1] = {size_at(image.width, level), size_at(image.height, level), 1};
                vkCmdBlitImage(commands, image.handle, k_copied_from.layout, image.handle, k_copied_to.layout,
                               1, &blit, VK_FILTER_LINEAR);
            }
            if (image.levels > 1)  // the last level is as it was copied to, like the image that remembers it
                barrier(commands, image, k_copied_from, k_copied_to,
                        {0, 0, image.levels - 1, 0, image.layers});
            image_to(commands, image, k_sampled);
        });
    });
}

}  // namespace flaneur
