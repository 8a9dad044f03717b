// The Vulkan renderer: a device, a scene on it, and frames drawn off-screen or into a window. One picture
// takes four calls:
//
//     Result<RendererPtr> renderer = make_renderer({});  // on any Vulkan device, lavapipe too
//     SceneMeshes scene;                                 // shapes.h has pieces of a city
//     add_ground(scene.city, {-20, -20}, {20, 20}, 0, k_material_plaza, vertex_colour(0xb0a48f));
//     Result<void> uploaded = upload_scene(**renderer, scene);
//     FrameInput frame;
//     frame.camera = {.eye = {0, 1.7f, -8}, .target = {0, 1, 0}};
//     Result<Image> image = draw_image(**renderer, frame, 640, 360);
//
// What may fail returns a Result, which then holds a sentence. A renderer belongs to one
// thread at a time. scene.h says what scenes and frames are made of.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderer/options.h"
#include "renderer/scene.h"
#include "renderer/view.h"
#include "sim/base/result.h"

struct GLFWwindow;

namespace flaneur {

struct Renderer;
struct RendererDelete {
    void operator()(Renderer*) const;
};
using RendererPtr = std::unique_ptr<Renderer, RendererDelete>;

// Off-screen. Refuses, in a sentence, where there is no Vulkan driver or no device fits.
Result<RendererPtr> make_renderer(const RendererOptions& options);

// Uploads a scene in place of any earlier one, which stays after a failure. The meshes are needed no longer
// then. Refuses those that refer to vertices, joints or textures that are not there.
Result<void> upload_scene(Renderer& renderer, const SceneMeshes& scene);

// A city as the device takes it: fitted with windows and gathered in pieces, on any thread. Refuses what
// upload_scene() does of a city.
struct PreparedCity;
Result<std::shared_ptr<const PreparedCity>> prepare_for_upload(const CityMesh& city);

// Uploads it in place of the scene's city; the pictures of scenery, people and lamps stay as they are. Takes
// as long as its bytes take to the device: the window goes on meanwhile.
Result<void> upload_city(Renderer& renderer, const PreparedCity& city);
// The same of the light of lamps.
Result<void> upload_lamps(Renderer& renderer, const LampMap& lamps);

// Holds a second city with the light of its lamps on the device, in place of an earlier one and until another
// scene is uploaded; and draws that one from the next frame on, while the one that was drawn is held. Neither
// of them is lost by a failure.
Result<void> hold_city(Renderer& renderer, const PreparedCity& city, const LampMap& lamps);
Result<void> exchange_cities(Renderer& renderer);

// The impostors of the scene, for SceneMeshes::impostors of one with the same people, and a key that says of
// people, device and shaders what impostors depend on.
Result<std::vector<uint32_t>> baked_impostors(Renderer& renderer);
uint64_t impostors_key(const Renderer& renderer, std::span<const PersonMesh> people);

// The letters and pictures of panels, from the next frame on.
Result<void> upload_letters(Renderer& renderer, const Letters& letters);

struct Image {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba;  // sRGB, opaque, rows from the top
    // Where FrameInput::wants_depths asked for them, one a pixel: how far ahead of the eye, along the way
    // that it looks, the nearest thing in it is, metres, infinite where only sky is. Alpha says then how much
    // of the pixel is no sky. Lines and fills count for neither.
    std::vector<float> depths = {};
    // Where FrameInput::wants_ids asked for them, one a pixel: the id that the same nearest thing was given
    // (WalkerDraw, CityVertex), 0 where only sky is.
    std::vector<uint32_t> ids = {};
};

// Draws one frame off-screen and reads it back. Sizes 1..8192, or less where the device draws no larger
// images. The same scene and frames give the same bytes
// every time on the same device.
Result<Image> draw_image(Renderer& renderer, const FrameInput& frame, uint32_t width, uint32_t height);

// Into a window of GLFW's made with GLFW_NO_API; the window must outlive the renderer.
Result<RendererPtr> make_window_renderer(const RendererOptions& options, GLFWwindow* window);

// Draws one frame into the window and presents it. Nothing happens, with success, while the window has no
// area or nobody shows it; a resized or lost surface is made anew.
Result<void> draw_window(Renderer& renderer, const FrameInput& frame);

// A picture that is there with panels over it. Refuses before the first frame is drawn.
Result<Image> draw_over_image(Renderer& renderer, const Image& image, const Panels& panels);

// Shows a picture that is there in the window, stretched to it where it is of another size, with panels over
// it; else as draw_window. Refuses before the first frame is drawn, and where the window takes no copies.
Result<void> show_image(Renderer& renderer, const Image& image, const Panels& panels);

// Whose joints a frame of this camera, sun and size will ask for; see needs_pose() in view.h. Crowds save
// most of their poses by it.
PoseNeeds pose_needs(const Renderer& renderer, const Camera& camera, const Sun& sun, uint32_t width,
                     uint32_t height);

// "llvmpipe (LLVM 15.0.6, 256 bits), Vulkan 1.3.230"
std::string device_name(const Renderer& renderer);

// "medium": of the quality that it draws with.
std::string quality_name(const Renderer& renderer);

// Whether the device draws edges of triangles alone, which FrameInput::surfaces may ask for.
bool can_draw_wireframe(const Renderer& renderer);

// What draw_image() or draw_window() does from begin to end becomes a capture that RenderDoc opens: a file
// with each call and all that it needs, under the names that passes and objects have here. Of one picture,
// begin right before it and end right after, whether it could be drawn or not; it is the picture that it
// would have been. begin_capture() refuses where RenderDoc is neither loaded (RendererOptions::captures) nor
// has started this program; can_capture() tells that before.
bool can_capture(const Renderer& renderer);
Result<void> begin_capture(Renderer& renderer);
// Where it went: `path`, a name that ends in .rdc, in place of what was there; but where RenderDoc has
// started this program, to where that keeps its captures and lists them. Refuses what could not be written.
Result<std::string> end_capture(Renderer& renderer, const std::string& path);

struct FrameStats {
    struct Stage {
        std::string name;
        double gpu_ms = 0;  // by GPU timestamps, light on the host by its clock; 0: not known
        // How many were shaded; 0 where FrameInput::times_passes does not ask, or the device does not count.
        uint64_t vertices = 0, fragments = 0;
    };
    std::vector<Stage> stages;  // in order
    double cpu_record_ms = 0;   // culling, uploading and recording
    uint32_t walkers_drawn = 0, walkers_in_shadow = 0, triangles = 0, sub_draws = 0, direct_draws = 0;
    uint32_t meshes[k_max_lods] =
        {};                       // of the walkers drawn, by level of detail, the finer of two; finest first
    uint32_t impostors = 0;       // and the others
    uint64_t uploaded_bytes = 0;  // handed to the device for this frame
    uint32_t shadow_slices_drawn = 0;  // of the city's shadow maps; eight make a map
};

// Of the last frame drawn; times of the device in a window are of one or two frames before.
const FrameStats& frame_stats(const Renderer& renderer);

// Whether the device was lost, as when a driver resets a GPU: nothing more is drawn with it. What fails then
// may be drawn by a renderer made anew.
bool has_lost_device(const Renderer& renderer);

// How many validation messages there have been.
uint32_t validation_messages(const Renderer& renderer);

}  // namespace flaneur
