#include "sim/ways/platform.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/planar.h"

namespace flaneur {

static std::string told(Vec2 corner) {
    char text[64];
    std::snprintf(text, sizeof text, "%g,%g", static_cast<double>(corner.x), static_cast<double>(corner.z));
    return text;
}

// Leaves out corners that lie midway on an edge.
static void straighten(std::vector<Vec2>& corners) {
    constexpr float k_aside = 1e-3f;  // metres
    for (size_t i = 0; i < corners.size() && corners.size() > 2;) {
        const size_t n = corners.size();
        const Vec2 before = corners[(i + n - 1) % n], corner = corners[i], after = corners[(i + 1) % n];
        const Vec2 way = after - before;
        const float along = dot(corner - before, way);
        const double off = crossed(before, after, corner);
        const bool is_midway =
            along > 0 && along < length_squared(way) && std::fabs(off) <= wide(k_aside) * wide(length(way));
        if (!is_midway) {
            ++i;
            continue;
        }
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
        i = 0;  // the one before may lie midway now
    }
}

// The corners at which it turns, all to one side.
static Result<std::vector<Vec2>> convex_outline(std::span<const Vec2> corners) {
    if (corners.size() < 3 || corners.size() > k_platform_edges)
        return Error{"A platform has 3 to " + std::to_string(k_platform_edges) + " corners, not " +
                     std::to_string(corners.size()) + "."};
    for (size_t i = 0; i < corners.size(); ++i) {
        if (!std::isfinite(corners[i].x + corners[i].z))
            return Error{"A platform's corners are finite numbers of metres."};
        if (std::find(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(i), corners[i]) !=
            corners.begin() + static_cast<std::ptrdiff_t>(i))
            return Error{"The platform has the corner " + told(corners[i]) + " twice: leave one out."};
    }
    std::vector<Vec2> outline(corners.begin(), corners.end());
    straighten(outline);
    const size_t n = outline.size();
    if (n < 3) return Error{"The platform has no area: its corners lie on one line."};
    const double round = signed_area_of(outline);
    for (size_t i = 0; i < n; ++i) {
        const Vec2 corner = outline[(i + 1) % n];
        if (crossed(outline[i], corner, outline[(i + 2) % n]) * round <= 0)
            return Error{"The platform is not convex: its outline turns to the other side at " +
                         told(corner) + "; leave that corner out."};
    }
    return outline;
}

Result<Platform> make_platform(std::span<const Vec2> corners) {
    const Result<std::vector<Vec2>> outline = convex_outline(corners);
    if (!outline) return outline.error();
    const size_t n = outline->size();
    const float to_inside = crossed((*outline)[0], (*outline)[1], (*outline)[2]) > 0 ? 1.0f : -1.0f;
    Platform platform;
    for (size_t i = 0; i < n; ++i) {
        const Vec2 corner = (*outline)[i];
        const Vec2 along = normalize_or((*outline)[(i + 1) % n] - corner, {0, 0});
        const Vec2 inward = Vec2{-along.z, along.x} * to_inside;
        platform.edges[platform.count++] = {inward, dot(corner, inward)};
    }
    // An outline that goes round more than once turns to one side too.
    for (const Vec2 corner : *outline)
        if (room_at(platform, corner) < -1e-3f * (1 + length(corner)))
            return Error{"The platform's outline goes round more than once: give its corners in order."};
    return platform;
}

float room_at(const Platform::Edge& edge, Vec2 place) {
    return static_cast<float>(wide(place.x) * wide(edge.inward.x) + wide(place.z) * wide(edge.inward.z) -
                              wide(edge.offset));
}

float room_at(const Platform& platform, Vec2 place) {
    float room = std::numeric_limits<float>::max();
    for (int i = 0; i < platform.count; ++i) room = std::min(room, room_at(platform.edges[i], place));
    return room;
}

std::optional<Vec2> nearest_with_room(const Platform& platform, Vec2 place, float room) {
    constexpr float k_rounding = 1e-5f;  // metres
    // All against `place`: there a platform a kilometre away is as exact as any.
    float missing[k_platform_edges];
    bool is_missing = false;
    for (int i = 0; i < platform.count; ++i) {
        missing[i] = room - room_at(platform.edges[i], place);
        is_missing |= missing[i] > 0;
    }
    if (!is_missing) return place;
    // It lies on one edge of what is left of the platform, or where two of them meet.
    std::optional<Vec2> best;
    auto take = [&](Vec2 way) {
        for (int i = 0; i < platform.count; ++i)
            if (dot(way, platform.edges[i].inward) < missing[i] - k_rounding * (1 + length(way))) return;
        if (!best || length_squared(way) < length_squared(*best)) best = way;
    };
    for (int i = 0; i < platform.count; ++i) {
        const Vec2 a = platform.edges[i].inward;
        take(a * missing[i]);
        for (int j = 0; j < i; ++j) {
            const Vec2 b = platform.edges[j].inward;
            const float det = cross(a, b);
            if (std::fabs(det) < 1e-6f) continue;
            take(Vec2{missing[i] * b.z - missing[j] * a.z, a.x * missing[j] - b.x * missing[i]} / det);
        }
    }
    if (!best) return {};
    return place + *best;
}

}  // namespace flaneur
