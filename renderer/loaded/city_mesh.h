// A city's triangles as the renderer keeps them: facades fitted with whole windows, triangles gathered in
// chunks.
#pragma once

#include <array>
#include <string>

#include "renderer/scene.h"
#include "renderer/visible/cull.h"
#include "sim/base/result.h"

namespace flaneur {

// What is drawn by one pipeline and culled together: roofs, which show over the houses before them, apart
// from what stands below.
enum class CityClass { ground, facade, roof, detail, prop, scenery, shade };
inline constexpr int k_city_classes = 7;
CityClass city_class(uint32_t material);

struct PreparedCity {
    // As handed in, but facades' u runs in bays of k_bay and v in storeys, a whole number of each on every
    // wall, and normal[3] holds how many storeys there are (0: a wall too small for windows).
    std::vector<CityVertex> vertices;
    std::vector<uint32_t> indices;
    std::array<std::vector<CityChunk>, k_city_classes> chunks;
    std::vector<Wall> walls;  // what is large enough to hide something, gathered by chunks
    std::vector<WallGroup> wall_groups;
    float ground_low = 0;  // lowest vertex, metres
};

// Refuses a texture whose size and texels disagree; `whose` names it.
Result<void> check_texture(const RgbaImage& texture, const std::string& whose);

// Refuses triangles that refer to vertices or textures that are not there.
Result<PreparedCity> prepare_city(const CityMesh& mesh);

}  // namespace flaneur
