#include "renderer/picture/warm_up.h"

#include "renderer/device/check.h"
#include "renderer/picture/draw.h"
#include "renderer/shapes.h"

namespace flaneur {
namespace {

// As any picture but a few: no side is a power of two, which some drivers compile for.
constexpr VkExtent2D k_extent{67, 37};

// A square of every class of the city's surfaces, facing +z, one behind the other.
CityMesh squares() {
    CityMesh city;
    for (uint32_t material : {k_material_road, k_material_facade, k_material_roof, k_material_metal,
                              k_material_shade, k_material_scenery}) {
        const float z = -static_cast<float>(material);
        add_quad(city, {glm::vec3(-1, -1, z), {1, -1, z}, {1, 1, z}, {-1, 1, z}},
                 {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}, material, ~0u);
    }
    return city;
}

// One triangle for every level and as an impostor.
PersonMesh triangle() {
    PersonMesh person;
    for (const glm::vec2 at : {glm::vec2(-1, -1), {1, -1}, {0, 1}})
        person.vertices.push_back({glm::vec3(at, 0), ~0u, at, {0, 0, 127, 0}, {}, {255, 0, 0, 0}, ~0u});
    person.lods.assign(k_max_lods, {0, 1, 2});
    person.strides.assign(k_stride_poses * k_palette_joints, {{0, 0, 0, 1}, {0, 0, 0, 0}});
    return person;
}

}  // namespace

Result<void> warm_up(Renderer& renderer) {
    SceneMeshes meshes;
    meshes.city = squares();
    meshes.people = {triangle()};
    FLANEUR_TRY(upload_scene(renderer, meshes));

    // Levels go by the sizes of spheres: a mesh and an impostor.
    std::vector<WalkerDraw> walkers;
    for (const float radius : {30.0f, 0.2f}) walkers.push_back({.centre = {0, 0, 1}, .radius = radius});
    const std::vector<JointTransform> palette(k_palette_joints, {{0, 0, 0, 1}, {0, 0, 0, 0}});
    FrameInput frame;
    frame.camera = {.eye = {0, 0, 60}, .target = {0, 0, 0}, .vertical_fov = 0.05f};
    frame.walkers = walkers;
    frame.palette = palette;
    frame.skips_hidden = false;

    const bool is_window = renderer.window != nullptr;
    std::vector<uint32_t> pixels;
    PictureTarget target{.extent = k_extent, .after = k_copied_from};
    if (renderer.is_lit_on_host) {
        pixels.resize(size_t{k_extent.width} * k_extent.height);
        target.pixels = pixels.data();
    } else {
        ImageShape shape{.format = is_window ? renderer.swapchain.format : k_picture_format,
                         .width = k_extent.width,
                         .height = k_extent.height};
        shape.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        FLANEUR_TRY(make_image(renderer.device, shape, renderer.picture));
        target.image = &renderer.picture;
        target.smooth = is_window ? renderer.pipelines.smooth_window : renderer.pipelines.smooth_image;
    }
    FLANEUR_TRY(draw_frame(renderer, renderer.slots[0], frame, target, {}, {}));
    frame.sun.direction = {0, -1, 0};  // at night there are stars too
    return draw_frame(renderer, renderer.slots[1], frame, target, {}, {});
}

}  // namespace flaneur
