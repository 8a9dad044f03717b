#include "renderer/loaded/impostors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "renderer/device/check.h"
#include "renderer/loaded/gpu_scene.h"
#include "renderer/scene.h"
#include "sim/base/hash.h"
#include "spirv/impostor_bake.frag.h"
#include "spirv/impostor_bake.vert.h"

namespace flaneur {
namespace {

constexpr uint32_t k_tallest_cell = 36, k_lowest_cell = 20;  // texels
constexpr float k_cell_aspect = 0.55f;                       // width over height
constexpr size_t k_baked_lod = 3;                            // the last one before impostors
constexpr float k_largest = 3;  // metres about the centre; what reaches farther has no impostor

vec2 side_angle(int side) {  // sine and cosine, as k_tilts
    const float turn = static_cast<float>(side) * (6.2831853f / k_impostor_sides);
    return {std::sin(turn), std::cos(turn)};
}

const std::vector<uint32_t>& baked_level(const PersonMesh& mesh) {
    return mesh.lods[std::min(k_baked_lod, mesh.lods.size() - 1)];
}

// Where a pose puts the vertices that are drawn.
void skin(const PersonMesh& mesh, std::span<const uint32_t> drawn, const JointTransform* pose,
          std::vector<glm::vec3>& places) {
    places.clear();
    for (uint32_t index : drawn) {
        const PersonVertex& vertex = mesh.vertices[index];
        glm::vec3 place(0);
        for (int k = 0; k < 4 && vertex.weights[k] > 0; ++k)
            place += moved_by(pose[vertex.joints[k]], vertex.position) *
                     (static_cast<float>(vertex.weights[k]) / 255);
        places.push_back(place);
    }
}

// What the view from one side sees, with a texel to spare on each edge.
glm::vec4 box_about(std::span<const glm::vec3> places, vec2 side, vec2 tilt, const CellGrid& grid) {
    glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : places) {
        const float away = side.x * p.x + side.y * p.z;
        const glm::vec2 seen(side.y * p.x - side.x * p.z, tilt.y * p.y - tilt.x * away);
        low = glm::min(low, seen);
        high = glm::max(high, seen);
    }
    const glm::vec2 texels(grid.width, grid.height), inner = texels - 2.0f;
    const glm::vec2 size = glm::max(high - low, 0.01f) * texels / inner;
    return {low - size / texels, size};
}

// The cells of one person, or none where a pose is not finite or far too large.
std::vector<glm::vec4> find_boxes(const PersonMesh& mesh, const CellGrid& grid) {
    std::vector<uint32_t> drawn = baked_level(mesh);
    std::sort(drawn.begin(), drawn.end());
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    std::vector<glm::vec4> boxes;
    std::vector<glm::vec3> places;
    for (int pose = 0; pose < k_stride_poses; ++pose) {
        skin(mesh, drawn, &mesh.strides[static_cast<size_t>(pose * k_palette_joints)], places);
        for (const glm::vec3& place : places)
            if (!(glm::length(place) < k_largest)) return {};
        for (const vec2& tilt : k_tilts)
            for (int side = 0; side < k_impostor_sides; ++side)
                boxes.push_back(box_about(places, side_angle(side), tilt, grid));
    }
    return boxes;
}

// What a bake needs and leaves behind.
struct Bake {
    Buffer poses{"poses to bake"}, draws{"draws to bake"};
    GpuImage depth{"depth of bakes"};
    VkDescriptorPool pool = {};
    VkDescriptorSet set = {};
    uint32_t people = 0;
};

Result<void> make_set(const Device& device, const Pipelines& pipelines, const GpuScene& scene, Bake& bake) {
    FLANEUR_TRY(make_binding_sets(device, pipelines.bindings, bake.pool, std::span(&bake.set, 1)));
    // The shaders read poses, cells and textures; lavapipe looks at the other bindings too.
    std::array<Bound, k_bindings> bound;
    for (size_t i = 0; i < k_bindings; ++i) {
        if (is_image(k_binding_kinds[i]))
            bound[i].view = scene.textures.view;
        else
            bound[i].buffer = scene.impostors.cells.handle;
    }
    bound[k_binding_frame] = {};
    bound[k_binding_palette].buffer = bake.poses.handle;
    write_bindings(device, pipelines.bindings, bound, bake.set);
    return {};
}

void record_bake(const Device& device, VkCommandBuffer commands, const Pipelines& pipelines, GpuScene& scene,
                 Bake& bake) {
    GpuImage& atlas = scene.impostors.atlas;
    image_to(commands, atlas, k_colour_target);
    if (bake.people > 0) image_to(commands, bake.depth, k_depth_target);
    VkRenderingAttachmentInfo colour = attachment(atlas.view, VK_ATTACHMENT_LOAD_OP_CLEAR);
    colour.clearValue.color.uint32[0] = ~0u;  // k_empty_texel
    VkRenderingAttachmentInfo depth = attachment(bake.depth.view, VK_ATTACHMENT_LOAD_OP_CLEAR);
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {atlas.width, atlas.height};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    if (bake.people > 0) info.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &info);
    if (bake.people > 0) {
        const VkViewport viewport{0, 0, static_cast<float>(atlas.width), static_cast<float>(atlas.height),
                                  0, 1};
        const glm::vec2 size(atlas.width, atlas.height);
        const VkDeviceSize offset = 0;
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &info.renderArea);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.impostor_bake);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout, 0, 1, &bake.set,
                                0, nullptr);
        vkCmdPushConstants(commands, pipelines.layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof size, &size);
        vkCmdBindVertexBuffers(commands, 0, 1, &scene.person_vertices.handle, &offset);
        vkCmdBindIndexBuffer(commands, scene.person_indices.handle, 0, VK_INDEX_TYPE_UINT32);
        draw_indexed_indirect(device, commands, bake.draws.handle, 0, bake.people);
    }
    vkCmdEndRendering(commands);
    image_to(commands, atlas, k_sampled);
}

Result<void> make_atlas(const Device& device, const Pipelines& pipelines, std::span<const ImpostorCell> cells,
                        std::span<const JointTransform> poses, std::span<const DrawCommand> draws,
                        const CellGrid& grid, std::span<const uint32_t> kept, GpuScene& scene, Bake& bake) {
    bake.people = static_cast<uint32_t>(draws.size());
    FLANEUR_TRY(upload_buffer(device, std::as_bytes(cells), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                              scene.impostors.cells));
    FLANEUR_TRY(upload_buffer(device, std::as_bytes(poses), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, bake.poses));
    FLANEUR_TRY(upload_buffer(device, std::as_bytes(draws), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, bake.draws));
    ImageShape shape{.format = k_atlas_format};
    if (bake.people > 0) shape.width = grid.columns * grid.width, shape.height = grid.rows * grid.height;
    shape.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    FLANEUR_TRY(make_image(device, shape, scene.impostors.atlas));
    if (kept.size() == size_t{shape.width} * shape.height)
        return upload_layers(device, std::as_bytes(kept), scene.impostors.atlas);
    if (bake.people > 0) {
        shape.format = k_shadow_format;
        shape.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
        FLANEUR_TRY(make_image(device, shape, bake.depth));
        FLANEUR_TRY(make_set(device, pipelines, scene, bake));
    }
    return run_once(device,
                    [&](VkCommandBuffer commands) { record_bake(device, commands, pipelines, scene, bake); });
}

}  // namespace

CellGrid cell_grid(size_t people) {
    const size_t cells = people * k_person_cells;
    for (uint32_t height = k_tallest_cell; height >= k_lowest_cell; --height) {
        CellGrid grid;
        grid.width = static_cast<uint32_t>(std::lround(k_cell_aspect * static_cast<float>(height)));
        grid.height = height;
        grid.columns = k_atlas_width / grid.width;
        const size_t rows = (cells + grid.columns - 1) / grid.columns;
        if (rows * height > k_atlas_height) continue;
        grid.rows = static_cast<uint32_t>(rows);
        return grid;
    }
    return {};
}

Result<void> bake_impostors(const Device& device, const Pipelines& pipelines, const SceneMeshes& meshes,
                            GpuScene& scene) {
    auto is_baked = [](const PersonMesh& mesh) {
        return !mesh.strides.empty() && !mesh.lods.empty() && !baked_level(mesh).empty();
    };
    const CellGrid grid =
        cell_grid(static_cast<size_t>(std::count_if(meshes.people.begin(), meshes.people.end(), is_baked)));
    std::vector<ImpostorCell> cells;
    std::vector<JointTransform> poses;
    std::vector<DrawCommand> draws;
    for (size_t i = 0; i < meshes.people.size(); ++i) {
        const PersonMesh& mesh = meshes.people[i];
        scene.people[i].is_thing = mesh.is_thing;
        if (grid.height == 0 || !is_baked(mesh)) continue;
        const std::vector<glm::vec4> boxes = find_boxes(mesh, grid);
        if (boxes.empty()) continue;
        const uint32_t first = static_cast<uint32_t>(cells.size());
        for (const glm::vec4& box : boxes) {
            const uint32_t number = static_cast<uint32_t>(cells.size());
            cells.push_back({box, glm::vec4(number % grid.columns * grid.width,
                                            number / grid.columns * grid.height, grid.width, grid.height)});
        }
        poses.insert(poses.end(), mesh.strides.begin(), mesh.strides.end());
        PersonRanges& person = scene.people[i];
        const MeshRange& range = person.lods[std::min(k_baked_lod, person.lods.size() - 1)];
        draws.push_back({range.index_count, k_person_cells, range.first_index, person.vertex_offset, first});
        person.first_cell = first;
    }
    scene.impostors.pixels = static_cast<float>(grid.height);
    Bake bake;
    Result<void> done =
        make_atlas(device, pipelines, cells, poses, draws, grid, meshes.impostors, scene, bake);
    destroy_buffer(device, bake.poses);
    destroy_buffer(device, bake.draws);
    destroy_image(device, bake.depth);
    if (bake.pool) vkDestroyDescriptorPool(device.handle, bake.pool, nullptr);
    return done;
}

Result<std::vector<uint32_t>> read_impostors(const Device& device, Impostors& impostors) {
    GpuImage& atlas = impostors.atlas;
    std::vector<uint32_t> texels(size_t{atlas.width} * atlas.height);
    Buffer buffer{"impostors for the host"};
    auto read = [&]() -> Result<void> {
        FLANEUR_TRY(make_buffer(device, texels.size() * sizeof(uint32_t), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                MemoryKind::readback, buffer));
        FLANEUR_TRY(run_once(device, [&](VkCommandBuffer commands) {
            image_to(commands, atlas, k_copied_from);
            const VkBufferImageCopy region = whole_of(atlas);
            vkCmdCopyImageToBuffer(commands, atlas.handle, k_copied_from.layout, buffer.handle, 1, &region);
            image_to(commands, atlas, k_sampled);
        }));
        std::memcpy(texels.data(), buffer.mapped, texels.size() * sizeof(uint32_t));
        return {};
    };
    const Result<void> done = read();
    destroy_buffer(device, buffer);
    if (!done) return done.error();
    return texels;
}

uint64_t impostors_key(const Device& device, std::span<const PersonMesh> people) {
    uint64_t key = 0;
    auto add = [&key](const auto& values) {
        const auto bytes = std::as_bytes(std::span(values));
        key = hash_bytes(key, bytes.data(), bytes.size());
    };
    add(k_spirv_impostor_bake_vert);
    add(k_spirv_impostor_bake_frag);
    add(device.properties.deviceName);
    add(std::array{device.properties.driverVersion, device.properties.apiVersion,
                   device.properties.vendorID});
    for (const PersonMesh& mesh : people) {
        add(mesh.vertices);
        add(mesh.strides);
        if (!mesh.lods.empty()) add(baked_level(mesh));
        for (const RgbaImage& texture : mesh.textures) add(texture.rgba);
    }
    return key;
}

void destroy_impostors(const Device& device, Impostors& impostors) {
    destroy_image(device, impostors.atlas);
    destroy_buffer(device, impostors.cells);
    impostors = {};
}

}  // namespace flaneur
