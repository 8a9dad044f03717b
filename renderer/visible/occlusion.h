// What houses hide: a coarse picture of how near the walls are, drawn on the CPU before anything else, and
// the question whether a box lies wholly behind them. What it says is hidden would not be seen if it were
// drawn, unless through a gap between walls that is narrower than a cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/view.h"

namespace flaneur {

// A flat, convex, opaque piece of the city, counter-clockwise from outside; a triangle has its last corner
// twice.
struct Wall {
    glm::vec3 corners[4];
};

// Walls that stand together.
struct WallGroup {
    glm::vec3 low, high;
    uint32_t first = 0, count = 0;
};

struct OcclusionMap {
    int width = 0, height = 0;  // cells over the picture; rows from the top
    std::vector<float>
        nearness;  // of each cell: 1 / metres ahead of what hides all of it, 0 where nothing does
    std::vector<float> scratch;
};

inline constexpr int k_occlusion_width = 320;  // cells

// Draws the walls that the view sees from outside.
void draw_walls(std::span<const WallGroup> groups, std::span<const Wall> walls, const View& view,
                OcclusionMap& map);

// Whether nothing of a box can be seen. A map without cells hides nothing.
bool is_hidden(const OcclusionMap& map, const View& view, glm::vec3 low, glm::vec3 high);

}  // namespace flaneur
