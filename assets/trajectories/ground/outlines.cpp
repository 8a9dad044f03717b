#include "assets/trajectories/ground/outlines.h"

#include <algorithm>
#include <cstdlib>

#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr int64_t k_least_outline = 20'000;  // mm2, twice an area

std::vector<Vec2> corners_of_ring(const Ring& ring) {
    std::vector<Vec2> corners;
    for (const Point p : ring) corners.push_back(to_metres(p));
    return corners;
}

std::vector<WalkablePolygon> outlines_of(const Rings& rings) {
    std::vector<Region> regions = regions_of(rings);
    std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) {
        return std::abs(twice_area(a.outer)) > std::abs(twice_area(b.outer));
    });
    std::vector<WalkablePolygon> area;
    for (const Region& region : regions) {
        if (std::abs(twice_area(region.outer)) < k_least_outline || region.outer.size() < 3) continue;
        WalkablePolygon& polygon = area.emplace_back();
        polygon.outer = corners_of_ring(region.outer);
        for (const Ring& hole : region.holes)
            if (std::abs(twice_area(hole)) >= k_least_outline) polygon.holes.push_back(corners_of_ring(hole));
    }
    return area;
}

}  // namespace

void add_outline(Rings& rings, const std::vector<Vec2>& outline) {
    Ring ring;
    for (const Vec2 corner : outline) ring.push_back(to_point(corner));
    if (ring.size() > 2) rings.push_back(positive(std::move(ring)));
}

std::vector<WalkablePolygon> united_area(const Rings& rings) { return outlines_of(unite(rings)); }

std::vector<WalkablePolygon> area_without(const Rings& rings, const Rings& holes) {
    return outlines_of(subtract(unite(rings), unite(holes)));
}

std::vector<Vec2> circle_about(Vec2 middle, float radius) {
    std::vector<Vec2> corners;
    for (int i = 0; i < 24; ++i) {
        const SinCos turn = sin_cos(static_cast<float>(i) * 15 * k_radians - k_pi);
        corners.push_back(middle + Vec2{turn.cosine, turn.sine} * radius);
    }
    return corners;
}

}  // namespace flaneur
