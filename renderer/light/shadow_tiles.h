// Which parts of the near shadow map people's shadows lie on, so that each frame only these are made anew.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/light/shadow_box.h"

namespace flaneur {

inline constexpr uint32_t k_tile_texels = 64;  // along each edge of a tile

// One a tile of the map, rows: whether a shadow may lie on it. Empty: on none.
using ShadowTiles = std::vector<uint8_t>;
// Those that bodies within these spheres (centre, radius) may throw shadows on.
ShadowTiles tiles_below(const ShadowBox& box, uint32_t resolution, std::span<const glm::vec4> spheres);

struct TexelRect {
    uint32_t x = 0, y = 0, width = 0, height = 0;
};
// What covers the tiles that either has.
std::vector<TexelRect> changed_texels(const ShadowTiles& before, const ShadowTiles& now, uint32_t resolution);

}  // namespace flaneur
