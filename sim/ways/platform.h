// Convex pieces of ground that somebody keeps to.
#pragma once

#include <span>

#include "sim/base/result.h"
#include "sim/base/vec.h"

namespace flaneur {

inline constexpr int k_platform_edges = 16;  // at most

struct Platform {
    // What lies on it has dot(place, inward) >= offset for each edge, metres; `inward` is unit.
    struct Edge {
        Vec2 inward;
        float offset = 0;
    };
    Edge edges[k_platform_edges];
    int count = 0;
};

// Of a convex polygon's 3 to 16 corners, in either order, in metres; those midway on an edge, to 1 mm, are
// none. Refuses, with a sentence, others: that turn the other way or are there twice, or are not finite.
Result<Platform> make_platform(std::span<const Vec2> corners);

// Metres from a place on it to an edge, and to the nearest; less than 0 beside it.
float room_at(const Platform::Edge& edge, Vec2 place);
float room_at(const Platform& platform, Vec2 place);

// The place nearest to `place` that is at least `room` from every edge; `place` itself where it is. None
// where the platform has none.
std::optional<Vec2> nearest_with_room(const Platform& platform, Vec2 place, float room);

}  // namespace flaneur
