#include "renderer/loaded/city_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderer/device/check.h"

namespace flaneur {
namespace {

constexpr int k_grid = 32;            // chunks along each side of the city, for each class
constexpr float k_least_cell = 15;    // metres
constexpr float k_least_wall = 1.6f;  // narrower ones have no windows, metres
constexpr float k_least_hiding = 6;   // square metres: smaller faces hide too little to be asked
constexpr float k_flat = 0.02f;       // metres that a corner may lie beside the others' plane

struct Extent {
    float low_u = std::numeric_limits<float>::max(), high_u = std::numeric_limits<float>::lowest();
    float low_v = low_u, high_v = high_u;
};

// Vertices joined by triangles are one wall: `parent` leads from each to the wall's first vertex.
uint32_t first_of(std::vector<uint32_t>& parent, uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

bool is_facade(const CityVertex& vertex) { return vertex.material == k_material_facade; }

void fit_windows(PreparedCity& city) {
    std::vector<uint32_t> parent(city.vertices.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (size_t i = 0; i + 2 < city.indices.size(); i += 3)
        for (size_t k = 1; k < 3; ++k) {
            const uint32_t a = first_of(parent, city.indices[i]), b = first_of(parent, city.indices[i + k]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    std::vector<Extent> walls(city.vertices.size());
    for (uint32_t i = 0; i < city.vertices.size(); ++i) {
        if (!is_facade(city.vertices[i])) continue;
        Extent& wall = walls[first_of(parent, i)];
        const glm::vec2 uv = city.vertices[i].uv;
        wall.low_u = std::min(wall.low_u, uv.x), wall.high_u = std::max(wall.high_u, uv.x);
        wall.low_v = std::min(wall.low_v, uv.y), wall.high_v = std::max(wall.high_v, uv.y);
    }
    for (uint32_t i = 0; i < city.vertices.size(); ++i) {
        CityVertex& vertex = city.vertices[i];
        if (!is_facade(vertex)) continue;
        const Extent& wall = walls[first_of(parent, i)];
        const float width = wall.high_u - wall.low_u, height = wall.high_v;
        const uint32_t said = vertex.extra & k_storey_mask;
        const float storey = std::max(static_cast<float>(said) * k_storey_unit, 2.0f);
        vertex.normal[3] = 0;
        if (said == 0) {
            vertex.uv.y /= storey;
            continue;
        }
        if (!(width >= k_least_wall && height >= storey * 0.8f && width < 1e5f && height < 1e4f)) continue;
        const float bays = std::max(std::round(width / k_bay), 1.0f);
        const float storeys = std::clamp(std::round(height / storey), 1.0f, 127.0f);
        vertex.uv.x = (vertex.uv.x - wall.low_u) * (bays * k_bay / width);
        vertex.uv.y *= storeys / height;
        vertex.normal[3] = static_cast<int8_t>(storeys);
    }
}

constexpr size_t k_cells = k_grid * k_grid;
constexpr size_t k_reaches = 3;  // SeenFrom: what is drawn from near begins each chunk, what from far ends it

// The bounds of what a bucket's triangles touch.
void widen(CityChunk& chunk, const PreparedCity& city, MeshRange range) {
    for (uint32_t i = 0; i < range.index_count; ++i) {
        const glm::vec3 position = city.vertices[city.indices[range.first_index + i]].position;
        chunk.low = glm::min(chunk.low, position);
        chunk.high = glm::max(chunk.high, position);
    }
}

// Sorts the triangles by (class, cell, from where they are seen), keeping their order within each.
void gather_chunks(PreparedCity& city, const CityMesh& mesh) {
    const std::vector<uint32_t>& indices = mesh.indices;
    const size_t triangle_count = indices.size() / 3;
    glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (uint32_t index : indices) {
        low = glm::min(low, city.vertices[index].position);
        high = glm::max(high, city.vertices[index].position);
    }
    city.ground_low = triangle_count ? low.y : 0;
    const float cell = std::max(std::max(high.x - low.x, high.z - low.z) / k_grid, k_least_cell);
    auto place = [&](float value, float from) {
        return static_cast<size_t>(std::clamp((value - from) / cell, 0.0f, k_grid - 1.0f));
    };
    constexpr size_t bucket_count = k_city_classes * k_cells * k_reaches;
    std::vector<uint32_t> bucket_of(triangle_count);
    std::vector<uint32_t> firsts(bucket_count + 1, 0);
    for (size_t t = 0; t < triangle_count; ++t) {
        const CityVertex& a = city.vertices[indices[3 * t]];
        const CityVertex& b = city.vertices[indices[3 * t + 1]];
        const CityVertex& c = city.vertices[indices[3 * t + 2]];
        const glm::vec3 centre = (a.position + b.position + c.position) / 3.0f;
        const size_t kind = static_cast<size_t>(city_class(a.material));
        const size_t chunk = kind * k_cells + place(centre.z, low.z) * k_grid + place(centre.x, low.x);
        const SeenFrom reach = mesh.seen_from.empty() ? SeenFrom::anywhere : mesh.seen_from[t];
        bucket_of[t] = static_cast<uint32_t>(chunk * k_reaches + static_cast<size_t>(reach));
        ++firsts[bucket_of[t] + 1];
    }
    std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
    std::vector<uint32_t> next(firsts.begin(), firsts.end() - 1);
    city.indices.resize(triangle_count * 3);
    for (size_t t = 0; t < triangle_count; ++t) {
        const size_t at = 3 * size_t{next[bucket_of[t]]++};
        for (size_t k = 0; k < 3; ++k) city.indices[at + k] = indices[3 * t + k];
    }
    for (size_t bucket = 0; bucket < bucket_count; bucket += k_reaches) {
        auto range = [&](size_t begin, size_t end) {
            return MeshRange{3 * firsts[bucket + begin], 3 * (firsts[bucket + end] - firsts[bucket + begin])};
        };
        CityChunk chunk{glm::vec3(std::numeric_limits<float>::max()),
                        glm::vec3(std::numeric_limits<float>::lowest()), range(0, 2), range(1, k_reaches)};
        if (range(0, k_reaches).index_count == 0) continue;
        widen(chunk, city, range(0, k_reaches));
        city.chunks[bucket / (k_cells * k_reaches)].push_back(chunk);
    }
}

// Whether a, b, c, d lie in a plane and turn one way.
bool is_convex(const Wall& wall) {
    const glm::vec3 normal =
        glm::normalize(glm::cross(wall.corners[1] - wall.corners[0], wall.corners[2] - wall.corners[0]));
    if (!(std::fabs(glm::dot(normal, wall.corners[3] - wall.corners[0])) < k_flat)) return false;
    for (size_t k = 0; k < 4; ++k) {
        const glm::vec3 &a = wall.corners[k], &b = wall.corners[(k + 1) % 4], &c = wall.corners[(k + 2) % 4];
        if (!(glm::dot(glm::cross(b - a, c - b), normal) > 0)) return false;
    }
    return true;
}

// Walls and roofs; two triangles that follow one another as halves of a quad are one.
void gather_walls(PreparedCity& city) {
    auto corner = [&](size_t index) { return city.vertices[city.indices[index]].position; };
    for (CityClass kind : {CityClass::facade, CityClass::roof, CityClass::detail, CityClass::prop})
        for (const CityChunk& chunk : city.chunks[static_cast<size_t>(kind)]) {
            WallGroup group{chunk.low, chunk.high, static_cast<uint32_t>(city.walls.size())};
            const size_t end = chunk.near.first_index + chunk.near.index_count;
            for (size_t i = chunk.near.first_index; i < end; i += 3) {
                Wall wall{{corner(i), corner(i + 1), corner(i + 2), corner(i + 2)}};
                float twice_area = glm::length(
                    glm::cross(wall.corners[1] - wall.corners[0], wall.corners[2] - wall.corners[0]));
                if (!(twice_area > 0)) continue;
                if (i + 3 < end && corner(i + 3) == wall.corners[0] && corner(i + 4) == wall.corners[2]) {
                    wall.corners[3] = corner(i + 5);
                    if (is_convex(wall))
                        twice_area *= 2, i += 3;
                    else
                        wall.corners[3] = wall.corners[2];
                }
                if (twice_area >= 2 * k_least_hiding) city.walls.push_back(wall);
            }
            group.count = static_cast<uint32_t>(city.walls.size()) - group.first;
            if (group.count > 0) city.wall_groups.push_back(group);
        }
}

}  // namespace

CityClass city_class(uint32_t material) {
    if (material == k_material_facade) return CityClass::facade;
    if (material == k_material_roof) return CityClass::roof;
    if (material == k_material_scenery) return CityClass::scenery;
    if (material == k_material_shade) return CityClass::shade;
    if (material >= k_material_leaves) return CityClass::prop;
    return material < k_material_facade && material != k_material_steps ? CityClass::ground
                                                                        : CityClass::detail;
}

Result<void> check_texture(const RgbaImage& texture, const std::string& whose) {
    if (texture.width == 0 || texture.height == 0 ||
        texture.rgba.size() != size_t{4} * texture.width * texture.height)
        return Error{whose + " has a texture whose size does not agree with its texels."};
    return {};
}

Result<PreparedCity> prepare_city(const CityMesh& mesh) {
    if (mesh.indices.size() % 3 != 0)
        return Error{"The city's mesh has " + std::to_string(mesh.indices.size()) +
                     " indices, which is no whole number of triangles."};
    if (!mesh.seen_from.empty() && mesh.seen_from.size() != mesh.indices.size() / 3)
        return Error{"The city's mesh says of " + std::to_string(mesh.seen_from.size()) + " of its " +
                     std::to_string(mesh.indices.size() / 3) + " triangles from where they are seen."};
    for (uint32_t index : mesh.indices)
        if (index >= mesh.vertices.size())
            return Error{"The city's mesh refers to vertex " + std::to_string(index) + " but has only " +
                         std::to_string(mesh.vertices.size()) + "."};
    for (const CityVertex& vertex : mesh.vertices)
        if (!(std::isfinite(vertex.position.x) && std::isfinite(vertex.position.y) &&
              std::isfinite(vertex.position.z)))
            return Error{"The city's mesh has a vertex whose place is not a number."};
    for (const CityVertex& vertex : mesh.vertices)
        if (vertex.material == k_material_scenery && vertex.extra > mesh.textures.size())
            return Error{"The city's mesh refers to texture " + std::to_string(vertex.extra - 1) +
                         " but has only " + std::to_string(mesh.textures.size()) + "."};
    for (const RgbaImage& texture : mesh.textures) FLANEUR_TRY(check_texture(texture, "The city's mesh"));
    PreparedCity city;
    city.vertices = mesh.vertices;
    city.indices = mesh.indices;
    fit_windows(city);
    gather_chunks(city, mesh);
    gather_walls(city);
    return city;
}

}  // namespace flaneur
