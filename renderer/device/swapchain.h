// The window's images.
#pragma once

#include <vector>

#include "renderer/device/resources.h"

namespace flaneur {

struct Swapchain {
    VkSwapchainKHR handle = {};
    VkFormat format = VK_FORMAT_UNDEFINED;  // 8 bits a channel, written with display-ready sRGB
    VkColorSpaceKHR colour_space = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    VkExtent2D extent = {};
    std::vector<GpuImage> images;
    bool takes_copies = false;       // pictures may be copied into them, rather than only drawn
    std::vector<VkSemaphore> drawn;  // one an image: the picture may be presented
};

// Sets the format. Refuses where the surface takes none that fits.
Result<void> choose_surface_format(const Device& device, Swapchain& swapchain);

// Whether pictures may be copied into the surface's images, rather than only drawn.
bool can_copy_to_window(const Device& device);

// Makes the swapchain (anew) for the surface's size, or `wanted` where the surface leaves it open. A window
// without area gets none: `handle` is null then. The device must be idle.
Result<void> make_swapchain(const Device& device, VkExtent2D wanted, Swapchain& swapchain);
void destroy_swapchain(const Device& device, Swapchain& swapchain);

}  // namespace flaneur
