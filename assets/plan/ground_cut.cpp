// Cutting areas into pieces with common corners.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "assets/plan/ground_plan.h"
#include "assets/plan/ground_weld.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

namespace {

struct CutBox {
    int64_t x0, z0, x1, z1;
};

CutBox box_of(const Rings& rings) {
    CutBox b{INT64_MAX, INT64_MAX, INT64_MIN, INT64_MIN};
    for (const Ring& r : rings) {
        for (Point p : r) {
            b = {std::min<int64_t>(b.x0, p.X), std::min<int64_t>(b.z0, p.Y), std::max<int64_t>(b.x1, p.X),
                 std::max<int64_t>(b.z1, p.Y)};
        }
    }
    return b;
}

bool overlap(const CutBox& a, const CutBox& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.z0 < b.z1 && b.z0 < a.z1;
}

Ring ring_of(const CutBox& b) { return rectangle({b.x0, b.z0}, {b.x1, b.z1}); }

// A ring with its holes, on its way down to the cells.
struct Item {
    uint32_t area = 0;
    Rings rings;
    CutBox box{};
};

struct Cell {
    CutBox box;
    std::vector<Item> items;
};

bool same_ground(const Area& a, const Area& b) {
    return a.rank == b.rank && a.solid == b.solid && a.kind == b.kind && a.axis == b.axis &&
           a.lift.base == b.lift.base && a.lift.low == b.lift.low && a.lift.high == b.lift.high &&
           a.lift.origin == b.lift.origin && a.lift.slope == b.lift.slope &&
           a.lift.absolute == b.lift.absolute;
}

// Halves the box along cell borders until one cell is left; large rings are cut on the way, so that no cell
// pays for the whole of them.
void distribute(std::vector<Cell>& cells, const CutBox& box, int64_t cell, std::vector<Item> items) {
    if (items.empty()) return;
    int64_t columns = (box.x1 - box.x0 + cell - 1) / cell, rows = (box.z1 - box.z0 + cell - 1) / cell;
    if (columns <= 1 && rows <= 1) {
        cells.push_back({box, std::move(items)});
        return;
    }
    CutBox halves[2] = {box, box};
    if (columns >= rows) {
        halves[0].x1 = halves[1].x0 = box.x0 + columns / 2 * cell;
    } else {
        halves[0].z1 = halves[1].z0 = box.z0 + rows / 2 * cell;
    }
    std::vector<Item> first;
    for (const CutBox& half : halves) {
        bool last = &half == &halves[1];
        std::vector<Item> inside;
        for (Item& item : items) {
            if (!overlap(item.box, half)) continue;
            bool both = overlap(item.box, halves[0]) && overlap(item.box, halves[1]);
            size_t points = 0;
            for (const Ring& r : item.rings) points += r.size();
            if (both && points > 12) {
                Item cut{item.area, intersect(item.rings, {ring_of(half)}), {}};
                if (cut.rings.empty()) continue;
                cut.box = box_of(cut.rings);
                inside.push_back(std::move(cut));
            } else if (both && !last) {
                inside.push_back(item);
            } else {
                inside.push_back(std::exchange(item, Item{}));
            }
        }
        distribute(cells, half, cell, std::move(inside));
    }
}

// The pieces of what is `left` of one cell: each area takes its part of what the ones before have left.
void cut_cell(const Cell& cell, Rings left, const std::vector<Area>& areas,
              const std::vector<uint32_t>& order, std::vector<Piece>& pieces) {
    std::vector<const Item*> items;
    for (const Item& item : cell.items) items.push_back(&item);
    std::stable_sort(items.begin(), items.end(),
                     [&](const Item* a, const Item* b) { return order[a->area] < order[b->area]; });
    for (size_t i = 0; i < items.size() && !left.empty();) {
        const Area& area = areas[items[i]->area];
        uint32_t first = items[i]->area;
        Rings rings;
        for (; i < items.size() && same_ground(area, areas[items[i]->area]); ++i) {
            rings.insert(rings.end(), items[i]->rings.begin(), items[i]->rings.end());
        }
        if (!area.solid) {
            for (Region& region : regions_of(intersect(left, rings)))
                pieces.push_back({first, std::move(region)});
        }
        left = subtract(left, rings);
    }
}

}  // namespace

std::vector<Piece> cut_pieces(const GroundPlan& plan) {
    std::vector<uint32_t> by_rank(plan.areas.size()), order(plan.areas.size());
    std::iota(by_rank.begin(), by_rank.end(), 0);
    std::stable_sort(by_rank.begin(), by_rank.end(),
                     [&](uint32_t a, uint32_t b) { return plan.areas[a].rank < plan.areas[b].rank; });
    for (uint32_t i = 0; i < by_rank.size(); ++i) order[by_rank[i]] = i;

    Point low = to_point(plan.low), high = to_point(plan.high);
    CutBox box{low.X, low.Y, high.X, high.Y};
    std::vector<Item> items;
    for (uint32_t a = 0; a < plan.areas.size(); ++a) {
        for (const Ring& ring : plan.areas[a].rings) {
            if (twice_area(ring) > 0) {
                items.push_back({a, {ring}, {}});
            } else if (!items.empty() && items.back().area == a) {
                items.back().rings.push_back(ring);
            }
        }
    }
    for (Item& item : items) item.box = box_of(item.rings);
    std::vector<Cell> cells;
    int64_t cell = cell_of(plan);
    distribute(cells, box, cell, std::move(items));

    std::vector<std::vector<Piece>> cut(cells.size());
    WorkersPtr workers = make_workers(0);
    parallel_for(*workers, cells.size(), 4, [&](size_t begin, size_t end, int) {
        for (size_t c = begin; c < end; ++c) {
            Rings whole{ring_of(cells[c].box)};
            if (!plan.facets) {
                cut_cell(cells[c], whole, plan.areas, order, cut[c]);
                continue;
            }
            Point from{cells[c].box.x0, cells[c].box.z0}, to{from.X + cell, from.Y + cell};
            for (Point third : {Point{to.X, from.Y}, Point{from.X, to.Y}}) {
                Rings half = intersect(whole, {positive({from, to, third})});
                cut_cell(cells[c], std::move(half), plan.areas, order, cut[c]);
            }
        }
    });
    std::vector<Piece> pieces;
    for (std::vector<Piece>& some : cut) {
        pieces.insert(pieces.end(), std::make_move_iterator(some.begin()),
                      std::make_move_iterator(some.end()));
    }

    weld(pieces, *workers);
    return pieces;
}

}  // namespace flaneur
