// Buffers and images as plain data with their own memory: there are a few dozen, so each has its own
// allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "renderer/device/device.h"

namespace flaneur {

struct Buffer {
    const char* name = "buffer";  // that debuggers show; kept when it is made anew
    VkBuffer handle = {};
    VkDeviceMemory memory = {};
    VkDeviceSize size = 0;
    void* mapped = nullptr;  // host-visible ones stay mapped and are coherent
};

// What is done to an image, and how it must lie for that.
struct Access {
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool operator==(const Access&) const = default;
};

inline constexpr VkPipelineStageFlags2 k_depth_stages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
inline constexpr Access k_depth_target = {
    k_depth_stages,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL};
inline constexpr Access k_colour_target = {
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL};
inline constexpr Access k_sampled = {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL};
inline constexpr Access k_read_by_device = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT,
                                            VK_IMAGE_LAYOUT_UNDEFINED};  // buffers
inline constexpr Access k_copied_from = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
inline constexpr Access k_read_by_host = {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT,
                                          VK_IMAGE_LAYOUT_GENERAL};
inline constexpr Access k_copied_to = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

struct GpuImage {
    const char* name = "image";  // as a buffer's
    VkImage handle = {};
    VkDeviceMemory memory = {};  // null: somebody else's
    VkImageView view = {};       // of all layers and levels
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint32_t width = 0, height = 0, layers = 1, levels = 1;
    const void* mapped = nullptr;   // what the host reads, where it does, once it was handed to it
    size_t row_bytes = 0;           // there, from row to row
    Buffer copy = {};               // where that is, if it is not the image itself
    std::vector<Access> last = {};  // what was done last to each layer, in the order of recording
};

enum class MemoryKind {
    device,    // fastest for the device
    upload,    // written by the host once a frame, read by the device
    staging,   // written by the host, copied by the device
    readback,  // written by the device, read by the host
};

Result<void> make_buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind,
                         Buffer& buffer);
void destroy_buffer(const Device& device, Buffer& buffer);

// Makes `buffer` anew if it is smaller than `size`, with room to grow. What it held is lost.
Result<void> reserve_buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                            MemoryKind kind, Buffer& buffer);

struct ImageShape {
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    uint32_t width = 1, height = 1, layers = 1, levels = 1;
    VkImageUsageFlags usage = 0;
    bool is_array = false;         // the view is of an array even for one layer
    bool is_read_by_host = false;  // the image itself, or a copy; see hand_to_host()
};
Result<void> make_image(const Device& device, const ImageShape& shape, GpuImage& image);
void destroy_image(const Device& device, GpuImage& image);
VkImageAspectFlags aspect_of(VkFormat format);

// All of an image's first level and layer, without gaps between rows.
VkBufferImageCopy whole_of(const GpuImage& image);
// Between what is done to buffers.
void wait_between(VkCommandBuffer commands, const Access& before, const Access& after);

struct Layers {
    uint32_t first = 0, count = VK_REMAINING_ARRAY_LAYERS;
};
// Readies an image for what is done to it next, after what was done to it last: image_to(commands, map,
// k_sampled). Freshly, what it held is thrown away.
void image_to(VkCommandBuffer commands, GpuImage& image, const Access& next, Layers layers = {});
void image_freshly_to(VkCommandBuffer commands, GpuImage& image, const Access& next, Layers layers = {});
// Of one that the host reads: after the commands, and a wait for k_copied_to before k_read_by_host, it finds
// it at `mapped`.
void hand_to_host(VkCommandBuffer commands, GpuImage& image);
// After commands that refer to an image were recorded and given up: it may be in any state, and holds
// nothing.
void forget_image(GpuImage& image);

// What is drawn into, as rendering begins with it; stored at its end.
VkRenderingAttachmentInfo attachment(VkImageView view, VkAttachmentLoadOp load);

// Runs a command buffer that `record` fills, to its end.
Result<void> run_once(const Device& device, const std::function<void(VkCommandBuffer)>& record);

// Draws that lie in a buffer one after the other as VkDrawIndexedIndirectCommand, in as few calls as the
// device takes.
void draw_indexed_indirect(const Device& device, VkCommandBuffer commands, VkBuffer draws, uint32_t first,
                           uint32_t count);

// Copies `bytes` into a new device buffer. An empty span makes a buffer of a few bytes.
Result<void> upload_buffer(const Device& device, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                           Buffer& buffer);

// Fills every layer of an image of colours or numbers with its level 0 (layers one after the other) and makes
// the coarser levels. Leaves it ready for sampling.
Result<void> upload_layers(const Device& device, std::span<const std::byte> texels, GpuImage& image);

}  // namespace flaneur
