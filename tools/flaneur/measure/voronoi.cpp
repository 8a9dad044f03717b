#include "tools/flaneur/measure/voronoi.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "tools/flaneur/measure/plan.h"

namespace flaneur {
namespace {

constexpr int k_sides = 24;
constexpr float k_shortest = 0.01f;  // metres, of an edge that cuts

// Leaves what of a polygon lies where dot(normal, p) <= most.
void cut_by(std::vector<Vec2>& polygon, std::vector<Vec2>& scratch, Vec2 normal, float most) {
    scratch.clear();
    cut(
        polygon, [&](Vec2 p) { return most - dot(normal, p); }, [&](Vec2 p) { scratch.push_back(p); });
    std::swap(polygon, scratch);
}

float farthest(std::span<const Vec2> polygon) {
    float most = 0;
    for (Vec2 corner : polygon) most = std::max(most, length_squared(corner));
    return std::sqrt(most);
}

// Of somebody at (0, 0), among others about them: places against theirs, the nearest first.
void make_cell(std::span<const Vec2> others, std::vector<Vec2>& cell, std::vector<Vec2>& scratch) {
    cell.clear();
    for (int i = 0; i < k_sides; ++i) {
        const SinCos angle = sin_cos(6.2831853f * static_cast<float>(i) / k_sides);
        cell.push_back({k_cell_reach * angle.cosine, k_cell_reach * angle.sine});
    }
    float reach = k_cell_reach;
    for (Vec2 other : others) {
        const float apart = length(other);
        if (apart >= 2 * reach) break;
        if (apart < 1e-4f) continue;
        cut_by(cell, scratch, other, length_squared(other) / 2);
        reach = farthest(cell);
    }
}

float distance_to_edge(std::span<const Vec2> zone, Vec2 p) {
    float least = 1e9f;
    for (size_t i = 0, j = zone.size() - 1; i < zone.size(); j = i++)
        least = std::min(least, length(lerp(zone[j], zone[i], closest_on(zone[j], zone[i], p)) - p));
    return least;
}

// Those within twice the reach of people[who], against it and sorted by distance; `people` are sorted by x.
void find_others(std::span<const Vec2> people, size_t who, std::vector<Vec2>& others) {
    constexpr float k_near = 2 * k_cell_reach;
    others.clear();
    const Vec2 at = people[who];
    auto first = std::lower_bound(people.begin(), people.end(), at.x - k_near,
                                  [](Vec2 p, float x) { return p.x < x; });
    for (; first != people.end() && first->x < at.x + k_near; ++first) {
        const Vec2 away = *first - at;
        if (&*first != &people[who] && length_squared(away) < k_near * k_near) others.push_back(away);
    }
    std::sort(others.begin(), others.end(),
              [](Vec2 a, Vec2 b) { return length_squared(a) < length_squared(b); });
}

}  // namespace

std::vector<Vec2> voronoi_cell(std::span<const Vec2> people, size_t who) {
    std::vector<Vec2> sorted(people.begin(), people.end()), others, cell, scratch;
    const Vec2 at = people[who];
    auto is_before = [](Vec2 a, Vec2 b) { return std::pair(a.x, a.z) < std::pair(b.x, b.z); };
    std::sort(sorted.begin(), sorted.end(), is_before);
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), at, is_before);
    find_others(sorted, static_cast<size_t>(place - sorted.begin()), others);
    make_cell(others, cell, scratch);
    for (Vec2& corner : cell) corner += at;
    return cell;
}

std::vector<Vec2> part_within(std::span<const Vec2> polygon, std::span<const Vec2> convex) {
    if (convex.size() < 3) return {};
    float turned = 0;
    for (size_t k = 0; k < convex.size(); ++k) turned += cross(convex[k], convex[(k + 1) % convex.size()]);
    std::vector<Vec2> part(polygon.begin(), polygon.end()), scratch;
    for (size_t k = 0; k < convex.size() && !part.empty(); ++k) {
        const Vec2 a = convex[k], b = convex[(k + 1) % convex.size()];
        if (length_squared(b - a) < k_shortest * k_shortest) continue;  // rounding turns it any way
        const Vec2 out = turned > 0 ? Vec2{b.z - a.z, a.x - b.x} : Vec2{a.z - b.z, b.x - a.x};
        cut_by(part, scratch, out, dot(out, a));
    }
    return part;
}

double voronoi_density(std::span<const Vec2> zone, std::span<const Vec2> people) {
    Vec2 low = zone[0], high = low;
    for (Vec2 c : zone) {
        low = {std::min(low.x, c.x), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.z, c.z)};
    }
    auto is_near = [&](Vec2 p, float reach) {
        return p.x > low.x - reach && p.z > low.z - reach && p.x < high.x + reach && p.z < high.z + reach;
    };
    std::vector<Vec2> near, others, cell, part, scratch;
    for (Vec2 p : people)
        if (is_near(p, 3 * k_cell_reach)) near.push_back(p);
    std::sort(near.begin(), near.end(),
              [](Vec2 a, Vec2 b) { return std::pair(a.x, a.z) < std::pair(b.x, b.z); });
    double sum = 0;
    for (size_t i = 0; i < near.size(); ++i) {
        if (!is_near(near[i], k_cell_reach)) continue;
        // Cells far from the outline lie all within it, or all outside.
        if (distance_to_edge(zone, near[i]) >= k_cell_reach) {
            if (is_within(zone, near[i])) ++sum;
            continue;
        }
        find_others(near, i, others);
        make_cell(others, cell, scratch);
        const double whole = area_of(cell);
        if (whole <= 0) continue;
        part.clear();
        for (Vec2 corner : zone) part.push_back(corner - near[i]);
        for (size_t k = 0; k < cell.size() && !part.empty(); ++k) {
            const Vec2 a = cell[k], b = cell[k + 1 < cell.size() ? k + 1 : 0];
            const Vec2 out{b.z - a.z, a.x - b.x};
            cut_by(part, scratch, out, dot(out, a));
        }
        sum += area_of(part) / whole;
    }
    return sum / area_of(zone);
}

}  // namespace flaneur
