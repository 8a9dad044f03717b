#include "sim/gait/shoes.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/gait/curves/swing-inl.h"

namespace flaneur {

// Between the middles of both, of the length from ankle to tip: as they stand, and as one passes the other.
static constexpr float k_standing = 0.4f, k_passing = 0.36f;
static constexpr float k_farthest = 0.3f, k_farthest_round = 0.26f;  // metres
static constexpr float k_crossed = 0.01f;                            // metres: one lies across the other
static constexpr float k_leg = 0.3f;     // metres beside a shoe, where its leg is in the way as well
static constexpr float k_aslant = 0.5f;  // the cosine, at least, of a way out to the shortest one

// From the nearest place of the middle line of the shoe `b` to that of `a`.
static Vec2 gap_between(const FootPlace& a, const FootPlace& b, const FootSize& size) {
    const Vec2 apart = on_ground(a.position - b.position), ahead_a = heading_direction(a.yaw) * size.tip,
               ahead_b = heading_direction(b.yaw) * size.tip;
    const float heel = -size.heel / size.tip, over = 1 / (size.tip * size.tip);
    // Shares of the way from ankle to tip, by turns.
    float on_a = 0, on_b = 0;
    for (int turn = 0; turn < 4; ++turn) {
        on_b = clamp(dot(apart + ahead_a * on_a, ahead_b) * over, heel, 1);
        on_a = clamp(dot(ahead_b * on_b - apart, ahead_a) * over, heel, 1);
    }
    return apart + ahead_a * on_a - ahead_b * on_b;
}

void keep_shoes_apart(FootPlace& landing, const FootPlace& there, const FootSize& size, Vec2 outward) {
    const float wide = k_standing * size.tip;
    const float reach = 2 * size.tip + wide;
    if (length_squared(on_ground(landing.position - there.position)) > reach * reach) return;
    float may = k_farthest;
    for (int pass = 0; pass < 5; ++pass) {
        const Vec2 gap = gap_between(landing, there, size);
        const float room = length(gap);
        if (room >= wide) return;
        const Vec2 out = room > k_crossed ? gap * (1 / room) : outward;
        const Vec2 way = normalize_or(out - outward * std::min(dot(out, outward), 0.0f), outward);
        const float by = std::min((wide - room) / std::max(dot(way, out), k_aslant), may);
        landing.position += at_height(way * by, 0);
        may -= by;
    }
}

float room_between(const FootPlace& a, const FootPlace& b, const FootSize& size) {
    return length(gap_between(a, b, size));
}

bool turns_onto(const FootPlace& from, const FootPlace& to, const FootPlace& there, const FootSize& size) {
    const float room = room_between(to, there, size);
    return room < k_passing * size.tip && room < room_between(from, there, size);
}

float way_round(const FootPlace& from, const FootPlace& to, const FootPlace& there, const FootSize& size,
                float outward) {
    const float wide = k_passing * size.tip, turn = wrap_angle(to.yaw - from.yaw);
    // Most pass with room on the whole way.
    const Vec2 facing = heading_direction(there.yaw), own{facing.z * outward, -facing.x * outward};
    auto room_at = [&](const FootPlace& place) {
        const float inward = outward * wrap_angle(there.yaw - place.yaw);
        return dot(on_ground(place.position - there.position), own) - size.tip * std::max(inward, 0.0f);
    };
    if (std::min(room_at(from), room_at(to)) >= wide) return 0;
    float most = 0;
    for (float share : {0.15f, 0.3f, 0.45f, 0.6f, 0.75f, 0.9f}) {
        const FootPlace passing{lerp(from.position, to.position, share), from.yaw + turn * share};
        const Vec2 gap = gap_between(passing, there, size), ahead = heading_direction(passing.yaw),
                   left{ahead.z, -ahead.x};
        const float room = length(gap), beside = outward * dot(gap, left);
        const bool behind_leg = beside < 0 && room < k_leg && -beside > std::fabs(dot(gap, ahead));
        if (room >= wide && !behind_leg) continue;
        const float missing = beside >= 0 ? wide - room : wide + room;
        const float hop = 4 * share * (1 - share);  // about SwingTime's; see round_at
        most = std::max(most, missing / HWY_NAMESPACE::round_at(hop));
    }
    return std::min(most, k_farthest_round);
}

}  // namespace flaneur
