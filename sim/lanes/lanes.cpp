#include "sim/lanes/lanes.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

OnLane on_lane(const Lanes& lanes, uint32_t lane, float metres) {
    const Lane& l = lanes.all[lane];
    const float apart = l.length / static_cast<float>(l.count - 1), at = metres / apart;
    const auto k = static_cast<uint32_t>(clamp(at, 0, static_cast<float>(l.count - 2) + 0.5f));
    const Vec3* places = &lanes.places[l.first];
    const Vec3 a = places[k], b = places[k + 1];
    const float t = at - static_cast<float>(k);
    // The direction changes evenly from place to place, so that what goes beside the lane goes evenly.
    const bool has_before = k > 0, has_after = k + 2 < l.count;
    const Vec3 c = has_after ? places[k + 2] : b, z = has_before ? places[k - 1] : a;
    const Vec2 before = on_ground(has_before  ? b - z
                                  : has_after ? b * 4 - a * 3 - c
                                              : b - a),
               after = on_ground(has_after    ? c - a
                                 : has_before ? b * 3 - a * 4 + z
                                              : b - a);
    const Vec2 along = lerp(normalize_or(before, {0, 1}), normalize_or(after, {0, 1}), clamp(t, 0, 1));
    return {lerp(a, b, t), normalize_or(along, {0, 1})};
}

float bend_speed(const Lanes& lanes, uint32_t lane, float metres) {
    constexpr float k_aside = 2;         // m/s2
    constexpr float k_half = 2.5f;       // metres that are looked at each way
    constexpr float k_straight = 1e-3f;  // radians a metre
    const Lane& l = lanes.all[lane];
    const float middle =
        clamp(metres, std::min(k_half, l.length / 2), std::max(l.length - k_half, l.length / 2));
    const Vec2 a = on_ground(on_lane(lanes, lane, middle - k_half).at),
               b = on_ground(on_lane(lanes, lane, middle).at),
               c = on_ground(on_lane(lanes, lane, middle + k_half).at);
    // The curvature of the circle through all three.
    const float sides = length(b - a) * length(c - b) * length(c - a);
    const float bend = sides > 0 ? 2 * std::fabs(cross(b - a, c - a)) / sides : 0;
    return bend < k_straight ? 1e3f : std::sqrt(k_aside / bend);
}

void settle_lanes(Lanes& lanes, const Ground& ground) {
    constexpr float k_reach = 60, k_headroom = 2;  // metres
    for (Vec3& place : lanes.places) {
        auto hit = ground_at(ground, at_height(on_ground(place), 0), k_reach, k_reach);
        // Below bridges.
        for (; hit; hit = ground_at(ground, at_height(on_ground(place), place.y - k_headroom), 0, k_reach))
            place.y = hit->height;
    }
}

}  // namespace flaneur
