#include "sim/ways/stride.h"

#include <algorithm>
#include <limits>

#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_rounding = 1e-4f;                      // metres, of places a kilometre out
static constexpr float k_off_circle = 0.6f;                     // metres, from which on one finds another
static constexpr float k_looks_ahead = 0.5f, k_most_round = 1;  // metres along a circle, and radians at most

Vec2 right_of(float heading) {
    const Vec2 ahead = heading_direction(heading);
    return {-ahead.z, ahead.x};
}

float largest_circle(const Platform& platform, Vec2 place, float heading, float side, float radius) {
    const Vec2 to_middle = right_of(heading) * side;
    float largest = std::numeric_limits<float>::infinity();
    for (int i = 0; i < platform.count; ++i) {
        const Platform::Edge& edge = platform.edges[i];
        const float room = room_at(edge, place) - radius, nears = 1 - dot(to_middle, edge.inward);
        if (room < 0) return room;
        if (nears > 1e-6f) largest = std::min(largest, room / nears);
    }
    return largest;
}

bool is_on(const Platform& platform, const Strider& who, const Stride& s) {
    return room_at(platform, s.centre) >= s.radius + kept_clear(who) - k_rounding;
}

bool is_along(const Stride& s, Vec2 place) {
    return s.circles > 0 && std::fabs(length(place - s.centre) - s.radius) <= k_off_circle;
}

// The next circle, from `place` on. False where there is room for none on that side.
static bool turn_to(const Platform& platform, const Strider& who, Stride& s, Vec2 place, float heading,
                    float side, RandomKey key) {
    const float least = least_circle(who),
                largest = largest_circle(platform, place, heading, side, kept_clear(who));
    if (largest < least) return false;
    key.when = s.circles++;
    s.side = side;
    s.radius = std::max(largest * (1 - random_unit(key, 0)), least);
    s.left = k_longest_on_circle * (1 - random_unit(key, 1));
    s.centre = place + right_of(heading) * (side * s.radius);
    return true;
}

// Towards a place a little ahead on the circle.
static Vec2 way_round(const Stride& s, Vec2 place) {
    const Vec2 out = normalize_or(place - s.centre, {0, 1});
    const SinCos by = sin_cos(s.side * std::min(k_looks_ahead / s.radius, k_most_round));
    const Vec2 ahead = {out.x * by.cosine - out.z * by.sine, out.z * by.cosine + out.x * by.sine};
    return normalize_or(s.centre + ahead * s.radius - place, {0, 0});
}

// Onto the narrowest circle, where there is room for it; from there to the next as soon as may be.
static Vec2 go_to_room(const Platform& platform, const Strider& who, Stride& s, Vec2 place, float heading) {
    const float least = least_circle(who);
    const Vec2 middle = place + right_of(heading) * (s.side * least);
    const auto centre = nearest_with_room(platform, middle, room_to_turn(who));
    if (!centre) return {0, 0};
    s.centre = *centre, s.radius = least, s.left = 0;
    return way_round(s, place);
}

Vec2 stride_on(const Platform& platform, const Strider& who, Stride& s, Vec2 place, float heading,
               float seconds, RandomKey key) {
    const float least_room = who.radius + who.goes_off / 2 - k_rounding;
    if (room_at(platform, place) < least_room) return go_to_room(platform, who, s, place, heading);
    s.left -= seconds;
    const bool is_lost = !is_along(s, place) || !is_on(platform, who, s);
    if (is_lost || s.left <= 0) {
        const float other = s.circles == 0 && random_unit(key, 2) < 0.5f ? s.side : -s.side;
        const bool turns = turn_to(platform, who, s, place, heading, other, key) ||
                           (is_lost && turn_to(platform, who, s, place, heading, -other, key));
        if (!turns && is_lost) return go_to_room(platform, who, s, place, heading);
    }
    return way_round(s, place);
}

}  // namespace flaneur
