// A Vulkan layer under which the first device is lost at the submit with the number LOST_AT, or at the first
// one after a buffer of LOST_INDICES bytes of indices, a city's, was made; it stays lost, as after a GPU's
// reset. Those that are made after it last.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace {

PFN_vkGetInstanceProcAddr next_instance;
PFN_vkGetDeviceProcAddr next_device;
VkInstance instance;
VkDevice opened;
std::atomic<int> submits = 0;
std::atomic<bool> is_due = false, is_lost = false;

template <class T>
T next(VkDevice device, const char* name) {
    return reinterpret_cast<T>(next_device(device, name));
}

// The loader's note on who comes next.
template <class T>
T* link_of(const void* chain, VkStructureType type) {
    auto* info = static_cast<T*>(const_cast<void*>(chain));
    while (info && !(info->sType == type && info->function == VK_LAYER_LINK_INFO))
        info = static_cast<T*>(const_cast<void*>(info->pNext));
    return info;
}

VkResult create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                         VkInstance* out) {
    auto* link =
        link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(next_instance(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, out);
    if (result == VK_SUCCESS) instance = *out;
    return result;
}

VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                       const VkAllocationCallbacks* allocator, VkDevice* out) {
    auto* link = link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr find = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    next_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(find(instance, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, out);
    if (result == VK_SUCCESS) opened = *out;
    return result;
}

long long number(const char* name) {
    const char* text = std::getenv(name);
    return text ? std::atoll(text) : 0;
}

VkResult create_buffer(VkDevice of, const VkBufferCreateInfo* info, const VkAllocationCallbacks* allocator,
                       VkBuffer* out) {
    const auto bytes = static_cast<VkDeviceSize>(number("LOST_INDICES"));
    const bool is_of_indices = (info->usage & VK_BUFFER_USAGE_INDEX_BUFFER_BIT) != 0;
    if (bytes > 0 && is_of_indices && info->size >= bytes) is_due = true;
    return next<PFN_vkCreateBuffer>(of, "vkCreateBuffer")(of, info, allocator, out);
}

VkResult submit(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
    if (++submits == number("LOST_AT") || is_due.exchange(false)) {
        is_lost = true;
        unsetenv("LOST_AT");  // the loader loads this anew for the next instance
        unsetenv("LOST_INDICES");
    }
    if (is_lost) return VK_ERROR_DEVICE_LOST;
    return next<PFN_vkQueueSubmit2>(opened, "vkQueueSubmit2")(queue, count, infos, fence);
}

VkResult wait(VkDevice of, uint32_t count, const VkFence* fences, VkBool32 all, uint64_t patience) {
    if (is_lost) return VK_ERROR_DEVICE_LOST;
    return next<PFN_vkWaitForFences>(of, "vkWaitForFences")(of, count, fences, all, patience);
}

VkResult wait_idle(VkDevice device) {
    const VkResult result = next<PFN_vkDeviceWaitIdle>(device, "vkDeviceWaitIdle")(device);
    return is_lost ? VK_ERROR_DEVICE_LOST : result;
}

template <class F>
PFN_vkVoidFunction as_void(F* function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction find_device(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return as_void(find_device);
    if (std::strcmp(name, "vkCreateBuffer") == 0) return as_void(create_buffer);
    if (std::strcmp(name, "vkQueueSubmit2") == 0) return as_void(submit);
    if (std::strcmp(name, "vkWaitForFences") == 0) return as_void(wait);
    if (std::strcmp(name, "vkDeviceWaitIdle") == 0) return as_void(wait_idle);
    return next_device(device, name);
}

PFN_vkVoidFunction find_instance(VkInstance of, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return as_void(find_instance);
    if (std::strcmp(name, "vkCreateInstance") == 0) return as_void(create_instance);
    if (std::strcmp(name, "vkCreateDevice") == 0) return as_void(create_device);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return as_void(find_device);
    return next_instance(of, name);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* version) {
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = find_instance;
    version->pfnGetDeviceProcAddr = find_device;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
