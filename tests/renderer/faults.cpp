#include "tests/renderer/faults.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace flaneur {
namespace {

constexpr VkResult k_codes[] = {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                                VK_ERROR_DEVICE_LOST};

Faults state;
PFN_vkGetInstanceProcAddr find_real = nullptr;

// Whether the work is done nevertheless: an image that was acquired or presented is gone, and who waits in
// vain must not destroy what is in use.
bool is_done_first(const std::string& name) {
    return name == "vkQueueWaitIdle" || name == "vkDeviceWaitIdle" || name == "vkWaitForFences" ||
           name == "vkQueuePresentKHR";
}

bool fails(const char* name) {
    if (!state.only.empty() && state.only != name) return false;
    if (++state.calls != state.fail_at) return false;
    state.failed = name;
    return true;
}

// What a call made, if it makes anything.
void count(std::string_view name) {
    if (name.ends_with("Pipelines"))
        ++state.live["Pipeline"];  // one at a time
    else if (name.starts_with("vkCreate"))
        ++state.live[std::string(name.substr(std::strlen("vkCreate")))];
    else if (name == "vkAllocateMemory")
        ++state.live["Memory"];
}

// Every hooked function has a type of its own, which is why one hook a type will do.
template <class F>
struct Hook;
template <class... A>
struct Hook<VkResult(VKAPI_PTR*)(A...)> {
    static inline VkResult(VKAPI_PTR* real)(A...) = nullptr;
    static inline const char* name = nullptr;
    static VKAPI_ATTR VkResult VKAPI_CALL call(A... arguments) {
        const bool is_failed = fails(name);
        if (is_failed && !is_done_first(name)) return state.code;
        const VkResult result = real(arguments...);
        if (is_failed) return state.code;
        if (result == VK_SUCCESS) count(name);
        return result;
    }
};
template <class T>
struct Hook<void(VKAPI_PTR*)(VkDevice, T, const VkAllocationCallbacks*)> {
    static inline void(VKAPI_PTR* real)(VkDevice, T, const VkAllocationCallbacks*) = nullptr;
    static inline const char* name = nullptr;
    static VKAPI_ATTR void VKAPI_CALL call(VkDevice device, T object,
                                           const VkAllocationCallbacks* allocator) {
        if (object)
            --state.live[name + std::strlen(std::strcmp(name, "vkFreeMemory") == 0 ? "vkFree" : "vkDestroy")];
        state.names.erase(reinterpret_cast<uint64_t>(object));
        real(device, object, allocator);
    }
};
template <class T>
struct Hook<void(VKAPI_PTR*)(T, const VkAllocationCallbacks*)> {
    static inline void(VKAPI_PTR* real)(T, const VkAllocationCallbacks*) = nullptr;
    static inline const char* name = nullptr;
    static VKAPI_ATTR void VKAPI_CALL call(T object, const VkAllocationCallbacks* allocator) {
        --state.live[name + std::strlen("vkDestroy")];
        state.names.erase(reinterpret_cast<uint64_t>(object));
        real(object, allocator);
    }
};

template <class F>
PFN_vkVoidFunction hook(const char* name, PFN_vkVoidFunction real) {
    Hook<F>::name = name;
    Hook<F>::real = reinterpret_cast<F>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&Hook<F>::call);
}

// Functions that only tell, and what a poor device says instead.
Poverty poor;

PFN_vkGetPhysicalDeviceMemoryProperties real_memory;
VKAPI_ATTR void VKAPI_CALL tell_memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* out) {
    real_memory(device, out);
    if (!poor.has_own_memory) return;
    constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                           VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                                           VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    out->memoryTypeCount = poor.shared > 0 ? 3 : 2;
    out->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    out->memoryTypes[1] = {host, 0};
    out->memoryTypes[2] = {host | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
}
PFN_vkGetBufferMemoryRequirements real_buffer_needs;
VKAPI_ATTR void VKAPI_CALL tell_buffer_needs(VkDevice device, VkBuffer buffer, VkMemoryRequirements* out) {
    real_buffer_needs(device, buffer, out);
    if (poor.has_own_memory) out->memoryTypeBits = 7;
}
PFN_vkGetImageMemoryRequirements real_image_needs;
VKAPI_ATTR void VKAPI_CALL tell_image_needs(VkDevice device, VkImage image, VkMemoryRequirements* out) {
    real_image_needs(device, image, out);
    if (poor.has_own_memory) out->memoryTypeBits = 7;
}
PFN_vkAllocateMemory real_allocate;  // which may itself be a hook
VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* allocator, VkDeviceMemory* out) {
    VkMemoryAllocateInfo asked = *info;
    if (poor.has_own_memory) {
        if (info->memoryTypeIndex == 2 && info->allocationSize > poor.shared)
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        asked.memoryTypeIndex = 0;
    }
    return real_allocate(device, &asked, allocator, out);
}
PFN_vkGetPhysicalDeviceQueueFamilyProperties real_families;
VKAPI_ATTR void VKAPI_CALL tell_families(VkPhysicalDevice device, uint32_t* count,
                                         VkQueueFamilyProperties* out) {
    uint32_t real_count = 1;
    real_families(device, &real_count, out);
    *count = poor.presents_elsewhere ? 2 : 1;
    if (!out) return;
    out[0].timestampValidBits = poor.timestamp_bits;
    if (poor.presents_elsewhere) out[1] = {VK_QUEUE_TRANSFER_BIT, 1, 0, {1, 1, 1}};
}
PFN_vkGetPhysicalDeviceSurfaceSupportKHR real_support;
VKAPI_ATTR VkResult VKAPI_CALL tell_support(VkPhysicalDevice device, uint32_t family, VkSurfaceKHR surface,
                                            VkBool32* out) {
    const VkResult result = real_support(device, 0, surface, out);
    if (poor.presents_elsewhere && family == 0) *out = VK_FALSE;
    return result;
}
PFN_vkGetDeviceQueue real_queue;
VKAPI_ATTR void VKAPI_CALL get_queue(VkDevice device, uint32_t, uint32_t index, VkQueue* out) {
    real_queue(device, 0, index, out);
}
PFN_vkCreateDevice real_create;
VKAPI_ATTR VkResult VKAPI_CALL create(VkPhysicalDevice device, const VkDeviceCreateInfo* info,
                                      const VkAllocationCallbacks* allocator, VkDevice* out) {
    VkDeviceCreateInfo asked = *info;
    asked.queueCreateInfoCount = 1;  // there is but one family
    return real_create(device, &asked, allocator, out);
}
PFN_vkGetPhysicalDeviceFeatures real_features;
VKAPI_ATTR void VKAPI_CALL tell_features(VkPhysicalDevice device, VkPhysicalDeviceFeatures* out) {
    real_features(device, out);
    if (!poor.lacks_options) return;
    for (VkBool32 VkPhysicalDeviceFeatures::*lacks :
         {&VkPhysicalDeviceFeatures::multiDrawIndirect, &VkPhysicalDeviceFeatures::depthClamp,
          &VkPhysicalDeviceFeatures::fillModeNonSolid, &VkPhysicalDeviceFeatures::pipelineStatisticsQuery})
        out->*lacks = VK_FALSE;
}
PFN_vkGetPhysicalDeviceProperties real_properties;
VKAPI_ATTR void VKAPI_CALL tell_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* out) {
    real_properties(device, out);
    if (!poor.lacks_options) return;
    out->limits.maxDrawIndirectCount = 1;
    out->limits.maxImageDimension2D = 4096;
    out->limits.maxImageArrayLayers = 256;
    out->limits.maxStorageBufferRange = 1 << 27;
}
PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR real_surface;
VKAPI_ATTR VkResult VKAPI_CALL tell_surface(VkPhysicalDevice device, VkSurfaceKHR surface,
                                            VkSurfaceCapabilitiesKHR* out) {
    const VkResult result = real_surface(device, surface, out);
    if (poor.is_never_opaque) out->supportedCompositeAlpha = VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR;
    return result;
}
PFN_vkCreateSwapchainKHR real_swapchain;
VKAPI_ATTR VkResult VKAPI_CALL create_swapchain(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                                const VkAllocationCallbacks* allocator, VkSwapchainKHR* out) {
    VkSwapchainCreateInfoKHR asked = *info;
    if (poor.is_never_opaque) {
        EXPECT_EQ(info->compositeAlpha, VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR);
        asked.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    }
    if (poor.presents_elsewhere) {
        EXPECT_EQ(info->imageSharingMode, VK_SHARING_MODE_CONCURRENT);
        asked.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
        asked.queueFamilyIndexCount = 0;
    }
    return real_swapchain(device, &asked, allocator, out);
}

PFN_vkGetPhysicalDeviceImageFormatProperties real_formats;
VKAPI_ATTR VkResult VKAPI_CALL tell_formats(VkPhysicalDevice device, VkFormat format, VkImageType type,
                                            VkImageTiling tiling, VkImageUsageFlags usage,
                                            VkImageCreateFlags flags, VkImageFormatProperties* out) {
    if (poor.draws_no_rows && tiling == VK_IMAGE_TILING_LINEAR) return VK_ERROR_FORMAT_NOT_SUPPORTED;
    return real_formats(device, format, type, tiling, usage, flags, out);
}

// Of what is never destroyed by itself nothing is counted: queues, sets of bindings, command buffers.
PFN_vkSetDebugUtilsObjectNameEXT real_name;
VKAPI_ATTR VkResult VKAPI_CALL set_name(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
    const VkObjectType type = info->objectType;
    EXPECT_TRUE(info->pObjectName && *info->pObjectName);
    if (type != VK_OBJECT_TYPE_QUEUE && type != VK_OBJECT_TYPE_DESCRIPTOR_SET &&
        type != VK_OBJECT_TYPE_COMMAND_BUFFER)
        state.names[info->objectHandle] = info->pObjectName;
    return real_name(device, info);
}

struct Teller {
    const char* name;
    PFN_vkVoidFunction told;
    PFN_vkVoidFunction* real;
};
template <class F>
Teller teller(const char* name, F told, F& real) {
    return {name, reinterpret_cast<PFN_vkVoidFunction>(told), reinterpret_cast<PFN_vkVoidFunction*>(&real)};
}
const Teller k_tellers[] = {
    teller("vkGetPhysicalDeviceMemoryProperties", tell_memory, real_memory),
    teller("vkGetBufferMemoryRequirements", tell_buffer_needs, real_buffer_needs),
    teller("vkGetImageMemoryRequirements", tell_image_needs, real_image_needs),
    teller("vkAllocateMemory", allocate, real_allocate),
    teller("vkGetPhysicalDeviceQueueFamilyProperties", tell_families, real_families),
    teller("vkGetPhysicalDeviceSurfaceSupportKHR", tell_support, real_support),
    teller("vkGetDeviceQueue", get_queue, real_queue),
    teller("vkCreateDevice", create, real_create),
    teller("vkGetPhysicalDeviceFeatures", tell_features, real_features),
    teller("vkGetPhysicalDeviceImageFormatProperties", tell_formats, real_formats),
    teller("vkGetPhysicalDeviceProperties", tell_properties, real_properties),
    teller("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", tell_surface, real_surface),
    teller("vkCreateSwapchainKHR", create_swapchain, real_swapchain),
    teller("vkSetDebugUtilsObjectNameEXT", set_name, real_name),
};

struct Entry {
    const char* name;
    PFN_vkVoidFunction (*hook)(const char* name, PFN_vkVoidFunction real);
};

const Entry k_entries[] = {
    {"vkCreateInstance", hook<PFN_vkCreateInstance>},
    {"vkDestroyInstance", hook<PFN_vkDestroyInstance>},
    {"vkEnumeratePhysicalDevices", hook<PFN_vkEnumeratePhysicalDevices>},
    {"vkCreateDevice", hook<PFN_vkCreateDevice>},
    {"vkDestroyDevice", hook<PFN_vkDestroyDevice>},
    {"vkCreateBuffer", hook<PFN_vkCreateBuffer>},
    {"vkDestroyBuffer", hook<PFN_vkDestroyBuffer>},
    {"vkCreateImage", hook<PFN_vkCreateImage>},
    {"vkDestroyImage", hook<PFN_vkDestroyImage>},
    {"vkCreateImageView", hook<PFN_vkCreateImageView>},
    {"vkDestroyImageView", hook<PFN_vkDestroyImageView>},
    {"vkAllocateMemory", hook<PFN_vkAllocateMemory>},
    {"vkFreeMemory", hook<PFN_vkFreeMemory>},
    {"vkBindBufferMemory", hook<PFN_vkBindBufferMemory>},
    {"vkBindImageMemory", hook<PFN_vkBindImageMemory>},
    {"vkMapMemory", hook<PFN_vkMapMemory>},
    {"vkCreateShaderModule", hook<PFN_vkCreateShaderModule>},
    {"vkDestroyShaderModule", hook<PFN_vkDestroyShaderModule>},
    {"vkCreateGraphicsPipelines", hook<PFN_vkCreateGraphicsPipelines>},
    {"vkDestroyPipeline", hook<PFN_vkDestroyPipeline>},
    {"vkCreatePipelineLayout", hook<PFN_vkCreatePipelineLayout>},
    {"vkDestroyPipelineLayout", hook<PFN_vkDestroyPipelineLayout>},
    {"vkCreateDescriptorSetLayout", hook<PFN_vkCreateDescriptorSetLayout>},
    {"vkDestroyDescriptorSetLayout", hook<PFN_vkDestroyDescriptorSetLayout>},
    {"vkCreateDescriptorPool", hook<PFN_vkCreateDescriptorPool>},
    {"vkDestroyDescriptorPool", hook<PFN_vkDestroyDescriptorPool>},
    {"vkAllocateDescriptorSets", hook<PFN_vkAllocateDescriptorSets>},
    {"vkCreateSampler", hook<PFN_vkCreateSampler>},
    {"vkDestroySampler", hook<PFN_vkDestroySampler>},
    {"vkCreateCommandPool", hook<PFN_vkCreateCommandPool>},
    {"vkDestroyCommandPool", hook<PFN_vkDestroyCommandPool>},
    {"vkResetCommandPool", hook<PFN_vkResetCommandPool>},
    {"vkAllocateCommandBuffers", hook<PFN_vkAllocateCommandBuffers>},
    {"vkBeginCommandBuffer", hook<PFN_vkBeginCommandBuffer>},
    {"vkEndCommandBuffer", hook<PFN_vkEndCommandBuffer>},
    {"vkCreateFence", hook<PFN_vkCreateFence>},
    {"vkDestroyFence", hook<PFN_vkDestroyFence>},
    {"vkResetFences", hook<PFN_vkResetFences>},
    {"vkWaitForFences", hook<PFN_vkWaitForFences>},
    {"vkCreateSemaphore", hook<PFN_vkCreateSemaphore>},
    {"vkDestroySemaphore", hook<PFN_vkDestroySemaphore>},
    {"vkCreateQueryPool", hook<PFN_vkCreateQueryPool>},
    {"vkDestroyQueryPool", hook<PFN_vkDestroyQueryPool>},
    {"vkGetQueryPoolResults", hook<PFN_vkGetQueryPoolResults>},
    {"vkQueueSubmit2", hook<PFN_vkQueueSubmit2>},
    {"vkQueueWaitIdle", hook<PFN_vkQueueWaitIdle>},
    {"vkDeviceWaitIdle", hook<PFN_vkDeviceWaitIdle>},
    {"vkCreateSwapchainKHR", hook<PFN_vkCreateSwapchainKHR>},
    {"vkDestroySwapchainKHR", hook<PFN_vkDestroySwapchainKHR>},
    {"vkGetSwapchainImagesKHR", hook<PFN_vkGetSwapchainImagesKHR>},
    {"vkAcquireNextImageKHR", hook<PFN_vkAcquireNextImageKHR>},
    {"vkQueuePresentKHR", hook<PFN_vkQueuePresentKHR>},
};

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL find(VkInstance instance, const char* name) {
    PFN_vkVoidFunction real = find_real(instance, name);
    for (const Teller& teller : k_tellers)
        if (real && std::strcmp(name, teller.name) == 0) *teller.real = std::exchange(real, teller.told);
    for (const Entry& entry : k_entries)
        if (real && std::strcmp(name, entry.name) == 0) return entry.hook(entry.name, real);
    return real;
}

}  // namespace

Faults& faults() {
    if (find_real) return state;
    if (!vkGetInstanceProcAddr && volkInitialize() != VK_SUCCESS) return state;
    find_real = vkGetInstanceProcAddr;
    volkInitializeCustom(find);
    return state;
}

Poverty& poverty() {
    faults();
    return poor;
}

void fail_at(int number, VkResult code, const std::string& only) {
    Faults& f = faults();
    f.calls = 0;
    f.fail_at = number;
    f.code = code;
    f.only = only;
    f.failed.clear();
}

int fail_everywhere(const std::function<Result<void>()>& attempt, const std::function<void()>& after) {
    for (int number = 1;; ++number) {
        fail_at(number, k_codes[number % 3]);
        const Result<void> done = attempt();
        const std::string failed = faults().failed;
        fail_at(0, VK_SUCCESS);
        if (failed.empty()) {
            EXPECT_TRUE(done) << done.error().message;
            return number - 1;
        }
        EXPECT_FALSE(done) << failed << ", call " << number << ", failed unnoticed";
        if (!done) {
            EXPECT_TRUE(done.error().message.ends_with('.')) << done.error().message;
            EXPECT_NE(done.error().message.find(' '), std::string::npos);
        }
        after();
        if (testing::Test::HasFailure()) {
            ADD_FAILURE() << "after " << failed << ", call " << number;
            return number;
        }
    }
}

}  // namespace flaneur
