#include "renderer/device/swapchain.h"

#include <algorithm>

#include "renderer/device/check.h"
#include "renderer/device/names.h"

namespace flaneur {
namespace {

void destroy_images(const Device& device, Swapchain& swapchain) {
    for (const GpuImage& image : swapchain.images)
        if (image.view) vkDestroyImageView(device.handle, image.view, nullptr);
    for (VkSemaphore semaphore : swapchain.drawn) vkDestroySemaphore(device.handle, semaphore, nullptr);
    swapchain.images.clear();
    swapchain.drawn.clear();
}

Result<void> make_images(const Device& device, Swapchain& swapchain) {
    uint32_t count = 0;
    FLANEUR_VK(vkGetSwapchainImagesKHR(device.handle, swapchain.handle, &count, nullptr),
               "list the window's images");
    std::vector<VkImage> handles(count);
    FLANEUR_VK(vkGetSwapchainImagesKHR(device.handle, swapchain.handle, &count, handles.data()),
               "list the window's images");
    for (VkImage handle : handles) {
        GpuImage& image = swapchain.images.emplace_back();
        image.handle = handle;
        image.format = swapchain.format;
        image.width = swapchain.extent.width, image.height = swapchain.extent.height;
        image.last.assign(1, {});
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = handle;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = swapchain.format;
        info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        FLANEUR_VK(vkCreateImageView(device.handle, &info, nullptr, &image.view), "make an image view");
        name_object(device, image.handle, image.name = "window image");
        name_object(device, image.view, image.name);
        VkSemaphoreCreateInfo semaphore_info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        VkSemaphore semaphore = {};
        FLANEUR_VK(vkCreateSemaphore(device.handle, &semaphore_info, nullptr, &semaphore),
                   "make a semaphore");
        name_object(device, semaphore, "window image is drawn");
        swapchain.drawn.push_back(semaphore);
    }
    return {};
}

}  // namespace

Result<void> choose_surface_format(const Device& device, Swapchain& swapchain) {
    uint32_t count = 0;
    FLANEUR_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, device.surface, &count, nullptr),
               "ask for the window's formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    FLANEUR_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, device.surface, &count, formats.data()),
               "ask for the window's formats");
    for (VkFormat wanted :
         {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_A8B8G8R8_UNORM_PACK32})
        for (const VkSurfaceFormatKHR& format : formats)
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                swapchain.format = format.format;
                swapchain.colour_space = format.colorSpace;
                return {};
            }
    return Error{
        "The window takes no picture of 8 bits a channel from this device: try another --device, or draw "
        "off-screen with `render`."};
}

bool can_copy_to_window(const Device& device) {
    VkSurfaceCapabilitiesKHR surface;
    return vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical, device.surface, &surface) ==
               VK_SUCCESS &&
           (surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT);
}

Result<void> make_swapchain(const Device& device, VkExtent2D wanted, Swapchain& swapchain) {
    destroy_images(device, swapchain);
    VkSurfaceCapabilitiesKHR surface;
    VkResult result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical, device.surface, &surface);
    if (result != VK_SUCCESS) {
        destroy_swapchain(device, swapchain);
        return vulkan_error(result, "ask for the window's size");
    }
    VkExtent2D extent = surface.currentExtent;
    if (extent.width == ~0u) {
        extent.width = std::clamp(wanted.width, surface.minImageExtent.width, surface.maxImageExtent.width);
        extent.height =
            std::clamp(wanted.height, surface.minImageExtent.height, surface.maxImageExtent.height);
    }
    if (extent.width == 0 || extent.height == 0 || wanted.width == 0 || wanted.height == 0) {
        destroy_swapchain(device, swapchain);
        return {};
    }
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = device.surface;
    info.minImageCount = surface.minImageCount + 1;
    if (surface.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, surface.maxImageCount);
    info.imageFormat = swapchain.format;
    info.imageColorSpace = swapchain.colour_space;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    swapchain.takes_copies = (surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) != 0;
    info.imageUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | (surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const uint32_t families[] = {device.queue_family, device.present_family};
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    if (device.present_family != device.queue_family) {
        info.imageSharingMode = VK_SHARING_MODE_CONCURRENT;
        info.queueFamilyIndexCount = 2;
        info.pQueueFamilyIndices = families;
    }
    info.preTransform = surface.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    for (const VkCompositeAlphaFlagBitsKHR alpha :
         {VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR, VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR,
          VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR, VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR})  // pictures are opaque
        if (surface.supportedCompositeAlpha & alpha) info.compositeAlpha = alpha;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain.handle;
    VkSwapchainKHR handle = {};
    result = vkCreateSwapchainKHR(device.handle, &info, nullptr, &handle);
    if (swapchain.handle) vkDestroySwapchainKHR(device.handle, swapchain.handle, nullptr);
    swapchain.handle = handle;
    if (result != VK_SUCCESS) {
        swapchain.handle = {};
        return vulkan_error(result, "make the window's images");
    }
    name_object(device, handle, "window");
    swapchain.extent = extent;
    return make_images(device, swapchain);
}

void destroy_swapchain(const Device& device, Swapchain& swapchain) {
    destroy_images(device, swapchain);
    if (swapchain.handle) vkDestroySwapchainKHR(device.handle, swapchain.handle, nullptr);
    swapchain.handle = {};
    swapchain.extent = {};
}

}  // namespace flaneur
