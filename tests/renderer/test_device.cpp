#include <gtest/gtest.h>

#include <cstdlib>

#include "renderer/device/device.h"
#include "renderer/renderer.h"

namespace flaneur {
namespace {

std::vector<DeviceChoice> three_devices() {
    return {{"llvmpipe (LLVM 15.0.6, 256 bits)", VK_PHYSICAL_DEVICE_TYPE_CPU, ""},
            {"Intel(R) UHD Graphics 620", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, ""},
            {"NVIDIA GeForce GTX 480", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "Vulkan 1.3"}};
}

TEST(Device, TakesTheFastestThatFits) {
    EXPECT_EQ(choose_device(three_devices(), "").value(), 1u);
    std::vector<DeviceChoice> devices = three_devices();
    devices[2].missing.clear();
    EXPECT_EQ(choose_device(devices, "").value(), 2u);
}

TEST(Device, IsChosenByNameOrNumber) {
    EXPECT_EQ(choose_device(three_devices(), "LLVMPIPE").value(), 0u);
    EXPECT_EQ(choose_device(three_devices(), "uhd").value(), 1u);
    EXPECT_EQ(choose_device(three_devices(), "0").value(), 0u);
}

TEST(Device, RefusalsListWhatThereIs) {
    for (const char* wanted : {"radeon", "2", "3", "geforce", "99999999999999999999"}) {
        const auto chosen = choose_device(three_devices(), wanted);
        ASSERT_FALSE(chosen) << wanted;
        EXPECT_NE(chosen.error().message.find("llvmpipe"), std::string::npos);
        EXPECT_NE(chosen.error().message.find("lacks Vulkan 1.3"), std::string::npos);
    }
    EXPECT_NE(choose_device({}, "").error().message.find("install"), std::string::npos);
}

TEST(Device, UnknownNameIsRefused) {
    const auto renderer =
        make_renderer({.device = "no such device", .quality = {}, .validation = false, .on_message = {}});
    ASSERT_FALSE(renderer);
    EXPECT_NE(renderer.error().message.find("no such device"), std::string::npos);
}

TEST(Device, NoDriverGetsASentence) {
    setenv("VK_DRIVER_FILES", "/nonexistent", 1);
    setenv("VK_ICD_FILENAMES", "/nonexistent", 1);
    const auto renderer = make_renderer({});
    unsetenv("VK_DRIVER_FILES");
    unsetenv("VK_ICD_FILENAMES");
    ASSERT_FALSE(renderer);
    EXPECT_NE(renderer.error().message.find("driver"), std::string::npos) << renderer.error().message;
    EXPECT_NE(renderer.error().message.find("install"), std::string::npos) << renderer.error().message;
}

}  // namespace
}  // namespace flaneur
