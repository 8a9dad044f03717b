// Things on the ground plane, each with a weight, to choose by chance among those near a place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/ground/grid.h"

namespace flaneur {

struct WeightedGrid {
    Grid grid;                   // `items` are the things' numbers, sorted by cell
    std::vector<double> before;  // one an item and the total at the end: the weight of all items before it
};

// place_of(i) and weight_of(i) tell of thing i. Those outside [low, high] count as on its rim.
template <class PlaceOf, class WeightOf>
WeightedGrid make_weighted_grid(Vec2 low, Vec2 high, float cell, size_t count, PlaceOf place_of,
                                WeightOf weight_of) {
    WeightedGrid w;
    w.grid = make_grid(low, high, cell);
    fill_grid(w.grid, static_cast<uint32_t>(count), [&](uint32_t i, auto visit) {
        CellRange r = cells_of_box(w.grid, place_of(i), place_of(i));
        visit(static_cast<size_t>(r.z0) * w.grid.width + r.x0);
    });
    double sum = 0;
    for (uint32_t i : w.grid.items) {
        w.before.push_back(sum);
        sum += weight_of(i);
    }
    w.before.push_back(sum);
    return w;
}

// Calls visit(begin, end) for each row of the cells that touch the square of half edge `radius` about
// `centre`: items [begin, end) lie in it. Stops when visit says false.
template <class Visit>
void for_rows_near(const WeightedGrid& w, Vec2 centre, float radius, Visit visit) {
    if (w.grid.items.empty()) return;
    CellRange r = cells_of_box(w.grid, centre - Vec2{radius, radius}, centre + Vec2{radius, radius});
    for (int z = r.z0; z <= r.z1; ++z) {
        size_t row = static_cast<size_t>(z) * w.grid.width;
        if (!visit(size_t{w.grid.first[row + r.x0]}, size_t{w.grid.first[row + r.x1 + 1]})) return;
    }
}

// The weight of the items in those cells.
inline double weight_near(const WeightedGrid& w, Vec2 centre, float radius) {
    double total = 0;
    for_rows_near(w, centre, radius, [&](size_t begin, size_t end) {
        total += w.before[end] - w.before[begin];
        return true;
    });
    return total;
}

// The item among [begin, end) at which the weight of all items before it and its own pass `weight`.
inline size_t item_at(const WeightedGrid& w, double weight, size_t begin, size_t end) {
    auto first = w.before.begin();
    auto after =
        std::upper_bound(first + static_cast<ptrdiff_t>(begin), first + static_cast<ptrdiff_t>(end), weight);
    return std::max(static_cast<size_t>(after - first), begin + 1) - 1;
}

// The index in `items` of one of those in these cells, by weight, for `u` in [0, 1); none if they weigh
// nothing.
inline std::optional<size_t> item_near(const WeightedGrid& w, Vec2 centre, float radius, float u) {
    double wanted = static_cast<double>(u) * weight_near(w, centre, radius);
    std::optional<size_t> found;
    for_rows_near(w, centre, radius, [&](size_t begin, size_t end) {
        double weight = w.before[end] - w.before[begin];
        if (weight <= 0) return true;
        found = item_at(w, w.before[begin] + std::min(wanted, weight), begin, end);
        wanted -= weight;
        return wanted >= 0;
    });
    return found;
}

}  // namespace flaneur
