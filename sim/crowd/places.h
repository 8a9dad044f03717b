// Walkers in the order of their places, as find_neighbours sorts them. Private to sim/crowd.
#pragma once

#include <cmath>

#include "sim/crowd/crowd.h"

namespace flaneur {

inline constexpr size_t k_sorters = 4;   // who sort side by side, whatever the number of threads
inline constexpr float k_seen_cell = 3;  // metres
// m/s: who is driven, or flees and is afar, and is pushed.
inline constexpr float k_fastest = 4.5f, k_fastest_afar = 3.5f;
inline constexpr float k_other_level = 1.8f;  // metres above or below: not in the way

// Puts everybody in the order of places; `anew`: by where they are now, else by where they were filed last.
void order_places(Crowd& crowd, Workers& workers, bool anew);

inline int seen_column(float v) { return static_cast<int>(std::floor(v * (1 / k_seen_cell))); }

inline Filed filed_at(Vec3 p) {
    return {static_cast<int16_t>(seen_column(p.x)), static_cast<int16_t>(seen_column(p.z))};
}

// The square of the wrapped plane.
inline uint32_t cell_of(const CrowdScratch& s, Filed f) {
    return (static_cast<uint32_t>(f.row) & (s.cells_z - 1)) * s.cells_x +
           (static_cast<uint32_t>(f.column) & (s.cells_x - 1));
}

// Calls visit(begin, end) for pieces of the order that hold all who are within `reach` of `p` on the ground
// plane, and others; the nearest rows of squares first. The plane is wrapped onto the squares, so that their
// number follows the crowd's, not the city's: walkers from afar that share one are the caller's to sort out.
template <class Visit>
void for_seen_near(const CrowdScratch& s, Vec3 p, float reach, Visit visit) {
    const float far = reach + s.strays;
    const int low_z = seen_column(p.z - far), high_z = seen_column(p.z + far), middle = seen_column(p.z);
    const uint32_t a = static_cast<uint32_t>(seen_column(p.x - far)) & (s.cells_x - 1),
                   b = static_cast<uint32_t>(seen_column(p.x + far)) & (s.cells_x - 1);
    auto visit_row = [&](int z) {
        const uint32_t row = (static_cast<uint32_t>(z) & (s.cells_z - 1)) * s.cells_x;
        if (a <= b) {
            visit(s.cell_first[row + a], s.cell_first[row + b + 1]);
        } else {
            visit(s.cell_first[row + a], s.cell_first[row + s.cells_x]);
            visit(s.cell_first[row], s.cell_first[row + b + 1]);
        }
    };
    visit_row(middle);
    for (int off = 1; middle - off >= low_z || middle + off <= high_z; ++off) {
        if (middle - off >= low_z) visit_row(middle - off);
        if (middle + off <= high_z) visit_row(middle + off);
    }
}

}  // namespace flaneur
