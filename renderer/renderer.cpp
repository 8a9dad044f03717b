#include "renderer/renderer.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "renderer/device/capture.h"
#include "renderer/device/check.h"
#include "renderer/picture/channels.h"
#include "renderer/picture/draw.h"
#include "renderer/picture/warm_up.h"
#include "renderer/visible/contacts.h"
#include "sim/base/zone.h"

namespace flaneur {
namespace {

constexpr uint32_t k_largest_picture = 8192;
constexpr float k_least_resolution = 0.1f;
constexpr uint64_t k_patience = 200'000'000;  // ns that an image of the window is waited for

Result<void> make_slots(Renderer& renderer) {
    for (FrameSlot& slot : renderer.slots) FLANEUR_TRY(make_slot(renderer.device, slot));
    VkDescriptorSet sets[k_slots] = {};
    FLANEUR_TRY(
        make_binding_sets(renderer.device, renderer.pipelines.bindings, renderer.descriptor_pool, sets));
    for (size_t i = 0; i < k_slots; ++i) renderer.slots[i].set = sets[i];
    return {};
}

Quality usual_quality(VkPhysicalDeviceType type) {
    if (type == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU) return Quality::ultra;
    return type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU ? Quality::high : Quality::medium;
}

Result<RendererPtr> make(const RendererOptions& options, GLFWwindow* window) {
    RendererPtr renderer(new Renderer);
    Renderer& r = *renderer;
    r.window = window;
    FLANEUR_TRY(make_device(r.device, options, window));
    if (window) FLANEUR_TRY(choose_surface_format(r.device, r.swapchain));
    const bool is_cpu = r.device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    r.quality = quality_level(options.quality.value_or(usual_quality(r.device.properties.deviceType)));
    r.are_people_skinned_on_host = options.skins_on_host.value_or(is_cpu);
    const bool can_host_light = !window || can_copy_to_window(r.device);
    r.is_lit_on_host = options.lights_on_host.value_or(is_cpu && can_host_light);
    if (r.is_lit_on_host && !can_host_light)
        return Error{
            "The host cannot hand pictures to this window: let the device light them (--light device)."};
    r.workers = make_workers(0);
    FLANEUR_TRY(make_pipelines(r.device, r.quality, r.is_lit_on_host, r.swapchain.format, r.pipelines));
    FLANEUR_TRY(make_slots(r));
    FLANEUR_TRY(make_shadow_maps(r.device, r.quality.shadow_resolution, r.is_lit_on_host, r.shadows));
    FLANEUR_TRY(make_scene(r.device, r.pipelines, {}, r.scene));
    if (options.warms_up) FLANEUR_TRY(warm_up(r));
    return renderer;
}

// An image to draw into that no window shows.
Result<void> fit_picture(Renderer& renderer, VkExtent2D extent, GpuImage& picture) {
    if (picture.view && picture.width == extent.width && picture.height == extent.height &&
        picture.format == k_picture_format)
        return {};
    FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
    destroy_image(renderer.device, picture);
    ImageShape shape{.format = k_picture_format, .width = extent.width, .height = extent.height};
    shape.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                  VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    Result<void> made = make_image(renderer.device, shape, picture);
    if (!made) destroy_image(renderer.device, picture);
    return made;
}

// Where the host lights, the memory that it does so in, if the picture goes on to an image.
Result<void> light_into_slot(Renderer& renderer, FrameSlot& slot, PictureTarget& target) {
    if (!renderer.is_lit_on_host) return {};
    FLANEUR_TRY(reserve_buffer(renderer.device, VkDeviceSize{4} * target.extent.width * target.extent.height,
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload, slot.picture));
    target.pixels = static_cast<uint32_t*>(slot.picture.mapped);
    target.staging = slot.picture.handle;
    return {};
}

Result<void> check_size(const Renderer& renderer, uint32_t width, uint32_t height) {
    const uint32_t largest = std::min(
        k_largest_picture, renderer.device.properties.limits.maxImageDimension2D / renderer.quality.samples);
    if (width >= 1 && height >= 1 && width <= largest && height <= largest) return {};
    return Error{"A picture of " + std::to_string(width) + " x " + std::to_string(height) +
                 " cannot be drawn: each side must be 1 to " + std::to_string(largest) + " pixels."};
}

Result<void> remake_swapchain(Renderer& renderer) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(renderer.window, &width, &height);
    FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
    FLANEUR_TRY(make_swapchain(renderer.device, {static_cast<uint32_t>(width), static_cast<uint32_t>(height)},
                               renderer.swapchain));
    renderer.is_swapchain_stale = false;
    return {};
}

// After the surface was lost: a new one, and a new swapchain on it.
Result<void> remake_surface(Renderer& renderer) {
    Device& device = renderer.device;
    FLANEUR_VK(vkDeviceWaitIdle(device.handle), "finish earlier frames");
    destroy_swapchain(device, renderer.swapchain);
    vkDestroySurfaceKHR(device.instance, device.surface, nullptr);
    device.surface = {};
    FLANEUR_TRY(make_surface(device, renderer.window));
    VkBool32 presents = VK_FALSE;
    FLANEUR_VK(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical, device.present_family, device.surface,
                                                    &presents),
               "ask whether the device draws into the window");
    if (!presents) return Error{"The device no longer draws into the window: start again."};
    return remake_swapchain(renderer);
}

// After a frame was not drawn into the image that was acquired for it: nothing will wait for its semaphore,
// and the image goes with the swapchain.
void give_up_image(Renderer& renderer, FrameSlot& slot) {
    // Whoever acquired it signals it, perhaps later: somebody has to wait.
    VkSemaphoreSubmitInfo ready{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    ready.semaphore = slot.image_ready;
    ready.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.waitSemaphoreInfoCount = 1;
    info.pWaitSemaphoreInfos = &ready;
    vkQueueSubmit2(renderer.device.queue, 1, &info, VK_NULL_HANDLE);
    vkDeviceWaitIdle(renderer.device.handle);
    vkDestroySemaphore(renderer.device.handle, slot.image_ready, nullptr);
    slot.image_ready = {};
    renderer.is_swapchain_stale = true;
}

}  // namespace

void RendererDelete::operator()(Renderer* renderer) const {
    Renderer& r = *renderer;
    if (r.device.handle) {
        vkDeviceWaitIdle(r.device.handle);
        destroy_swapchain(r.device, r.swapchain);
        destroy_scene(r.device, r.scene);
        destroy_scene(r.device, r.held);
        destroy_picture_targets(r.device, r.targets);
        destroy_shadow_maps(r.device, r.shadows);
        destroy_image(r.device, r.picture);
        destroy_image(r.device, r.shown);
        destroy_image(r.device, r.letters);
        destroy_buffer(r.device, r.readback);
        for (FrameSlot& slot : r.slots) destroy_slot(r.device, slot);
        if (r.descriptor_pool) vkDestroyDescriptorPool(r.device.handle, r.descriptor_pool, nullptr);
        destroy_pipelines(r.device, r.pipelines);
    }
    destroy_device(r.device);
    delete renderer;
}

Result<RendererPtr> make_renderer(const RendererOptions& options) { return make(options, nullptr); }

Result<RendererPtr> make_window_renderer(const RendererOptions& options, GLFWwindow* window) {
    return make(options, window);
}

std::string device_name(const Renderer& renderer) {
    const VkPhysicalDeviceProperties& device = renderer.device.properties;
    const uint32_t version = device.apiVersion;
    return std::string(device.deviceName) + ", Vulkan " + std::to_string(VK_API_VERSION_MAJOR(version)) +
           "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

std::string quality_name(const Renderer& renderer) { return renderer.quality.name; }

bool can_draw_wireframe(const Renderer& renderer) { return renderer.device.has_wireframe; }

namespace {

// make(scene) makes what shall be new, and swap(scene) puts it in place of what is there, once no frame
// refers to that.
template <class Make, class Swap>
Result<void> replace(Renderer& renderer, const Make& make, const Swap& swap) {
    GpuScene scene;
    auto prepare = [&]() -> Result<void> {
        FLANEUR_TRY(make(scene));
        FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
        return {};
    };
    Result<void> made = prepare();
    if (made) swap(scene);
    destroy_scene(renderer.device, scene);
    return made;
}

// Of another city.
void forget_shadows(Renderer& renderer) {
    renderer.shadows.state = {};
    renderer.last_view = {};
}

}  // namespace

Result<void> upload_scene(Renderer& renderer, const SceneMeshes& meshes) {
    return replace(
        renderer,
        [&](GpuScene& scene) { return make_scene(renderer.device, renderer.pipelines, meshes, scene); },
        [&](GpuScene& scene) {
            std::swap(renderer.scene, scene), forget_shadows(renderer);
            destroy_scene(renderer.device, renderer.held);
        });
}

Result<std::shared_ptr<const PreparedCity>> prepare_for_upload(const CityMesh& city) {
    Result<PreparedCity> prepared = prepare_city(city);
    if (!prepared) return prepared.error();
    return std::make_shared<const PreparedCity>(std::move(*prepared));
}

Result<void> upload_city(Renderer& renderer, const PreparedCity& city) {
    return replace(
        renderer, [&](GpuScene& scene) { return make_city(renderer.device, city, scene); },
        [&](GpuScene& scene) { swap_cities(renderer.scene, scene), forget_shadows(renderer); });
}

Result<void> upload_lamps(Renderer& renderer, const LampMap& lamps) {
    return replace(
        renderer, [&](GpuScene& scene) { return make_lamps(renderer.device, lamps, scene); },
        [&](GpuScene& scene) { swap_lamps(renderer.scene, scene); });
}

Result<void> hold_city(Renderer& renderer, const PreparedCity& city, const LampMap& lamps) {
    return replace(
        renderer,
        [&](GpuScene& scene) -> Result<void> {
            FLANEUR_TRY(make_city(renderer.device, city, scene));
            return make_lamps(renderer.device, lamps, scene);
        },
        [&](GpuScene& scene) { std::swap(renderer.held, scene); });
}

Result<void> exchange_cities(Renderer& renderer) {
    if (renderer.held.chunks.empty()) return Error{"No other city is held that could be drawn."};
    FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
    swap_cities(renderer.scene, renderer.held);
    swap_lamps(renderer.scene, renderer.held);
    forget_shadows(renderer);
    return {};
}

Result<void> upload_letters(Renderer& renderer, const Letters& letters) {
    if (letters.texels.size() != size_t{4} * letters.width * letters.height || letters.texels.empty())
        return Error{"The letters' size does not agree with their texels."};
    GpuImage image{"letters"};
    auto make = [&]() -> Result<void> {
        ImageShape shape{.width = letters.width, .height = letters.height};
        shape.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        FLANEUR_TRY(make_image(renderer.device, shape, image));
        FLANEUR_TRY(upload_layers(renderer.device, std::as_bytes(letters.texels), image));
        FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
        return {};
    };
    Result<void> made = make();
    if (made) std::swap(renderer.letters, image);
    destroy_image(renderer.device, image);
    return made;
}

Result<std::vector<uint32_t>> baked_impostors(Renderer& renderer) {
    return read_impostors(renderer.device, renderer.scene.impostors);
}

uint64_t impostors_key(const Renderer& renderer, std::span<const PersonMesh> people) {
    return impostors_key(renderer.device, people);
}

PoseNeeds pose_needs(const Renderer& renderer, const Camera& camera, const Sun& sun, uint32_t width,
                     uint32_t height) {
    const std::vector<PersonRanges>& people = renderer.scene.people;
    const bool has_impostors = std::all_of(people.begin(), people.end(), [](const PersonRanges& person) {
        return person.is_thing || person.first_cell != PersonRanges::k_no_cell;
    });
    // A little less than where the last meshes and spots go, for sums are rounded.
    const float least = std::min(renderer.scene.impostors.pixels * (1 - k_turns), k_least_contact) * 0.99f;
    View view = make_view(camera, std::max(width, 1u), std::max(height, 1u));
    view.pixels_at_one_metre *= renderer.quality.detail;
    return {view, make_daylight(sun, false).to_light, has_impostors ? least : 0};
}

Result<Image> draw_image(Renderer& renderer, const FrameInput& frame, uint32_t width, uint32_t height) {
    FLANEUR_ZONE("draw");
    FLANEUR_TRY(check_size(renderer, width, height));
    for (FrameSlot& slot : renderer.slots) FLANEUR_TRY(finish_slot(renderer.device, slot, renderer.stats));
    FrameSlot& slot = renderer.slots[0];
    Image image{width, height, {}, {}};
    const size_t bytes = size_t{4} * width * height;
    PictureTarget target{.extent = {width, height}};
    if (renderer.is_lit_on_host && frame.panels.draws.empty() && !renderer.is_captured) {
        {
            FLANEUR_ZONE("make room");
            image.rgba.resize(bytes);
        }
        target.pixels = reinterpret_cast<uint32_t*>(image.rgba.data());
        FLANEUR_TRY(draw_frame(renderer, slot, frame, target, {}, {}));
        FLANEUR_TRY(add_channels(renderer, frame, image));
        return image;
    }
    FLANEUR_TRY(fit_picture(renderer, target.extent, renderer.picture));
    FLANEUR_TRY(reserve_buffer(renderer.device, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback,
                               renderer.readback));
    FLANEUR_TRY(light_into_slot(renderer, slot, target));
    target.image = &renderer.picture;
    target.smooth = renderer.pipelines.smooth_image;
    target.panels = renderer.pipelines.panels_image;
    target.after = k_copied_from;
    target.readback = renderer.readback.handle;
    FLANEUR_TRY(draw_frame(renderer, slot, frame, target, {}, {}));
    FLANEUR_TRY(finish_slot(renderer.device, slot, renderer.stats));
    {
        FLANEUR_ZONE("read back");
        const auto* first = static_cast<const uint8_t*>(renderer.readback.mapped);
        image.rgba.assign(first, first + bytes);
    }
    FLANEUR_TRY(add_channels(renderer, frame, image));
    return image;
}

static Result<void> check_image(const Renderer& renderer, const Image& image) {
    FLANEUR_TRY(check_size(renderer, image.width, image.height));
    if (image.rgba.size() != size_t{4} * image.width * image.height)
        return Error{"The picture's size does not agree with its pixels."};
    return {};
}

// A picture that is there, where `target` takes it from.
static Result<void> stage_image(Renderer& renderer, FrameSlot& slot, const Image& image,
                                PictureTarget& target) {
    FLANEUR_TRY(fit_picture(renderer, target.extent, renderer.shown));
    FLANEUR_TRY(reserve_buffer(renderer.device, image.rgba.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                               MemoryKind::upload, slot.picture));
    std::memcpy(slot.picture.mapped, image.rgba.data(), image.rgba.size());
    target.staging = slot.picture.handle;
    return {};
}

Result<Image> draw_over_image(Renderer& renderer, const Image& under, const Panels& panels) {
    FLANEUR_TRY(check_image(renderer, under));
    for (FrameSlot& slot : renderer.slots) FLANEUR_TRY(finish_slot(renderer.device, slot, renderer.stats));
    FrameSlot& slot = renderer.slots[0];
    const size_t bytes = under.rgba.size();
    PictureTarget target{.extent = {under.width, under.height},
                         .image = &renderer.shown,
                         .panels = renderer.pipelines.panels_image,
                         .after = k_copied_from};
    FLANEUR_TRY(stage_image(renderer, slot, under, target));
    FLANEUR_TRY(reserve_buffer(renderer.device, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback,
                               renderer.readback));
    target.readback = renderer.readback.handle;
    FLANEUR_TRY(draw_over_picture(renderer, slot, panels, target, {}, {}));
    FLANEUR_TRY(finish_slot(renderer.device, slot, renderer.stats));
    Image image{under.width, under.height, {}, {}};
    const auto* first = static_cast<const uint8_t*>(renderer.readback.mapped);
    image.rgba.assign(first, first + bytes);
    return image;
}

namespace {

// Gets an image of the window, calls draw(slot, image, signal), and presents the image; nothing where nobody
// looks.
template <class Draw>
Result<void> draw_and_present(Renderer& renderer, const Draw& draw) {
    assert(renderer.window);
    FLANEUR_ZONE("draw");
    Swapchain& swapchain = renderer.swapchain;
    FrameSlot& slot = renderer.slots[renderer.next_slot];
    FLANEUR_TRY(finish_slot(renderer.device, slot, renderer.stats));
    if (!slot.image_ready) FLANEUR_TRY(make_image_ready(renderer.device, slot));
    uint32_t index = 0;
    constexpr int tries = 4;  // a window may change again while its images are made anew
    for (int i = 0;; ++i) {
        int width = 0, height = 0;
        glfwGetFramebufferSize(renderer.window, &width, &height);
        if (width <= 0 || height <= 0) return {};
        if (renderer.is_swapchain_stale || !swapchain.handle) FLANEUR_TRY(remake_swapchain(renderer));
        if (!swapchain.handle) return {};
        const VkResult result = [&] {
            FLANEUR_ZONE("wait for the window");
            return vkAcquireNextImageKHR(renderer.device.handle, swapchain.handle, k_patience,
                                         slot.image_ready, VK_NULL_HANDLE, &index);
        }();
        if (result == VK_TIMEOUT || result == VK_NOT_READY) return {};  // nobody looks
        if (result == VK_SUBOPTIMAL_KHR) renderer.is_swapchain_stale = true;
        if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) break;
        if (i == tries) return vulkan_error(result, "get an image of the window");
        if (result == VK_ERROR_OUT_OF_DATE_KHR)
            renderer.is_swapchain_stale = true;
        else if (result == VK_ERROR_SURFACE_LOST_KHR)
            FLANEUR_TRY(remake_surface(renderer));
        else
            return vulkan_error(result, "get an image of the window");
    }
    if (Result<void> drawn = draw(slot, swapchain.images[index], swapchain.drawn[index]); !drawn) {
        give_up_image(renderer, slot);
        return drawn;
    }
    renderer.next_slot = (renderer.next_slot + 1) % k_slots;

    FLANEUR_ZONE("present");
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &swapchain.drawn[index];
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain.handle;
    info.pImageIndices = &index;
    const VkResult result = vkQueuePresentKHR(renderer.device.present_queue, &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        renderer.is_swapchain_stale = true;
    else if (result == VK_ERROR_SURFACE_LOST_KHR)
        return remake_surface(renderer);
    else
        FLANEUR_VK(result, "show a frame");
    return {};
}

}  // namespace

Result<void> draw_window(Renderer& renderer, const FrameInput& frame) {
    return draw_and_present(
        renderer, [&](FrameSlot& slot, GpuImage& image, VkSemaphore drawn) -> Result<void> {
            const Swapchain& swapchain = renderer.swapchain;
            PictureTarget target{
                .extent = swapchain.extent,
                .image = &image,
                .smooth = renderer.pipelines.smooth_window,
                .panels = renderer.pipelines.panels_window,
                .after = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR},
                .is_blue_first = swapchain.format == VK_FORMAT_B8G8R8A8_UNORM};
            FLANEUR_TRY(check_size(renderer, target.extent.width, target.extent.height));
            if (frame.resolution < 1 && swapchain.takes_copies) {
                const float share = std::max(frame.resolution, k_least_resolution);
                auto scaled = [&](uint32_t pixels) {
                    return std::max(static_cast<uint32_t>(static_cast<float>(pixels) * share), 1u);
                };
                target.extent = {scaled(target.extent.width), scaled(target.extent.height)};
                FLANEUR_TRY(fit_picture(renderer, target.extent, renderer.picture));
                target.image = &renderer.picture;
                target.scaled = &image;
                target.smooth = renderer.pipelines.smooth_image;
                target.is_blue_first = false;
            }
            FLANEUR_TRY(light_into_slot(renderer, slot, target));
            const bool is_copied = renderer.is_lit_on_host || target.scaled;
            const Access written = is_copied ? k_copied_to : k_colour_target;
            // Its semaphore is waited for before the picture is written.
            image.last.assign(1, {written.stage, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED});
            return draw_frame(renderer, slot, frame, target, {slot.image_ready, written.stage}, drawn);
        });
}

Result<void> show_image(Renderer& renderer, const Image& picture, const Panels& panels) {
    FLANEUR_TRY(check_image(renderer, picture));
    return draw_and_present(
        renderer, [&](FrameSlot& slot, GpuImage& image, VkSemaphore drawn) -> Result<void> {
            if (!renderer.swapchain.takes_copies)
                return Error{"This window takes no pictures that were drawn before."};
            PictureTarget target{
                .extent = {picture.width, picture.height},
                .image = &renderer.shown,
                .scaled = &image,
                .panels = renderer.pipelines.panels_window,
                .after = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}};
            FLANEUR_TRY(stage_image(renderer, slot, picture, target));
            image.last.assign(1, {k_copied_to.stage, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED});
            return draw_over_picture(renderer, slot, panels, target, {slot.image_ready, k_copied_to.stage},
                                     drawn);
        });
}

bool can_capture(const Renderer&) { return has_renderdoc(); }

Result<void> begin_capture(Renderer& renderer) {
    // What was asked for before is none of it.
    FLANEUR_VK(vkDeviceWaitIdle(renderer.device.handle), "finish earlier frames");
    FLANEUR_TRY(begin_capture(renderer.device.instance));
    renderer.is_captured = true;
    return {};
}

Result<std::string> end_capture(Renderer& renderer, const std::string& path) {
    renderer.is_captured = false;
    return end_capture(renderer.device.instance, path);
}

const FrameStats& frame_stats(const Renderer& renderer) { return renderer.stats; }

bool has_lost_device(const Renderer& renderer) {
    return vkDeviceWaitIdle(renderer.device.handle) == VK_ERROR_DEVICE_LOST;
}

uint32_t validation_messages(const Renderer& renderer) { return renderer.device.messages; }

}  // namespace flaneur
