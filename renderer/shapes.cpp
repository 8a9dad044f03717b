#include "renderer/shapes.h"

#include <cmath>

namespace flaneur {

void add_quad(CityMesh& mesh, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& uv,
              uint32_t material, uint32_t colour, uint16_t extra, uint32_t house) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (size_t i = 0; i < 4; ++i) {
        CityVertex vertex{};
        vertex.position = corners[i];
        vertex.colour = colour;
        vertex.uv = uv[i];
        for (int k = 0; k < 3; ++k) vertex.normal[k] = static_cast<int8_t>(std::lround(normal[k] * 127));
        vertex.material = static_cast<uint16_t>(material);
        vertex.extra = extra;
        vertex.house = house;
        mesh.vertices.push_back(vertex);
    }
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
}

void add_ground(CityMesh& mesh, glm::vec2 low, glm::vec2 high, float y, uint32_t material, uint32_t colour) {
    const glm::vec2 a(low.x, high.y), b(high.x, high.y), c(high.x, low.y), d(low.x, low.y);
    add_quad(mesh, {glm::vec3(a.x, y, a.y), {b.x, y, b.y}, {c.x, y, c.y}, {d.x, y, d.y}}, {a, b, c, d},
             material, colour);
}

void add_wall(CityMesh& mesh, glm::vec3 left, glm::vec3 right, float height, uint32_t material,
              uint32_t colour, uint16_t extra, uint32_t house) {
    const glm::vec3 up(0, height, 0);
    const float length = glm::length(right - left);
    add_quad(mesh, {left, right, right + up, left + up},
             {glm::vec2(0, 0), {length, 0}, {length, height}, {0, height}}, material, colour, extra, house);
}

void add_block(CityMesh& mesh, glm::vec2 low, glm::vec2 high, float y, float height, const BlockSide& walls,
               const BlockSide& top) {
    const std::array<glm::vec3, 4> foot = {
        glm::vec3(low.x, y, high.y), {high.x, y, high.y}, {high.x, y, low.y}, {low.x, y, low.y}};
    for (size_t i = 0; i < 4; ++i)
        add_wall(mesh, foot[i], foot[(i + 1) % 4], height, walls.material, walls.colour, walls.extra,
                 walls.house);
    add_ground(mesh, low, high, y + height, top.material, top.colour);
}

}  // namespace flaneur
