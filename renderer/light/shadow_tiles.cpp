#include "renderer/light/shadow_tiles.h"

#include <algorithm>

namespace flaneur {
namespace {

// Impostors lean out of their bodies' spheres a little; and what is drawn is rounded to texels.
constexpr float k_lean = 1.35f, k_texels = 2;

uint32_t tiles_along(uint32_t resolution) { return (resolution + k_tile_texels - 1) / k_tile_texels; }

}  // namespace

ShadowTiles tiles_below(const ShadowBox& box, uint32_t resolution, std::span<const glm::vec4> spheres) {
    const uint32_t along = tiles_along(resolution);
    ShadowTiles tiles(size_t{along} * along, 0);
    const float scale = static_cast<float>(resolution), last = static_cast<float>(along - 1);
    auto tile_of = [&](float texel) {
        return static_cast<uint32_t>(std::clamp(texel / static_cast<float>(k_tile_texels), 0.0f, last));
    };
    for (const glm::vec4& sphere : spheres) {
        const glm::vec3 middle = glm::vec3(box.map_from_world * glm::vec4(glm::vec3(sphere), 1)) * scale;
        const float reach = sphere.w * k_lean / box.size * scale + k_texels;
        if (middle.x + reach < 0 || middle.y + reach < 0 || middle.x - reach > scale ||
            middle.y - reach > scale)
            continue;
        for (uint32_t y = tile_of(middle.y - reach); y <= tile_of(middle.y + reach); ++y)
            for (uint32_t x = tile_of(middle.x - reach); x <= tile_of(middle.x + reach); ++x)
                tiles[size_t{y} * along + x] = 1;
    }
    return tiles;
}

std::vector<TexelRect> changed_texels(const ShadowTiles& before, const ShadowTiles& now,
                                      uint32_t resolution) {
    if (now.empty()) return {};
    const uint32_t along = tiles_along(resolution);
    std::vector<TexelRect> rects;
    auto is_touched = [&](size_t tile) { return now[tile] != 0 || (!before.empty() && before[tile] != 0); };
    for (uint32_t y = 0; y < along; ++y)
        for (uint32_t x = 0; x < along; ++x) {
            const uint32_t first = x;
            while (x < along && is_touched(size_t{y} * along + x)) ++x;
            if (x == first) continue;
            const uint32_t left = first * k_tile_texels, top = y * k_tile_texels;
            rects.push_back({left, top, std::min(x * k_tile_texels, resolution) - left,
                             std::min(top + k_tile_texels, resolution) - top});
        }
    return rects;
}

}  // namespace flaneur
