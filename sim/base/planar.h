// Straight lines that end, and polygons, on the ground plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/base/math.h"
#include "sim/base/vec.h"

namespace flaneur {

// The share of the way from `a` to `b`, 0..1, at its place nearest to `p`; 0 where it has no length.
inline float closest_on(Vec2 a, Vec2 b, Vec2 p) {
    const Vec2 way = b - a;
    return clamp(dot(p - a, way) / std::max(length_squared(way), 1e-9f), 0, 1);
}

// Twice the area of the triangle a, b, c, more than 0 if `c` lies to one side of the way from `a` to `b`, and
// less if it lies to the other; exact enough to tell which.
inline double crossed(Vec2 a, Vec2 b, Vec2 c) {
    return (wide(b.x) - wide(a.x)) * (wide(c.z) - wide(a.z)) -
           (wide(b.z) - wide(a.z)) * (wide(c.x) - wide(a.x));
}

// Square metres that corners go round, more than 0 the way that crossed() has it, less the other way; 0 of
// fewer than three. And either way round.
inline double signed_area_of(std::span<const Vec2> corners) {
    double twice = 0;
    for (size_t i = 2; i < corners.size(); ++i) twice += crossed(corners[0], corners[i - 1], corners[i]);
    return twice / 2;
}
inline double area_of(std::span<const Vec2> corners) { return std::fabs(signed_area_of(corners)); }

// Calls keep(corner) for those of what lies of a polygon where `side` is not negative (Sutherland & Hodgman,
// CACM 17, 1974); side(place) is linear. Of one that is not convex, edges that fold back may be left, which
// have no area.
template <class Side, class Keep>
void cut(std::span<const Vec2> polygon, const Side& side, const Keep& keep) {
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const float at_a = side(a), at_b = side(b);
        if (at_a >= 0) keep(a);
        if ((at_a >= 0) != (at_b >= 0)) keep(a + (b - a) * (at_a / (at_a - at_b)));
    }
}

// Whether a place lies in a polygon, either way round: by how many edges lie to one side. An edge holds its
// lower end and not its upper one, so that polygons side by side share nobody.
inline bool is_within(std::span<const Vec2> corners, Vec2 place) {
    bool is_in = false;
    for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Vec2 a = corners[i], b = corners[j];
        if ((a.z > place.z) == (b.z > place.z)) continue;
        const bool is_up = b.z > a.z;
        const double side = is_up ? crossed(a, b, place) : crossed(b, a, place);
        if (side > 0) is_in = !is_in;
    }
    return is_in;
}

}  // namespace flaneur
