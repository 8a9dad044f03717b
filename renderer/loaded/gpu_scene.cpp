#include "renderer/loaded/gpu_scene.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <span>

#define STB_IMAGE_RESIZE_STATIC
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>

#include "renderer/device/check.h"

namespace flaneur {
namespace {

constexpr uint32_t k_largest_texture = 1024;                 // edge of a layer, texels
constexpr uint64_t k_texture_memory = 256ull * 1024 * 1024;  // bytes of level 0
constexpr size_t k_most_people = 4096;                       // kinds

Result<void> check_person(const PersonMesh& mesh, size_t number) {
    const std::string name = "Person mesh " + std::to_string(number);
    for (const auto& lod : mesh.lods) {
        if (lod.size() % 3 != 0)
            return Error{name + " has a level of detail with no whole number of triangles."};
        for (uint32_t index : lod)
            if (index >= mesh.vertices.size())
                return Error{name + " refers to vertex " + std::to_string(index) + " but has only " +
                             std::to_string(mesh.vertices.size()) + "."};
    }
    for (const PersonVertex& vertex : mesh.vertices) {
        for (int k = 0; k < 4; ++k)
            if (vertex.joints[k] >= k_palette_joints)
                return Error{name + " refers to joint " + std::to_string(vertex.joints[k]) + " of " +
                             std::to_string(k_palette_joints) + "."};
        if (vertex.weights[0] + vertex.weights[1] + vertex.weights[2] + vertex.weights[3] != 255)
            return Error{name + " has a vertex whose weights do not sum to 255."};
        if (vertex.texture != ~0u && vertex.texture >= mesh.textures.size())
            return Error{name + " refers to texture " + std::to_string(vertex.texture) + " but has only " +
                         std::to_string(mesh.textures.size()) + "."};
        if (vertex.normal[3] < 0 || vertex.normal[3] >= k_tints)
            return Error{name + " refers to tint " + std::to_string(vertex.normal[3]) + " of " +
                         std::to_string(k_tints) + "."};
    }
    if (!mesh.strides.empty() && mesh.strides.size() != k_stride_poses * k_palette_joints)
        return Error{name + " has " + std::to_string(mesh.strides.size()) +
                     " transforms to bake impostors from; " +
                     std::to_string(k_stride_poses * k_palette_joints) + " or none are needed."};
    for (const RgbaImage& texture : mesh.textures) FLANEUR_TRY(check_texture(texture, name));
    return {};
}

// The middle of the lowest 2 cm of what a foot moves.
glm::vec3 find_sole(const PersonMesh& mesh, int foot) {
    auto is_of_foot = [&](const PersonVertex& vertex) {
        return vertex.joints[0] == foot || vertex.joints[0] == foot + 1;
    };
    float low = std::numeric_limits<float>::max();
    for (const PersonVertex& vertex : mesh.vertices)
        if (is_of_foot(vertex)) low = std::min(low, vertex.position.y);
    glm::vec3 sum(0);
    float count = 0;
    for (const PersonVertex& vertex : mesh.vertices)
        if (is_of_foot(vertex) && vertex.position.y < low + 0.02f) sum += vertex.position, ++count;
    return count > 0 ? glm::vec3(sum.x / count, low, sum.z / count) : glm::vec3(0);
}

// All at one size, after a white layer. `whose` names them in sentences.
Result<void> upload_textures(const Device& device, std::span<const RgbaImage* const> textures,
                             const std::string& whose, GpuImage& image) {
    uint32_t edge = 1;
    const auto layers = static_cast<uint32_t>(textures.size()) + 1;
    for (const RgbaImage* texture : textures) edge = std::max({edge, texture->width, texture->height});
    const uint32_t most = device.properties.limits.maxImageArrayLayers;
    if (layers > most)
        return Error{whose + " " + std::to_string(layers - 1) + " textures; the device takes " +
                     std::to_string(most - 1) + "."};
    edge = std::min(std::bit_ceil(edge), k_largest_texture);
    while (edge > 64 && uint64_t{edge} * edge * 4 * layers > k_texture_memory) edge /= 2;

    const size_t layer_bytes = size_t{edge} * edge * 4;
    std::vector<std::byte> texels(layer_bytes * layers, std::byte{255});
    size_t at = layer_bytes;
    for (const RgbaImage* texture : textures) {
        auto* out = reinterpret_cast<unsigned char*>(texels.data() + at);
        const int size = static_cast<int>(edge);
        if (!stbir_resize_uint8_srgb(texture->rgba.data(), static_cast<int>(texture->width),
                                     static_cast<int>(texture->height), 0, out, size, size, 0, 4, 3, 0))
            return Error{"There is not enough memory to resize a texture."};
        at += layer_bytes;
    }
    ImageShape shape;
    shape.format = VK_FORMAT_R8G8B8A8_SRGB;
    shape.width = shape.height = edge;
    shape.layers = layers;
    shape.levels = static_cast<uint32_t>(std::bit_width(edge));
    shape.usage =
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    shape.is_array = true;
    FLANEUR_TRY(make_image(device, shape, image));
    return upload_layers(device, texels, image);
}

}  // namespace

Result<void> make_lamps(const Device& device, const LampMap& map, GpuScene& scene) {
    const size_t count = size_t{map.width} * map.height;
    if (map.texels.size() != count || !(map.texel > 0) ||
        std::max(map.width, map.height) > device.properties.limits.maxImageDimension2D)
        return Error{"The lamp map's size is too large, or does not agree with its texels."};
    std::vector<uint16_t> halves(4 * std::max<size_t>(count, 1));
    for (size_t i = 0; i < count; ++i)
        for (int c = 0; c < 4; ++c)
            halves[4 * i + static_cast<size_t>(c)] = glm::packHalf1x16(map.texels[i][c]);
    scene.lamp_texels.resize(count);
    for (size_t i = 0; i < count; ++i)
        for (int c = 0; c < 4; ++c)
            scene.lamp_texels[i][c] = glm::unpackHalf1x16(halves[4 * i + static_cast<size_t>(c)]);
    ImageShape shape{.format = VK_FORMAT_R16G16B16A16_SFLOAT};
    if (count > 0) {
        shape.width = map.width, shape.height = map.height;
        scene.lamp_map = {glm::vec2(1 / map.texel), -map.low / map.texel};
    }
    shape.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    FLANEUR_TRY(make_image(device, shape, scene.lamps));
    return upload_layers(device, std::as_bytes(std::span(halves)), scene.lamps);
}

Result<void> make_city(const Device& device, const PreparedCity& city, GpuScene& scene) {
    scene.chunks = city.chunks;
    scene.walls = city.walls;
    scene.wall_groups = city.wall_groups;
    scene.ground_low = city.ground_low;
    FLANEUR_TRY(upload_buffer(device, std::as_bytes(std::span(city.vertices)),
                              VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, scene.city_vertices));
    return upload_buffer(device, std::as_bytes(std::span(city.indices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                         scene.city_indices);
}

void swap_cities(GpuScene& a, GpuScene& b) {
    std::swap(a.city_vertices, b.city_vertices);
    std::swap(a.city_indices, b.city_indices);
    std::swap(a.chunks, b.chunks);
    std::swap(a.walls, b.walls);
    std::swap(a.wall_groups, b.wall_groups);
    std::swap(a.ground_low, b.ground_low);
}

void swap_lamps(GpuScene& a, GpuScene& b) {
    std::swap(a.lamps, b.lamps);
    std::swap(a.lamp_texels, b.lamp_texels);
    std::swap(a.lamp_map, b.lamp_map);
}

Result<void> make_scene(const Device& device, const Pipelines& pipelines, const SceneMeshes& meshes,
                        GpuScene& scene) {
    Result<PreparedCity> city = prepare_city(meshes.city);
    if (!city) return city.error();
    if (meshes.people.size() > k_most_people)
        return Error{"The scene has " + std::to_string(meshes.people.size()) + " kinds of people; at most " +
                     std::to_string(k_most_people) + " can be drawn."};
    std::vector<PersonVertex> vertices;
    std::vector<uint32_t> indices;
    uint32_t first_layer = 1;
    for (size_t number = 0; number < meshes.people.size(); ++number) {
        const PersonMesh& mesh = meshes.people[number];
        FLANEUR_TRY(check_person(mesh, number));
        PersonRanges ranges;
        ranges.vertex_offset = static_cast<int32_t>(vertices.size());
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        for (size_t i = vertices.size() - mesh.vertices.size(); i < vertices.size(); ++i)
            vertices[i].texture = vertices[i].texture == ~0u ? 0 : vertices[i].texture + first_layer;
        first_layer += static_cast<uint32_t>(mesh.textures.size());
        for (size_t lod = 0; lod < std::min<size_t>(mesh.lods.size(), k_max_lods); ++lod) {
            if (lod > 0 && mesh.lods[lod] == mesh.lods[lod - 1]) {  // that one stands in
                const MeshRange same = ranges.lods.back();
                ranges.lods.push_back(same);
                continue;
            }
            ranges.lods.push_back(
                {static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(mesh.lods[lod].size())});
            if (!mesh.lods[lod].empty())
                scene.skin_meshes.push_back(
                    make_skin_mesh(std::span(vertices).subspan(vertices.size() - mesh.vertices.size()),
                                   mesh.lods[lod], ranges.lods.back().first_index));
            indices.insert(indices.end(), mesh.lods[lod].begin(), mesh.lods[lod].end());
        }
        ranges.soles[0] = find_sole(mesh, k_left_foot);
        ranges.soles[1] = find_sole(mesh, k_right_foot);
        scene.people.push_back(std::move(ranges));
    }
    if (std::max(indices.size(), city->indices.size()) > 0xffffffffu || vertices.size() > 0x7fffffffu)
        return Error{"The scene has too many triangles for one index buffer."};
    FLANEUR_TRY(make_city(device, *city, scene));
    FLANEUR_TRY(upload_buffer(device, std::as_bytes(std::span(vertices)), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                              scene.person_vertices));
    FLANEUR_TRY(upload_buffer(device, std::as_bytes(std::span(indices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                              scene.person_indices));
    std::vector<const RgbaImage*> people, scenery;
    for (const PersonMesh& mesh : meshes.people)
        for (const RgbaImage& texture : mesh.textures) people.push_back(&texture);
    for (const RgbaImage& texture : meshes.city.textures) scenery.push_back(&texture);
    scene.is_textured = !people.empty();
    FLANEUR_TRY(upload_textures(device, people, "The people have", scene.textures));
    FLANEUR_TRY(upload_textures(device, scenery, "The city has", scene.scenery));
    FLANEUR_TRY(make_lamps(device, meshes.lamps, scene));
    return bake_impostors(device, pipelines, meshes, scene);
}

void destroy_scene(const Device& device, GpuScene& scene) {
    for (Buffer* buffer :
         {&scene.city_vertices, &scene.city_indices, &scene.person_vertices, &scene.person_indices})
        destroy_buffer(device, *buffer);
    destroy_image(device, scene.textures);
    destroy_image(device, scene.scenery);
    destroy_image(device, scene.lamps);
    destroy_impostors(device, scene.impostors);
    scene = {};
}

}  // namespace flaneur
