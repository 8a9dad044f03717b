// Simple pieces of a city, to begin with and to test with. Each is appended to a mesh.
#pragma once

#include <array>

#include "renderer/scene.h"

namespace flaneur {

// 0xrrggbb as vertices have it.
constexpr uint32_t vertex_colour(uint32_t rrggbb) {
    return 0xff000000u | (rrggbb & 0xff) << 16 | (rrggbb & 0xff00) | rrggbb >> 16;
}

// A flat quad whose corners run counter-clockwise seen from its front. `material` is one of k_material_*;
// `uv` and `extra` as CityVertex has them.
void add_quad(CityMesh& mesh, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& uv,
              uint32_t material, uint32_t colour, uint16_t extra = 0, uint32_t house = 0);

// Level ground between two corners (x, z), at height y.
void add_ground(CityMesh& mesh, glm::vec2 low, glm::vec2 high, float y, uint32_t material, uint32_t colour);

// An upright wall over a level foot, which runs from left to right seen from its front.
void add_wall(CityMesh& mesh, glm::vec3 left, glm::vec3 right, float height, uint32_t material,
              uint32_t colour, uint16_t extra = 0, uint32_t house = 0);

// Four walls between two corners (x, z) over a foot at height y, and what covers them: a house, if the walls
// are of k_material_facade and the cover of k_material_roof.
struct BlockSide {
    uint32_t material, colour;
    uint16_t extra = 0;
    uint32_t house = 0;
};
void add_block(CityMesh& mesh, glm::vec2 low, glm::vec2 high, float y, float height, const BlockSide& walls,
               const BlockSide& top);

}  // namespace flaneur
