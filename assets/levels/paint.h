// Colours laid on a coarse level that has lost the seams of its textures.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/levels/surface.h"

namespace flaneur {

// Each of the triangles, which lie over the surface, gets vertices of its own, appended to `c`, without
// texture, whose colours are the means of what the surface shows nearest to each of its corners. Other
// colours, beyond a seam, are not mixed in; what can be seen through keeps its texture.
std::vector<uint32_t> painted(Character& c, const LevelSurface& surface, const DrawnTriangles& triangles);

}  // namespace flaneur
