#define VOLK_IMPLEMENTATION
#include "tools/rendercheck/references/device.h"

#include <volk.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "assets/files/words.h"
#include "tools/rendercheck/files/disk.h"
#include "tools/rendercheck/files/scratch.h"
#include "tools/rendercheck/process/process.h"

namespace flaneur {
namespace {

std::string in_small_letters(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// Words with dashes between.
std::string slug(const std::string& text) {
    std::string out;
    for (const char c : in_small_letters(text)) {
        const bool stays = std::isalnum(static_cast<unsigned char>(c)) || c == '.';
        if (stays)
            out += c;
        else if (!out.empty() && out.back() != '-')
            out += '-';
    }
    while (!out.empty() && (out.back() == '-' || out.back() == '.')) out.pop_back();
    return out;
}

bool contains(const std::string& text, const std::string& word) {
    return in_small_letters(text).find(in_small_letters(word)) != std::string::npos;
}

}  // namespace

std::string driver_key(const std::string& device, const std::string& info) {
    std::string name = device.substr(0, device.find(" ("));
    // Debian's and other builds' suffixes tell one Mesa from another no better than its version.
    std::string key = slug(name + " " + info).substr(0, 90);
    while (!key.empty() && !std::isalnum(static_cast<unsigned char>(key.front()))) key.erase(0, 1);
    return key.empty() ? "unknown" : key;
}

Result<std::vector<VulkanDriver>> list_drivers() {
    if (volkInitialize() != VK_SUCCESS)
        return Error{
            "There is no Vulkan loader here: install libvulkan1, or give the suite a \"key\" of its own."};
    VkApplicationInfo app{};
    app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    app.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &app;
    VkInstance instance = VK_NULL_HANDLE;
    if (vkCreateInstance(&info, nullptr, &instance) != VK_SUCCESS)
        return Error{
            "Vulkan has no driver here: install mesa-vulkan-drivers, or give the suite a \"key\" of its "
            "own."};
    volkLoadInstance(instance);
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (vkEnumeratePhysicalDevices(instance, &count, devices.data()) < 0) count = 0;
    devices.resize(count);
    std::vector<VulkanDriver> out;
    for (VkPhysicalDevice device : devices) {
        VkPhysicalDeviceDriverProperties driver{};
        driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
        VkPhysicalDeviceProperties2 properties{};
        properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        VkPhysicalDeviceProperties plain;
        vkGetPhysicalDeviceProperties(device, &plain);
        if (plain.apiVersion >= VK_API_VERSION_1_2) properties.pNext = &driver;
        if (plain.apiVersion >= VK_API_VERSION_1_1) vkGetPhysicalDeviceProperties2(device, &properties);
        VulkanDriver one{plain.deviceName, driver.driverName, driver.driverInfo, ""};
        if (one.info.empty()) one.info = std::to_string(plain.driverVersion);
        one.key = driver_key(one.device, one.info);
        out.push_back(std::move(one));
    }
    vkDestroyInstance(instance, nullptr);
    if (out.empty())
        return Error{
            "Vulkan has no device here: install mesa-vulkan-drivers, or give the suite a \"key\" of its "
            "own."};
    return out;
}

std::string told_drivers(const std::vector<VulkanDriver>& drivers) {
    std::string out;
    for (const VulkanDriver& one : drivers)
        out += one.key + "\t" + one.device + "\t" + one.driver + "\t" + one.info + "\n";
    return out;
}

std::vector<VulkanDriver> read_drivers(const std::string& told) {
    std::vector<VulkanDriver> out;
    for (std::string_view line : split(told, '\n')) {
        const std::vector<std::string_view> parts = split(line, '\t');
        if (parts.size() == 4)
            out.push_back(
                {std::string(parts[1]), std::string(parts[2]), std::string(parts[3]), std::string(parts[0])});
    }
    return out;
}

Result<std::vector<VulkanDriver>> ask_drivers(const std::string& program, const Environment& env) {
    Result<ScratchFolder> scratch = make_scratch();
    if (!scratch) return scratch.error();
    ProcessPlan plan;
    plan.words = {program, "device"};
    plan.env = {env.begin(), env.end()};
    plan.stdout_file = scratch->path + "/out", plan.stderr_file = scratch->path + "/err";
    plan.time_limit = 30;
    Result<ProcessEnd> end = run_process(plan);
    if (!end) return end.error();
    std::vector<VulkanDriver> drivers = read_drivers(tail_of(plan.stdout_file, 1 << 16));
    if (!drivers.empty() && end->how == HowEnded::exited && end->code == 0) return drivers;
    std::string why = tail_of(plan.stderr_file, 400);
    while (why.ends_with('\n')) why.pop_back();
    const std::string prefix = "rendercheck: ";
    if (why.starts_with(prefix)) return Error{why.substr(prefix.size())};
    return Error{"Vulkan could not be asked for its devices: that " + told_end(*end, plan) + "." +
                 (why.empty() ? "" : " " + why)};
}

Result<VulkanDriver> choose_driver(const std::vector<VulkanDriver>& drivers, const std::string& wanted) {
    std::vector<std::string> names;
    for (const VulkanDriver& one : drivers) {
        if (wanted.empty() || contains(one.device, wanted)) return one;
        names.push_back(one.device);
    }
    return Error{"No Vulkan device here is called " + wanted + "; there is " + joined(names) + "."};
}

}  // namespace flaneur
