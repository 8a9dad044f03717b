// The Vulkan renderer: a device, a scene on it, and frames drawn off-screen or into a window. The same frame
// code serves both.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/passes/cull.h"
#include "renderer/quality.h"
#include "sim/base/result.h"

struct GLFWwindow;

namespace flaneur {

struct RendererOptions {
    std::string device;  // part of a device's name, or its number; empty: the fastest kind, a real GPU before
                         // lavapipe
    std::optional<Quality> quality;  // default: ultra on a real GPU, medium elsewhere
    bool validation =
        false;  // Khronos validation with synchronisation validation; messages go to `on_message`
    std::function<void(const std::string&)> on_message;  // default: to stderr
    bool warms_up = false;  // has the driver compile what it puts off until something is drawn, meanwhile
    std::optional<bool> skins_on_host =
        {};  // whether the host skins people; default: where the device is a CPU
};

struct Image {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba;  // sRGB, opaque, rows from the top
};

struct FrameStats {
    struct Stage {
        std::string name;
        double gpu_ms = 0;                     // by GPU timestamps; 0 where the device has none
        uint64_t vertices = 0, fragments = 0;  // how many were shaded; 0 where the device does not count
    };
    std::vector<Stage> stages;  // in order
    double cpu_record_ms = 0;   // culling, uploading and recording
    uint32_t walkers_drawn = 0, walkers_in_shadow = 0, triangles = 0, sub_draws = 0, direct_draws = 0;
    uint32_t meshes[k_max_lods] = {};  // of the walkers drawn, by level of detail, finest first
    uint32_t impostors = 0;            // and the others
};

struct Renderer;
struct RendererDelete {
    void operator()(Renderer*) const;
};
using RendererPtr = std::unique_ptr<Renderer, RendererDelete>;

// Off-screen. Refuses, in a sentence, where there is no Vulkan driver or no device fits.
Result<RendererPtr> make_renderer(const RendererOptions& options);

// Into a window of GLFW's made with GLFW_NO_API; the window must outlive the renderer.
Result<RendererPtr> make_window_renderer(const RendererOptions& options, GLFWwindow* window);

// "llvmpipe (LLVM 15.0.6, 256 bits), Vulkan 1.3.230"
std::string device_name(const Renderer& renderer);

// "medium": of the quality that it draws with.
std::string quality_name(const Renderer& renderer);

// Whether the device draws edges of triangles alone, which FrameInput::surfaces may ask for.
bool can_draw_wireframe(const Renderer& renderer);

// Uploads a scene in place of any earlier one, which stays after a failure.
Result<void> upload_scene(Renderer& renderer, const SceneMeshes& scene);

// Whose joints a frame of this camera, sun and size will ask for.
PoseNeeds pose_needs(const Renderer& renderer, const Camera& camera, const Sun& sun, uint32_t width,
                     uint32_t height);

// Draws one frame off-screen and reads it back. Sizes 1..8192.
Result<Image> draw_image(Renderer& renderer, const FrameInput& frame, uint32_t width, uint32_t height);

// Draws one frame into the window and presents it. Nothing happens, with success, while the window has no
// area; a resized or lost surface is made anew.
Result<void> draw_window(Renderer& renderer, const FrameInput& frame);

// Of the last frame drawn.
const FrameStats& frame_stats(const Renderer& renderer);

// How many validation messages there have been.
uint32_t validation_messages(const Renderer& renderer);

}  // namespace flaneur
