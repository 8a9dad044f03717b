// Which Vulkan devices there are, and what references of one are called.
#pragma once

#include <string>
#include <vector>

#include "sim/base/result.h"
#include "tools/rendercheck/suite/suite.h"

namespace flaneur {

struct VulkanDriver {
    std::string device;  // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;  // "llvmpipe"
    std::string info;    // "Mesa 22.3.6 (LLVM 15.0.6)"
    std::string key;     // driver_key() of these
};

// "llvmpipe-mesa-22.3.6-llvm-15.0.6": what decides the pixels. How wide a CPU's vectors are does not.
std::string driver_key(const std::string& device, const std::string& info);

// Of this process, in Vulkan's order. Refuses where there is no Vulkan.
Result<std::vector<VulkanDriver>> list_drivers();

// The same as lines that a program reads, and back.
std::string told_drivers(const std::vector<VulkanDriver>& drivers);
std::vector<VulkanDriver> read_drivers(const std::string& told);

// Asked in a process of its own, under the suite's environment. `program` is rendercheck's.
Result<std::vector<VulkanDriver>> ask_drivers(const std::string& program, const Environment& env);

// The suite's device, or the first. Refuses, with those that there are.
Result<VulkanDriver> choose_driver(const std::vector<VulkanDriver>& drivers, const std::string& wanted);

}  // namespace flaneur
