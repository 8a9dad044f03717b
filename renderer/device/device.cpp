#define VOLK_IMPLEMENTATION
#include "renderer/device/device.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>

#include "renderer/device/capture.h"
#include "renderer/device/check.h"
#include "renderer/device/names.h"

namespace flaneur {
namespace {

constexpr const char* k_validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_debug_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                VkDebugUtilsMessageTypeFlagsEXT,
                                                const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                void* user) {
    auto& device = *static_cast<Device*>(user);
    ++device.messages;
    if (device.on_message)
        device.on_message(data->pMessage);
    else
        std::fprintf(stderr, "%s\n", data->pMessage);
    return VK_FALSE;
}

bool has_layer(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool has_instance_extension(const char* layer, const char* name) {
    uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

bool has_device_extension(VkPhysicalDevice physical, const char* name) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

Result<void> make_instance(Device& device, const RendererOptions& options, GLFWwindow* window) {
    const bool validation = options.validation;
    // Where somebody has found Vulkan already (volkInitializeCustom), theirs is taken.
    if (volkGetInstanceVersion() == 0 && volkInitialize() != VK_SUCCESS)
        return Error{
            "There is no Vulkan on this machine (libvulkan.so.1 was not found): install libvulkan1 and a "
            "driver, for instance mesa-vulkan-drivers."};
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
        return Error{"The Vulkan loader is older than 1.3: install a newer libvulkan1."};

    std::vector<const char*> extensions, layers;
    if (window) {
        uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        if (!names)
            return Error{
                "No Vulkan driver here can draw into a window: install mesa-vulkan-drivers or your GPU's "
                "driver, or draw off-screen with `render`."};
        extensions.assign(names, names + count);
    } else if (has_instance_extension(nullptr, VK_KHR_SURFACE_EXTENSION_NAME)) {
        // volk's function pointers are one set for all instances: what one has, all must have.
        extensions.push_back(VK_KHR_SURFACE_EXTENSION_NAME);
    }
    if (validation) {
        if (!has_layer(k_validation_layer))
            return Error{
                "Validation was asked for, but VK_LAYER_KHRONOS_validation is not installed: install "
                "vulkan-validationlayers."};
        layers.push_back(k_validation_layer);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    if (validation && (options.captures || has_renderdoc()))
        return Error{
            "RenderDoc and the validation layer are not loaded together: capture without --validate."};
    const bool loads_renderdoc = options.captures && !has_renderdoc_started_us();
    if (loads_renderdoc) {
        if (!has_layer(k_capture_layer)) return no_renderdoc();
        layers.push_back(k_capture_layer);
    }
    // Which RenderDoc refuses.
    const bool has_portability =
        !loads_renderdoc && has_instance_extension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (has_portability) extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    device.has_labels = has_instance_extension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (device.has_labels || validation) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_debug_message;
    messenger.pUserData = &device;
    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &messenger};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "flaneur";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    if (has_portability) info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    info.pNext = validation ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    FLANEUR_VK(vkCreateInstance(&info, nullptr, &device.instance), "start");
    volkLoadInstance(device.instance);
    if (options.captures && !has_renderdoc()) return no_renderdoc();
    if (loads_renderdoc) quieten_renderdoc();
    if (validation)
        FLANEUR_VK(vkCreateDebugUtilsMessengerEXT(device.instance, &messenger, nullptr, &device.messenger),
                   "listen to the validation layer");
    return window ? make_surface(device, window) : Result<void>();
}

// The family that draws and the one that presents, one and the same if that is possible; ~0u: none.
struct Families {
    uint32_t draws = ~0u, presents = ~0u;
    uint32_t timestamp_bits = 0;
};
Families find_families(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    Families found;
    for (uint32_t i = 0; i < count; ++i) {
        const bool draws = families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT;
        VkBool32 presents = !surface;
        if (surface && vkGetPhysicalDeviceSurfaceSupportKHR(physical, i, surface, &presents) != VK_SUCCESS)
            presents = VK_FALSE;
        if (draws && (found.draws == ~0u || (presents && found.draws != found.presents))) {
            found.draws = i;
            found.timestamp_bits = families[i].timestampValidBits;
            if (presents) found.presents = i;
        }
        if (presents && found.presents == ~0u) found.presents = i;
    }
    return found;
}

// What the device lacks, or nothing.
std::string missing_from(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    // RenderDoc says 1.2 of drivers that cannot replay addresses of buffers, such as lavapipe, and
    // captures 1.3.
    const bool tells_version = !has_renderdoc() || properties.apiVersion < VK_API_VERSION_1_2;
    if (tells_version && properties.apiVersion < VK_API_VERSION_1_3) return "Vulkan 1.3";
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features13};
    vkGetPhysicalDeviceFeatures2(physical, &features);
    if (!features13.dynamicRendering) return "dynamic rendering";
    if (!features13.synchronization2) return "synchronization2";
    if (!features.features.drawIndirectFirstInstance) return "a first instance in indirect draws";
    if (!features.features.independentBlend) return "blending that differs between attachments";
    VkFormatProperties depth;
    vkGetPhysicalDeviceFormatProperties(physical, VK_FORMAT_D32_SFLOAT, &depth);
    if (!(depth.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT))
        return "depths of 32 bits";
    const Families families = find_families(physical, surface);
    if (families.draws == ~0u) return "a queue that draws";
    if (families.presents == ~0u) return "a queue that draws into this window";
    if (surface && !has_device_extension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) return "swapchains";
    return {};
}

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

int speed_rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 3;
        default:
            return 4;
    }
}

// Whether the device tells what its clock and CLOCK_MONOTONIC show at one moment.
bool has_host_clock(VkPhysicalDevice physical) {
    if (!has_device_extension(physical, VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME)) return false;
    VkTimeDomainEXT domains[16];
    uint32_t count = std::size(domains);
    vkGetPhysicalDeviceCalibrateableTimeDomainsEXT(physical, &count, domains);
    auto has = [&](VkTimeDomainEXT domain) {
        return std::find(domains, domains + count, domain) != domains + count;
    };
    return has(VK_TIME_DOMAIN_DEVICE_EXT) && has(VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT);
}

Result<void> make_logical_device(Device& device) {
    const float priority = 1;
    std::vector<VkDeviceQueueCreateInfo> queues;
    for (const uint32_t family : {device.queue_family, device.present_family}) {
        if (!queues.empty() && family == device.queue_family) continue;
        VkDeviceQueueCreateInfo& queue = queues.emplace_back();
        queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue.queueFamilyIndex = family;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
    }
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    features13.dynamicRendering = VK_TRUE;
    features13.synchronization2 = VK_TRUE;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features13};
    features.features.drawIndirectFirstInstance = VK_TRUE;
    features.features.independentBlend = VK_TRUE;
    VkPhysicalDeviceFeatures offered;
    vkGetPhysicalDeviceFeatures(device.physical, &offered);
    features.features.fillModeNonSolid = offered.fillModeNonSolid;
    device.has_wireframe = offered.fillModeNonSolid;
    features.features.pipelineStatisticsQuery = offered.pipelineStatisticsQuery;
    device.has_counters = offered.pipelineStatisticsQuery == VK_TRUE;
    features.features.multiDrawIndirect = offered.multiDrawIndirect;
    device.draws_many = offered.multiDrawIndirect == VK_TRUE;
    features.features.depthClamp = offered.depthClamp;
    device.clamps_depth = offered.depthClamp == VK_TRUE;
    std::vector<const char*> extensions;
    if (device.surface) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    // A device that is not wholly Vulkan says so, and wants to hear that it was heard.
    constexpr const char* k_portability = "VK_KHR_portability_subset";
    if (has_device_extension(device.physical, k_portability)) extensions.push_back(k_portability);
    device.has_clocks = has_host_clock(device.physical);
    if (device.has_clocks) extensions.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
    info.queueCreateInfoCount = static_cast<uint32_t>(queues.size());
    info.pQueueCreateInfos = queues.data();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    FLANEUR_VK(vkCreateDevice(device.physical, &info, nullptr, &device.handle),
               std::string("open the device ") + device.properties.deviceName);
    vkGetDeviceQueue(device.handle, device.queue_family, 0, &device.queue);
    vkGetDeviceQueue(device.handle, device.present_family, 0, &device.present_queue);
    name_object(device, device.handle, device.properties.deviceName);
    if (device.present_queue != device.queue) name_object(device, device.present_queue, "present");
    name_object(device, device.queue, "draw");
    return {};
}

}  // namespace

Result<size_t> choose_device(const std::vector<DeviceChoice>& devices, const std::string& wanted) {
    if (devices.empty())
        return Error{
            "No Vulkan driver was found: install mesa-vulkan-drivers (lavapipe draws on the CPU) or your "
            "GPU's "
            "driver."};
    std::string list;
    for (size_t i = 0; i < devices.size(); ++i) {
        list += (i ? "; " : "") + std::to_string(i) + ": " + devices[i].name;
        if (!devices[i].missing.empty()) list += " (lacks " + devices[i].missing + ")";
    }
    size_t best = devices.size();
    const bool is_number =
        !wanted.empty() && wanted.size() < 6 &&
        std::all_of(wanted.begin(), wanted.end(), [](char c) { return c >= '0' && c <= '9'; });
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceChoice& device = devices[i];
        if (is_number ? std::stoul(wanted) != i
                      : lower_case(device.name).find(lower_case(wanted)) == std::string::npos)
            continue;
        if (!device.missing.empty()) continue;
        if (best == devices.size() ||
            (wanted.empty() && speed_rank(device.type) < speed_rank(devices[best].type)))
            best = i;
    }
    if (best < devices.size()) return best;
    return Error{
        (wanted.empty() ? "No Vulkan device fits" : "No fitting Vulkan device matches \"" + wanted + "\"") +
        " (there is " + list + "): choose another with --device, or install mesa-vulkan-drivers."};
}

Result<void> make_surface(Device& device, GLFWwindow* window) {
    FLANEUR_VK(glfwCreateWindowSurface(device.instance, window, nullptr, &device.surface),
               "make a surface for the window");
    return {};
}

Result<void> make_device(Device& device, const RendererOptions& options, GLFWwindow* window) {
    device.on_message = options.on_message;
    FLANEUR_TRY(make_instance(device, options, window));
    uint32_t count = 0;
    if (VkResult result = vkEnumeratePhysicalDevices(device.instance, &count, nullptr);
        result != VK_SUCCESS && result != VK_ERROR_INITIALIZATION_FAILED)
        return vulkan_error(result, "list the devices");
    std::vector<VkPhysicalDevice> physicals(count);
    if (count > 0)
        FLANEUR_VK(vkEnumeratePhysicalDevices(device.instance, &count, physicals.data()), "list the devices");
    std::vector<DeviceChoice> choices;
    for (VkPhysicalDevice physical : physicals) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(physical, &properties);
        choices.push_back(
            {properties.deviceName, properties.deviceType, missing_from(physical, device.surface)});
    }
    Result<size_t> chosen = choose_device(choices, options.device);
    if (!chosen) return chosen.error();
    device.physical = physicals[*chosen];
    vkGetPhysicalDeviceProperties(device.physical, &device.properties);
    vkGetPhysicalDeviceMemoryProperties(device.physical, &device.memory);
    const Families families = find_families(device.physical, device.surface);
    device.queue_family = families.draws, device.present_family = families.presents;
    if (families.timestamp_bits > 0)
        device.timestamp_mask = ~uint64_t{0} >> (64 - std::min(families.timestamp_bits, 64u));
    return make_logical_device(device);
}

void destroy_device(Device& device) {
    if (device.handle) vkDestroyDevice(device.handle, nullptr);
    if (device.surface) vkDestroySurfaceKHR(device.instance, device.surface, nullptr);
    if (device.messenger) vkDestroyDebugUtilsMessengerEXT(device.instance, device.messenger, nullptr);
    if (device.instance) vkDestroyInstance(device.instance, nullptr);
    device.handle = {};
    device.surface = {};
    device.messenger = {};
    device.instance = {};
}

}  // namespace flaneur
