#include "sim/lanes/lanes.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

OnLane on_lane(const Lanes& lanes, uint32_t lane, float metres) {
    const Lane& l = lanes.all[lane];
    const float apart = l.length / static_cast<float>(l.count - 1), at = metres / apart;
    const auto k = static_cast<uint32_t>(clamp(at, 0, static_cast<float>(l.count - 2) + 0.5f));
    const Vec3 a = lanes.places[l.first + k], b = lanes.places[l.first + k + 1];
    return {lerp(a, b, at - static_cast<float>(k)), normalize_or(on_ground(b - a), {0, 1})};
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
    for (Vec3& place : lanes.places)
        if (const auto hit = ground_at(ground, at_height(on_ground(place), 0), 60, 60)) place.y = hit->height;
}

}  // namespace flaneur
