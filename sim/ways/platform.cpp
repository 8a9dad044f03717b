#include "sim/ways/platform.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/planar.h"

namespace flaneur {

Result<Platform> make_platform(std::span<const Vec2> corners) {
    const size_t n = corners.size();
    if (n < 3 || n > k_platform_edges)
        return Error{"A platform has 3 to " + std::to_string(k_platform_edges) + " corners, not " +
                     std::to_string(n) + "."};
    Platform platform;
    int turns = 0;
    for (size_t i = 0; i < n; ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % n], c = corners[(i + 2) % n];
        if (!std::isfinite(a.x + a.z)) return Error{"A platform's corners are finite numbers of metres."};
        const double side = crossed(a, b, c);
        turns += side > 0 ? 1 : side < 0 ? -1 : 0;
    }
    if (static_cast<size_t>(std::abs(turns)) != n)
        return Error{"A platform is convex: at each of its corners its outline turns to the same side."};
    const float to_inside = turns > 0 ? 1.0f : -1.0f;
    for (size_t i = 0; i < n; ++i) {
        const Vec2 along = normalize_or(corners[(i + 1) % n] - corners[i], {0, 0});
        const Vec2 inward = Vec2{-along.z, along.x} * to_inside;
        platform.edges[platform.count++] = {inward, dot(corners[i], inward)};
    }
    // An outline that goes round more than once turns to one side too.
    for (const Vec2 corner : corners)
        if (room_at(platform, corner) < -1e-3f * (1 + length(corner)))
            return Error{"A platform's outline goes round once."};
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
