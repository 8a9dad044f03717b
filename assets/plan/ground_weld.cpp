// Making the corners of neighbouring pieces the same.
#include "assets/plan/ground_weld.h"

#include <algorithm>
#include <utility>

namespace flaneur {

namespace {

struct PointLess {
    bool operator()(Point a, Point b) const { return a.X != b.X ? a.X < b.X : a.Y < b.Y; }
};

// All corners, sorted, in squares of `k_square` mm for looking up what lies near a line.
struct Corners {
    static constexpr int64_t k_square = 4000;
    std::vector<Point> points;
    std::vector<std::pair<std::pair<int64_t, int64_t>, uint32_t>> by_square;
};

int64_t square_of(int64_t v) {
    return v >= 0 ? v / Corners::k_square : -((-v + Corners::k_square - 1) / Corners::k_square);
}

// Clipper rounds a crossing to whole millimetres, now and then differently for two neighbours. Corners a
// millimetre apart become one.
Corners merge_corners(std::vector<Piece>& pieces) {
    std::vector<Point> all;
    for (const Piece& piece : pieces) {
        all.insert(all.end(), piece.region.outer.begin(), piece.region.outer.end());
        for (const Ring& hole : piece.region.holes) all.insert(all.end(), hole.begin(), hole.end());
    }
    std::sort(all.begin(), all.end(), PointLess{});
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<Point> stands_for = all;
    for (size_t i = 0; i < all.size(); ++i) {
        for (int64_t dx = -1; dx <= 0; ++dx) {
            for (int64_t dz = -1; dz <= (dx < 0 ? 1 : -1); ++dz) {
                Point near{all[i].X + dx, all[i].Y + dz};
                auto found = std::lower_bound(all.begin(), all.end(), near, PointLess{});
                if (found == all.end() || !(*found == near)) continue;
                auto k = static_cast<size_t>(found - all.begin());
                if (stands_for[k] == all[k]) stands_for[i] = all[k];
            }
        }
    }
    auto merge = [&](Ring& ring) {
        for (Point& p : ring) {
            p = stands_for[static_cast<size_t>(std::lower_bound(all.begin(), all.end(), p, PointLess{}) -
                                               all.begin())];
        }
    };
    for (Piece& piece : pieces) {
        merge(piece.region.outer);
        for (Ring& hole : piece.region.holes) merge(hole);
    }
    Corners corners;
    for (size_t i = 0; i < all.size(); ++i) {
        if (!(stands_for[i] == all[i])) continue;
        auto index = static_cast<uint32_t>(corners.points.size());
        corners.points.push_back(all[i]);
        corners.by_square.push_back({{square_of(all[i].X), square_of(all[i].Y)}, index});
    }
    std::sort(corners.by_square.begin(), corners.by_square.end());
    return corners;
}

// The corners that lie on the way from a to b, within 1.5 mm, in order.
void add_between(Ring& out, const Corners& corners, Point a, Point b) {
    int64_t dx = b.X - a.X, dz = b.Y - a.Y, square = dx * dx + dz * dz;
    std::vector<std::pair<int64_t, Point>> found;
    int64_t x0 = square_of(std::min(a.X, b.X) - 2), x1 = square_of(std::max(a.X, b.X) + 2);
    int64_t z0 = square_of(std::min(a.Y, b.Y) - 2), z1 = square_of(std::max(a.Y, b.Y) + 2);
    for (int64_t x = x0; x <= x1; ++x) {
        auto at = std::lower_bound(corners.by_square.begin(), corners.by_square.end(),
                                   std::make_pair(std::make_pair(x, z0), uint32_t{0}));
        for (; at != corners.by_square.end() && at->first <= std::make_pair(x, z1); ++at) {
            Point p = corners.points[at->second];
            int64_t along = (p.X - a.X) * dx + (p.Y - a.Y) * dz, off = (p.X - a.X) * dz - (p.Y - a.Y) * dx;
            if (along <= 0 || along >= square) continue;
            // |off| <= 1.5 * length, in whole numbers small enough to square.
            if (std::abs(off) > 2'000'000'000 || 4 * off / 3 * off / 3 > square) continue;
            found.push_back({along, p});
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) {
        return p.first != q.first ? p.first < q.first : PointLess{}(p.second, q.second);
    });
    for (const auto& f : found) out.push_back(f.second);
}

// Repeated corners and there-and-back spikes go.
Ring without_spikes(const Ring& ring) {
    Ring kept;
    for (Point p : ring) {
        kept.push_back(p);
        for (;;) {
            size_t n = kept.size();
            if (n >= 2 && kept[n - 1] == kept[n - 2]) {
                kept.pop_back();
            } else if (n >= 3 && kept[n - 1] == kept[n - 3]) {
                kept.resize(n - 2);
            } else {
                break;
            }
        }
    }
    while (kept.size() >= 3) {
        size_t n = kept.size();
        if (kept[0] == kept[n - 1]) {
            kept.pop_back();
        } else if (kept[1] == kept[n - 1]) {
            kept.pop_back(), kept.erase(kept.begin());
        } else if (kept[0] == kept[n - 2]) {
            kept.resize(n - 2);
        } else {
            break;
        }
    }
    if (kept.size() < 3) kept.clear();
    return kept;
}

Ring with_corners_between(const Ring& ring, const Corners& corners) {
    Ring full;
    for (size_t i = 0; i < ring.size(); ++i) {
        full.push_back(ring[i]);
        add_between(full, corners, ring[i], ring[(i + 1) % ring.size()]);
    }
    return without_spikes(full);
}

bool repeats_a_corner(const Region& region) {
    std::vector<Point> all = region.outer;
    for (const Ring& hole : region.holes) all.insert(all.end(), hole.begin(), hole.end());
    std::sort(all.begin(), all.end(), PointLess{});
    return std::adjacent_find(all.begin(), all.end()) != all.end();
}

struct Directed {
    Point from, to;
};
struct DirectedLess {
    bool operator()(const Directed& a, const Directed& b) const {
        return a.from == b.from ? PointLess{}(a.to, b.to) : PointLess{}(a.from, b.from);
    }
};

// The edges of the region's rings; what runs both ways encloses nothing and goes.
std::vector<Directed> edges_of(const Region& region) {
    std::vector<Directed> edges, kept;
    for (const Ring& ring : rings_of(region)) {
        for (size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
    std::sort(edges.begin(), edges.end(), DirectedLess{});
    auto count = [&](const Directed& e) {
        auto range = std::equal_range(edges.begin(), edges.end(), e, DirectedLess{});
        return range.second - range.first;
    };
    for (size_t i = 0; i < edges.size(); ++i) {
        bool repeated = i > 0 && edges[i].from == edges[i - 1].from && edges[i].to == edges[i - 1].to;
        if (!repeated && count(edges[i]) > count({edges[i].to, edges[i].from})) kept.push_back(edges[i]);
    }
    return kept;
}

// Whether direction a comes before b when turning clockwise (X right, Y up) from `back`; exact.
bool turns_less(Point back, Point a, Point b) {
    auto cross_of = [](Point p, Point q) { return p.X * q.Y - p.Y * q.X; };
    auto dot_of = [](Point p, Point q) { return p.X * q.X + p.Y * q.Y; };
    // 1: under half a turn, 2: half a turn, 3: more, 4: all the way round.
    auto half = [&](Point p) {
        int64_t c = cross_of(back, p);
        return c < 0 ? 1 : c > 0 ? 3 : dot_of(back, p) > 0 ? 4 : 2;
    };
    int ha = half(a), hb = half(b);
    return ha != hb ? ha < hb : cross_of(a, b) < 0;
}

// Welding may close a gap of a millimetre, so that rings touch or run along each other. Walks the edges anew,
// at each corner taking the leftmost way, which hugs the inside: touching lobes part, touching holes join
// their ring.
std::vector<Region> walk_again(const Region& region) {
    std::vector<Directed> edges = edges_of(region);
    std::vector<bool> used(edges.size());
    Rings outers, holes;
    for (size_t start = 0; start < edges.size(); ++start) {
        if (used[start]) continue;
        Ring ring;
        for (size_t at = start; !used[at];) {
            used[at] = true;
            ring.push_back(edges[at].from);
            Point v = edges[at].to, back{edges[at].from.X - v.X, edges[at].from.Y - v.Y};
            auto first = std::lower_bound(edges.begin(), edges.end(), v,
                                          [](const Directed& e, Point p) { return PointLess{}(e.from, p); });
            size_t best = edges.size();
            for (auto e = first; e != edges.end() && e->from == v; ++e) {
                auto k = static_cast<size_t>(e - edges.begin());
                auto way = [&](size_t i) { return Point(edges[i].to.X - v.X, edges[i].to.Y - v.Y); };
                if ((!used[k] || k == start) && (best == edges.size() || turns_less(back, way(k), way(best))))
                    best = k;
            }
            if (best == edges.size()) break;
            at = best;
        }
        if (ring.size() >= 3) (twice_area(ring) > 0 ? outers : holes).push_back(std::move(ring));
    }
    std::vector<Region> regions;
    for (Ring& outer : outers) regions.push_back({std::move(outer), {}});
    for (Ring& hole : holes) {
        Region* around = nullptr;
        for (Region& r : regions) {
            if (!contains({r.outer}, hole[0])) continue;
            if (!around || twice_area(r.outer) < twice_area(around->outer)) around = &r;
        }
        if (around && twice_area(hole) < 0) around->holes.push_back(std::move(hole));
    }
    return regions;
}

}  // namespace

void weld(std::vector<Piece>& pieces, Workers& workers) {
    Corners corners = merge_corners(pieces);
    std::vector<std::vector<Region>> welded(pieces.size());
    parallel_for(workers, pieces.size(), 64, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) {
            Region region{with_corners_between(pieces[i].region.outer, corners), {}};
            for (const Ring& hole : pieces[i].region.holes) {
                Ring full = with_corners_between(hole, corners);
                if (!full.empty()) region.holes.push_back(std::move(full));
            }
            if (repeats_a_corner(region)) {
                welded[i] = walk_again(region);
            } else if (twice_area(region.outer) > 0) {
                welded[i].push_back(std::move(region));
            }
        }
    });
    std::vector<Piece> result;
    for (size_t i = 0; i < pieces.size(); ++i) {
        for (Region& region : welded[i]) result.push_back({pieces[i].area, std::move(region)});
    }
    pieces = std::move(result);
}

}  // namespace flaneur
