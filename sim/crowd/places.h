// Walkers in the order of their places, as find_neighbours sorts them. Private to sim/crowd.
#pragma once

#include <cmath>

#include "sim/crowd/crowd.h"

namespace flaneur {

inline constexpr float k_seen_cell = 2;       // metres
inline constexpr float k_other_level = 1.8f;  // metres above or below: not in the way

inline int seen_column(float v) { return static_cast<int>(std::floor(v * (1 / k_seen_cell))); }

// Calls visit(begin, end) for pieces of `sorted` that hold all who are within `reach` of `p` on the ground
// plane, and others. The plane is wrapped onto the grid, so that its size follows the crowd's, not the
// city's: walkers from afar that share a cell are the caller's to sort out.
template <class Visit>
void for_seen_near(const CrowdScratch& s, Vec3 p, float reach, Visit visit) {
    int low_x = seen_column(p.x - reach), high_x = seen_column(p.x + reach);
    int low_z = seen_column(p.z - reach), high_z = seen_column(p.z + reach);
    for (int z = low_z; z <= high_z; ++z) {
        uint32_t row = (static_cast<uint32_t>(z) & (s.cells_z - 1)) * s.cells_x;
        uint32_t a = static_cast<uint32_t>(low_x) & (s.cells_x - 1),
                 b = static_cast<uint32_t>(high_x) & (s.cells_x - 1);
        if (a <= b) {
            visit(s.cell_first[row + a], s.cell_first[row + b + 1]);
        } else {
            visit(s.cell_first[row + a], s.cell_first[row + s.cells_x]);
            visit(s.cell_first[row], s.cell_first[row + b + 1]);
        }
    }
}

// Calls decide(seen) on the workers for each walker that decides this tick, in the order of places, so that
// those who share neighbours and ground find them in the cache.
template <class Decide>
void for_deciders(const Crowd& crowd, Workers& workers, uint32_t tick, Decide decide) {
    auto decide_some = [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k) {
            const Seen& walker = crowd.scratch.sorted[k];
            if ((walker.id ^ tick) % k_decision_ticks == 0) decide(walker);
        }
    };
    parallel_for(workers, crowd.slots.living.size(), 512, decide_some);
}

}  // namespace flaneur
