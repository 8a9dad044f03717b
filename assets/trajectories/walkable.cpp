#include "assets/trajectories/walkable.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "assets/plan/polygons.h"
#include "sim/ground/ground.h"

namespace flaneur {
namespace {

constexpr int64_t k_least_twice = 200'000;  // mm2, twice an area

// From the lesser point to the greater, so many times; negative: back.
struct Edge {
    Point low, high;
    int times = 0;
};

bool edge_less(const Edge& a, const Edge& b) {
    return a.low != b.low ? point_less(a.low, b.low) : point_less(a.high, b.high);
}

void add_edge(std::vector<Edge>& edges, Point from, Point to) {
    if (point_less(from, to))
        edges.push_back({from, to, 1});
    else
        edges.push_back({to, from, -1});
}

// Most edges are those of two triangles, once either way, and none of the outline's. What is left winds round
// every place as often as the triangles do.
std::vector<Edge> uncancelled(std::vector<Edge> edges) {
    std::sort(edges.begin(), edges.end(), edge_less);
    std::vector<Edge> left;
    for (const Edge& edge : edges) {
        if (!left.empty() && left.back().low == edge.low && left.back().high == edge.high)
            left.back().times += edge.times;
        else if (!left.empty() && left.back().times == 0)
            left.back() = edge;
        else
            left.push_back(edge);
    }
    if (!left.empty() && left.back().times == 0) left.pop_back();
    return left;
}

// Closed rings of all of them: as many lead to a point as from it.
Rings loops_of(const std::vector<Edge>& edges) {
    auto less = [](Point a, Point b) { return point_less(a, b); };
    std::map<Point, std::vector<Point>, decltype(less)> next(less);
    for (const Edge& edge : edges)
        for (int i = 0; i < std::abs(edge.times); ++i)
            next[edge.times > 0 ? edge.low : edge.high].push_back(edge.times > 0 ? edge.high : edge.low);
    Rings loops;
    for (auto& [first, ways] : next) {
        while (!ways.empty()) {
            Ring& loop = loops.emplace_back();
            for (Point at = first; loop.empty() || at != first;) {
                std::vector<Point>& from = next[at];
                loop.push_back(at);
                at = from.back();
                from.pop_back();
            }
        }
    }
    return loops;
}

std::vector<Vec2> corners_of(const Ring& ring) {
    std::vector<Vec2> corners;
    for (const Point p : ring) corners.push_back(to_metres(p));
    return corners;
}

}  // namespace

std::vector<WalkablePolygon> walkable_area(const Ground& ground) {
    std::vector<Edge> edges;
    for (size_t i = 0; i < ground.kinds.size(); ++i) {
        if (!is_walked(ground.kinds[i])) continue;
        Ring ring;
        for (size_t k = 0; k < 3; ++k)
            ring.push_back(to_point(on_ground(ground.vertices[ground.indices[3 * i + k]])));
        if (twice_area(ring) == 0) continue;
        ring = positive(std::move(ring));
        for (size_t k = 0; k < 3; ++k) add_edge(edges, ring[k], ring[(k + 1) % 3]);
    }
    std::vector<Region> regions = regions_of(loops_of(uncancelled(std::move(edges))));
    std::erase_if(regions,
                  [](const Region& region) { return std::abs(twice_area(region.outer)) < k_least_twice; });
    std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) {
        return std::abs(twice_area(a.outer)) > std::abs(twice_area(b.outer));
    });
    std::vector<WalkablePolygon> area;
    for (const Region& region : regions) {
        WalkablePolygon& polygon = area.emplace_back();
        polygon.outer = corners_of(region.outer);
        for (const Ring& hole : region.holes)
            if (std::abs(twice_area(hole)) >= k_least_twice) polygon.holes.push_back(corners_of(hole));
    }
    return area;
}

}  // namespace flaneur
