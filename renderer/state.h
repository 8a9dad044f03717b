// What a renderer holds. Only the renderer's own files see it.
#pragma once

#include "renderer/gpu_scene.h"
#include "renderer/pipelines.h"
#include "renderer/renderer.h"
#include "renderer/skin.h"
#include "renderer/swapchain.h"
#include "renderer/targets.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

inline constexpr uint32_t k_slots = 2;        // frames in flight in a window
inline constexpr uint32_t k_max_stages = 16;  // timed ones of a frame

struct SkinBuffers {
    Buffer vertices, indices;  // SkinnedVertex; uint32_t, counted from the vertices of each draw
};

// What one frame in flight owns.
struct FrameSlot {
    VkCommandPool pool = {};
    VkCommandBuffer commands = {};
    VkFence done = {};
    VkSemaphore image_ready = {};
    VkDescriptorSet set = {};
    VkQueryPool timestamps = {};  // at the start, and at the end of each stage
    VkQueryPool counters = {};    // of each stage: vertices and fragments shaded
    Buffer constants, instances, palette, impostors, draws, contacts, lines, fills;
    SkinBuffers crowd, casters;       // skinned by the host
    std::vector<std::string> stages;  // names of those timed
    bool is_pending = false;          // submitted, and not yet waited for
};

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
