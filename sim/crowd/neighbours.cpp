// Who is near: walkers sorted onto a grid by counting, then the nearest few of each.
#include <algorithm>
#include <cmath>

#include "sim/crowd/crowd.h"
#include "sim/crowd/deciders.h"

namespace flaneur {

static constexpr float k_cell = 2;            // metres
static constexpr float k_other_level = 1.8f;  // metres above or below: not in the way

// The plane is wrapped onto the grid, so that its size follows the crowd's, not the city's. Walkers from afar
// that share a cell are sorted out by distance.
static int column(float v) { return static_cast<int>(std::floor(v * (1 / k_cell))); }

static void sort_by_cell(Crowd& c) {
    std::fill(c.cell_first.begin(), c.cell_first.end(), 0);
    for (uint32_t i = 0; i < c.count; ++i) {
        uint32_t x = static_cast<uint32_t>(column(c.position[i].x)) & (c.cells_x - 1);
        uint32_t z = static_cast<uint32_t>(column(c.position[i].z)) & (c.cells_z - 1);
        c.cell[i] = z * c.cells_x + x;
        ++c.cell_first[c.cell[i] + 1];
    }
    for (size_t k = 1; k < c.cell_first.size(); ++k) c.cell_first[k] += c.cell_first[k - 1];
    // Filled from the back, with the ends as cursors: afterwards each cursor stands at its cell's first
    // walker.
    for (uint32_t i = c.count; i-- > 0;) c.sorted[--c.cell_first[c.cell[i] + 1]] = {c.position[i], i};
    std::rotate(c.cell_first.begin(), c.cell_first.begin() + 1, c.cell_first.end());
    c.cell_first.back() = c.count;
}

static void nearest_walkers(Crowd& c, uint32_t i) {
    Vec3 p = c.position[i];
    float distances[k_neighbours];
    uint32_t* ids = &c.neighbours[size_t{i} * k_neighbours];
    int count = 0;
    float reach = k_neighbour_reach * k_neighbour_reach;
    auto look_at = [&](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const Crowd::Seen& other = c.sorted[k];
            float d = length_squared(on_ground(other.position) - on_ground(p));
            if (d > reach || other.id == i || std::fabs(other.position.y - p.y) > k_other_level) continue;
            int at = count;
            while (at > 0 && (distances[at - 1] > d || (distances[at - 1] == d && ids[at - 1] > other.id)))
                --at;
            if (at == k_neighbours) continue;
            if (count < k_neighbours) ++count;
            for (int m = count - 1; m > at; --m) distances[m] = distances[m - 1], ids[m] = ids[m - 1];
            distances[at] = d;
            ids[at] = other.id;
            if (count == k_neighbours) reach = distances[count - 1];
        }
    };
    int low_x = column(p.x - k_neighbour_reach), high_x = column(p.x + k_neighbour_reach);
    int low_z = column(p.z - k_neighbour_reach), high_z = column(p.z + k_neighbour_reach);
    for (int z = low_z; z <= high_z; ++z) {
        uint32_t row = (static_cast<uint32_t>(z) & (c.cells_z - 1)) * c.cells_x;
        uint32_t a = static_cast<uint32_t>(low_x) & (c.cells_x - 1),
                 b = static_cast<uint32_t>(high_x) & (c.cells_x - 1);
        if (a <= b) {
            look_at(c.cell_first[row + a], c.cell_first[row + b + 1]);
        } else {
            look_at(c.cell_first[row + a], c.cell_first[row + c.cells_x]);
            look_at(c.cell_first[row], c.cell_first[row + b + 1]);
        }
    }
    c.neighbour_count[i] = static_cast<uint8_t>(count);
}

void find_neighbours(Crowd& c, Workers& workers, uint32_t tick) {
    sort_by_cell(c);
    for_deciders(c, workers, tick, [&](uint32_t i) { nearest_walkers(c, i); });
}

}  // namespace flaneur
