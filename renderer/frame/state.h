// What a renderer holds. Only the renderer's own files see it.
#pragma once

#include "renderer/device/swapchain.h"
#include "renderer/frame/slot.h"
#include "renderer/frame/targets.h"
#include "renderer/light/sweep.h"
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
    GpuScene held;  // another city, with its lamps
    ShadowMaps shadows;
    PictureTargets targets;
    GpuImage picture{"picture"};  // off-screen, where the device lights, or panels lie over it; in a window,
                                  // where it is scaled
    GpuImage shown{"shown picture"};  // that show_image stretches
    GpuImage letters{"letters"};      // of panels
    Buffer readback{"picture for the host"};
    LitPicture lit;  // where the host lights
    GLFWwindow* window = nullptr;
    Swapchain swapchain;
    bool is_swapchain_stale = true;
    CrowdDraws crowd, casters;
    bool is_lit_on_host = false, are_people_skinned_on_host = false;
    bool is_captured = false;  // what is drawn now: also what the host lights goes to an image then
    WorkersPtr workers;        // of the host
    std::vector<SkinScratch> skin_scratch;  // one a thread
    OcclusionMap hidden;
    View last_view{};  // of the frame before
    FrameStats stats;
};

}  // namespace flaneur
