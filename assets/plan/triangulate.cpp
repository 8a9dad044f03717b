#include <algorithm>
#include <numeric>

#include "assets/plan/polygons.h"

namespace flaneur {

namespace {

// A corner of the outline that is being cut down; a bridge to a hole visits two places twice.
struct OutlineCorner {
    Point at;
    uint32_t index;
};
using Outline = std::vector<OutlineCorner>;

constexpr double k_thin = 20;  // height of a triangle over its longest side that is better avoided, mm

int64_t turn(Point a, Point b, Point c) { return (b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X); }

int64_t square_distance(Point a, Point b) { return (a.X - b.X) * (a.X - b.X) + (a.Y - b.Y) * (a.Y - b.Y); }

bool on_open_segment(Point a, Point b, Point p) {
    if (p == a || p == b || turn(a, b, p) != 0) return false;
    return (p.X - a.X) * (p.X - b.X) + (p.Y - a.Y) * (p.Y - b.Y) < 0;
}

// Whether the open segment a-b meets c-d, or passes through one of its ends.
bool blocks(Point a, Point b, Point c, Point d) {
    if (on_open_segment(a, b, c) || on_open_segment(a, b, d)) return true;
    if (on_open_segment(c, d, a) || on_open_segment(c, d, b)) return true;
    auto opposite = [](int64_t s, int64_t t) { return (s > 0 && t < 0) || (s < 0 && t > 0); };
    return opposite(turn(a, b, c), turn(a, b, d)) && opposite(turn(c, d, a), turn(c, d, b));
}

// Whether the way from corner `here` to `p` starts inside the outline.
bool in_cone(Point before, Point here, Point after, Point p) {
    if (turn(before, here, after) > 0) return turn(before, here, p) > 0 && turn(here, after, p) > 0;
    return turn(before, here, p) > 0 || turn(here, after, p) > 0;
}

Outline corners_of(const Ring& ring, uint32_t first) {
    Outline corners;
    for (uint32_t i = 0; i < ring.size(); ++i) corners.push_back({ring[i], first + i});
    return corners;
}

// Joins `holes[h]` to the outline by the shortest bridge that meets nothing; false if there is none.
bool bridge(Outline& outline, const std::vector<Outline>& holes, size_t h) {
    struct Bridge {
        int64_t length;
        uint32_t from, to;
    };
    const Outline& hole = holes[h];
    std::vector<Bridge> bridges;
    for (uint32_t j = 0; j < hole.size(); ++j) {
        for (uint32_t i = 0; i < outline.size(); ++i) {
            bridges.push_back({square_distance(outline[i].at, hole[j].at), i, j});
        }
    }
    std::sort(bridges.begin(), bridges.end(), [](const Bridge& a, const Bridge& b) {
        return a.length != b.length ? a.length < b.length : a.from != b.from ? a.from < b.from : a.to < b.to;
    });
    auto clear = [](const Outline& ring, Point a, Point b) {
        for (size_t i = 0; i < ring.size(); ++i) {
            if (blocks(a, b, ring[i].at, ring[(i + 1) % ring.size()].at)) return false;
        }
        return true;
    };
    for (const Bridge& candidate : bridges) {
        size_t i = candidate.from, n = outline.size();
        Point a = outline[i].at, b = hole[candidate.to].at;
        if (!(a == b)) {
            if (!in_cone(outline[(i + n - 1) % n].at, a, outline[(i + 1) % n].at, b) || !clear(outline, a, b))
                continue;
            bool free = true;
            for (size_t k = h; k < holes.size() && free; ++k) free = clear(holes[k], a, b);
            if (!free) continue;
        }
        Outline joined(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        for (size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(candidate.to + k) % hole.size()]);
        joined.insert(joined.end(), outline.begin() + static_cast<std::ptrdiff_t>(i), outline.end());
        outline = std::move(joined);
        return true;
    }
    return false;
}

// Whether corner i can be cut off: it turns inwards and no other corner lies in its triangle or on it.
bool is_ear(const Outline& o, size_t i) {
    size_t n = o.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    Point a = o[before].at, b = o[i].at, c = o[after].at;
    if (turn(a, b, c) <= 0) return false;
    // Where a bridge meets the outline, a place is there twice: its neighbours say whether a-c stays inside.
    if (n > 3 && !in_cone(o[(before + n - 1) % n].at, a, b, c) && !(o[(before + n - 1) % n].at == c))
        return false;
    for (const OutlineCorner& p : o) {
        if (p.at == a || p.at == b || p.at == c) continue;
        if (turn(a, b, p.at) >= 0 && turn(b, c, p.at) >= 0 && turn(c, a, p.at) >= 0) return false;
    }
    return true;
}

}  // namespace

std::vector<uint32_t> triangulate(const Region& region) {
    std::vector<uint32_t> triangles;
    if (region.outer.size() < 3) return triangles;
    Outline outline = corners_of(region.outer, 0);
    std::vector<Outline> holes;
    auto first = static_cast<uint32_t>(region.outer.size());
    for (const Ring& hole : region.holes) {
        if (hole.size() >= 3) holes.push_back(corners_of(hole, first));
        first += static_cast<uint32_t>(hole.size());
    }
    // A hole may hide behind another, so those that find no bridge wait for the next round.
    for (size_t h = 0; h < holes.size(); ++h) {
        for (size_t k = h; k < holes.size(); ++k) {
            std::swap(holes[h], holes[k]);
            if (bridge(outline, holes, h)) break;
        }
    }

    // Of the ears the one with the shortest cut goes first, thin ones last: a sliver's normal says nothing.
    while (outline.size() > 3) {
        size_t n = outline.size(), best = n;
        double least_cost = 0;
        for (size_t i = 0; i < n; ++i) {
            Point before = outline[(i + n - 1) % n].at, after = outline[(i + 1) % n].at;
            auto diagonal = static_cast<double>(square_distance(before, after));
            auto twice = static_cast<double>(turn(before, outline[i].at, after));
            bool thin = twice * twice < k_thin * k_thin * diagonal;
            double cost = thin ? diagonal + 1e18 : diagonal;
            if (best < n && cost >= least_cost) continue;
            if (!is_ear(outline, i)) continue;
            best = i;
            least_cost = cost;
        }
        if (best == n) {
            // Only an outline that crosses or folds onto itself has no ear: cut where it costs least area.
            int64_t least = 0;
            for (size_t i = 0; i < n; ++i) {
                int64_t t = turn(outline[(i + n - 1) % n].at, outline[i].at, outline[(i + 1) % n].at);
                if (best < n && std::abs(t) >= least) continue;
                best = i;
                least = std::abs(t);
            }
        }
        const OutlineCorner &a = outline[(best + n - 1) % n], &b = outline[best],
                            &c = outline[(best + 1) % n];
        if (turn(a.at, b.at, c.at) > 0) triangles.insert(triangles.end(), {a.index, b.index, c.index});
        outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(best));
    }
    if (turn(outline[0].at, outline[1].at, outline[2].at) > 0) {
        triangles.insert(triangles.end(), {outline[0].index, outline[1].index, outline[2].index});
    }
    return triangles;
}

}  // namespace flaneur
