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

float room_at(const Platform& platform, Vec2 place) {
    float room = std::numeric_limits<float>::max();
    for (int i = 0; i < platform.count; ++i)
        room = std::min(room, dot(place, platform.edges[i].inward) - platform.edges[i].offset);
    return room;
}

std::optional<Vec2> nearest_with_room(const Platform& platform, Vec2 place, float room) {
    constexpr float k_rounding = 1e-4f;  // metres
    if (room_at(platform, place) >= room) return place;
    // It lies on one edge of what is left of the platform, or where two of them meet.
    std::optional<Vec2> best;
    auto take = [&](Vec2 p) {
        if (room_at(platform, p) < room - k_rounding) return;
        if (!best || length_squared(p - place) < length_squared(*best - place)) best = p;
    };
    for (int i = 0; i < platform.count; ++i) {
        const auto& [a, a_offset] = platform.edges[i];
        take(place + a * (a_offset + room - dot(place, a)));
        for (int j = 0; j < i; ++j) {
            const auto& [b, b_offset] = platform.edges[j];
            const float det = cross(a, b);
            if (std::fabs(det) < 1e-6f) continue;
            const float at_a = a_offset + room, at_b = b_offset + room;
            take({(at_a * b.z - at_b * a.z) / det, (a.x * at_b - b.x * at_a) / det});
        }
    }
    return best;
}

}  // namespace flaneur
