// What a renderer holds. Only the renderer's own files see it.
#pragma once

#include "renderer/device/swapchain.h"
#include "renderer/frame/slot.h"
#include "renderer/frame/targets.h"
#include "renderer/loaded/gpu_scene.h"
#include "renderer/people/skin.h"
#include "renderer/pipelines/pipelines.h"
#include "renderer/renderer.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

struct Renderer {
    Device device;
    QualityLevel quality;
    Pipelines pipelines;
    VkDescriptorPool descriptor_pool = {};
    FrameSlot slots[k_slots];
    uint32_t next_slot = 0;
    GpuScene scene;
    ShadowMaps shadows;
    PictureTargets targets;
    GpuImage picture;  // off-screen
    Buffer readback;
    GLFWwindow* window = nullptr;
    Swapchain swapchain;
    bool is_swapchain_stale = true;
    CrowdDraws crowd, casters;
    WorkersPtr workers;                     // that skin people; null where the device does
    std::vector<SkinScratch> skin_scratch;  // one a thread
    OcclusionMap hidden;
    View last_view{};  // of the frame before
    FrameStats stats;
};

}  // namespace flaneur
