// The uniform grids of a Ground: filling them, and finding the cells that matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/base/vec.h"
#include "sim/ground/ground.h"

namespace flaneur {

// Items reach this far beyond their outline when cells are filled, so that queries may forgive rounding.
// Metres.
inline constexpr float k_grid_margin = 2e-3f;

// An empty grid over [low, high] with cells of `cell` metres, larger where it takes more than four million.
inline Grid make_grid(Vec2 low, Vec2 high, float cell) {
    constexpr float k_most_cells = 4e6f;
    Vec2 size = high - low;
    Grid grid;
    grid.origin = low;
    grid.cell = std::max(cell, std::sqrt(std::max(0.0f, size.x * size.z) / k_most_cells));
    grid.width = static_cast<int>(size.x / grid.cell) + 1;
    grid.height = static_cast<int>(size.z / grid.cell) + 1;
    grid.first.assign(static_cast<size_t>(grid.width) * grid.height + 1, 0);
    return grid;
}

// The column (or row) of a coordinate, kept inside [0, count). NaN gives 0.
inline int grid_column(float offset, float cell, int count) {
    float column = offset / cell;
    if (!(column > 0)) return 0;
    return column < static_cast<float>(count) ? static_cast<int>(column) : count - 1;
}

// The cells that a box touches, bounds included.
struct CellRange {
    int x0, x1, z0, z1;
};
inline CellRange cells_of_box(const Grid& grid, Vec2 low, Vec2 high) {
    return {grid_column(low.x - grid.origin.x, grid.cell, grid.width),
            grid_column(high.x - grid.origin.x, grid.cell, grid.width),
            grid_column(low.z - grid.origin.z, grid.cell, grid.height),
            grid_column(high.z - grid.origin.z, grid.cell, grid.height)};
}

// Calls visit(item) for what lies in the cells that a box touches, once for each of these that it lies in.
template <class Visit>
void for_items_of_box(const Grid& grid, Vec2 low, Vec2 high, Visit visit) {
    const CellRange r = cells_of_box(grid, low, high);
    for (int z = r.z0; z <= r.z1; ++z) {
        const size_t row =
            static_cast<size_t>(z) * static_cast<size_t>(grid.width);  // cells lie side by side
        const uint32_t end = grid.first[row + static_cast<size_t>(r.x1) + 1];
        for (uint32_t k = grid.first[row + static_cast<size_t>(r.x0)]; k < end; ++k) visit(grid.items[k]);
    }
}

// Lists `count` items by cell, in rising order. for_cells(item, visit) calls visit(cell) for each cell of the
// item.
template <class ForCells>
void fill_grid(Grid& grid, uint32_t count, ForCells for_cells) {
    for (uint32_t i = 0; i < count; ++i) for_cells(i, [&](size_t cell) { ++grid.first[cell + 1]; });
    for (size_t c = 1; c < grid.first.size(); ++c) grid.first[c] += grid.first[c - 1];
    grid.items.resize(grid.first.back());
    std::vector<uint32_t> next(grid.first.begin(), grid.first.end() - 1);
    for (uint32_t i = 0; i < count; ++i) for_cells(i, [&](size_t cell) { grid.items[next[cell]++] = i; });
}

// Visits the cells within the margin of segment a-b.
template <class Visit>
void for_cells_of_segment(const Grid& grid, Vec2 a, Vec2 b, Visit visit) {
    Vec2 margin{k_grid_margin, k_grid_margin};
    Vec2 low{std::min(a.x, b.x), std::min(a.z, b.z)}, high{std::max(a.x, b.x), std::max(a.z, b.z)};
    CellRange r = cells_of_box(grid, low - margin, high + margin);
    Vec2 d = b - a;
    // The cell's half diagonal as seen square to the segment: farther centres are off it.
    float reach = (grid.cell * 0.5f + 2 * k_grid_margin) * (std::fabs(d.x) + std::fabs(d.z));
    for (int z = r.z0; z <= r.z1; ++z) {
        for (int x = r.x0; x <= r.x1; ++x) {
            Vec2 centre =
                grid.origin + Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f} * grid.cell;
            if (std::fabs(cross(d, centre - a)) <= reach) visit(static_cast<size_t>(z) * grid.width + x);
        }
    }
}

// Visits the cells within the margin of a triangle that is wound counter-clockwise seen from above.
template <class Visit>
void for_cells_of_triangle(const Grid& grid, Vec2 a, Vec2 b, Vec2 c, Visit visit) {
    Vec2 margin{k_grid_margin, k_grid_margin};
    Vec2 low{std::min({a.x, b.x, c.x}), std::min({a.z, b.z, c.z})};
    Vec2 high{std::max({a.x, b.x, c.x}), std::max({a.z, b.z, c.z})};
    CellRange r = cells_of_box(grid, low - margin, high + margin);
    float half = grid.cell * 0.5f + 2 * k_grid_margin;
    auto outside = [&](Vec2 p, Vec2 q, Vec2 centre) {
        Vec2 d = q - p;
        return cross(d, centre - p) > half * (std::fabs(d.x) + std::fabs(d.z));
    };
    for (int z = r.z0; z <= r.z1; ++z) {
        for (int x = r.x0; x <= r.x1; ++x) {
            Vec2 centre =
                grid.origin + Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f} * grid.cell;
            if (outside(a, b, centre) || outside(b, c, centre) || outside(c, a, centre)) continue;
            visit(static_cast<size_t>(z) * grid.width + x);
        }
    }
}

// Visits the cells along origin + t * direction, 0 <= t <= reach, from near to far, until visit(cell, t_exit)
// says false. t_exit is where the ray leaves the cell.
template <class Visit>
void for_cells_of_ray(const Grid& grid, Vec2 origin, Vec2 direction, float reach, Visit visit) {
    Vec2 o = origin - grid.origin;
    float span_x = static_cast<float>(grid.width) * grid.cell,
          span_z = static_cast<float>(grid.height) * grid.cell;
    float enter = 0, leave = reach;
    auto clip = [&](float position, float speed, float span) {
        if (std::fabs(speed) < 1e-9f) {
            if (!(position >= 0 && position <= span)) leave = -1;
            return;
        }
        float t0 = -position / speed, t1 = (span - position) / speed;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    };
    clip(o.x, direction.x, span_x);
    clip(o.z, direction.z, span_z);
    if (!(enter <= leave)) return;

    constexpr float k_never = 1e30f;
    int x = grid_column(o.x + direction.x * enter, grid.cell, grid.width);
    int z = grid_column(o.z + direction.z * enter, grid.cell, grid.height);
    int step_x = direction.x > 0 ? 1 : -1, step_z = direction.z > 0 ? 1 : -1;
    while (x >= 0 && x < grid.width && z >= 0 && z < grid.height) {
        float edge_x = static_cast<float>(x + (step_x > 0)) * grid.cell;
        float edge_z = static_cast<float>(z + (step_z > 0)) * grid.cell;
        float tx = std::fabs(direction.x) < 1e-9f ? k_never : (edge_x - o.x) / direction.x;
        float tz = std::fabs(direction.z) < 1e-9f ? k_never : (edge_z - o.z) / direction.z;
        float exit = std::min(tx, tz);
        if (!visit(static_cast<size_t>(z) * grid.width + x, exit) || exit > leave) return;
        if (tx <= tz) {
            x += step_x;
        } else {
            z += step_z;
        }
    }
}

}  // namespace flaneur
