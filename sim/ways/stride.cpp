#include "sim/ways/stride.h"

#include <algorithm>
#include <limits>

#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_rounding = 1e-4f;  // metres, of places a kilometre out

static Vec2 right_of(float heading) {
    const Vec2 ahead = heading_direction(heading);
    return {-ahead.z, ahead.x};
}

Vec2 place_of(const Stride& s) { return s.centre - right_of(s.heading) * (s.side * s.radius); }

float largest_circle(const Platform& platform, Vec2 place, float heading, float side, float radius) {
    const Vec2 to_middle = right_of(heading) * side;
    float largest = std::numeric_limits<float>::infinity();
    for (int i = 0; i < platform.count; ++i) {
        const auto& [inward, offset] = platform.edges[i];
        const float room = dot(place, inward) - offset - radius, nears = 1 - dot(to_middle, inward);
        if (room < 0) return room;
        if (nears > 1e-6f) largest = std::min(largest, room / nears);
    }
    return largest;
}

bool is_on(const Platform& platform, const Strider& who, const Stride& s) {
    return room_at(platform, s.centre) >= s.radius + who.radius - k_rounding;
}

bool turn_to(const Platform& platform, const Strider& who, Stride& s, float side, RandomKey key) {
    const Vec2 place = place_of(s);
    const float least = least_circle(who),
                largest = largest_circle(platform, place, s.heading, side, who.radius);
    if (largest < least) return false;
    key.when = s.circles++;
    s.side = side;
    s.radius = std::max(largest * (1 - random_unit(key, 0)), least);
    s.left = k_longest_on_circle * (1 - random_unit(key, 1));
    s.centre = place + right_of(s.heading) * (side * s.radius);
    return true;
}

// To the nearest place where there is room for the narrowest circle.
static bool carry(const Platform& platform, const Strider& who, Stride& s) {
    const float least = least_circle(who);
    const Vec2 middle = place_of(s) + right_of(s.heading) * (s.side * least);
    const auto centre = nearest_with_room(platform, middle, least + who.radius + k_rounding);
    if (!centre) return false;
    s.centre = *centre;
    s.radius = least;
    return true;
}

std::optional<Stride> begin_stride(const Platform& platform, const Strider& who, Vec2 place, float heading,
                                   RandomKey key) {
    Stride s{.centre = place, .heading = heading, .side = random_unit(key, 2) < 0.5f ? 1.0f : -1.0f};
    if (turn_to(platform, who, s, s.side, key) || turn_to(platform, who, s, -s.side, key) ||
        carry(platform, who, s))
        return s;
    return {};
}

bool advance_stride(const Platform& platform, const Strider& who, Stride& s, float seconds, RandomKey key) {
    if (!is_on(platform, who, s)) {
        const bool turns = turn_to(platform, who, s, -s.side, key) || turn_to(platform, who, s, s.side, key);
        if (!turns && !carry(platform, who, s)) return false;
    }
    s.left -= seconds;
    if (s.left <= 0) turn_to(platform, who, s, -s.side, key);
    s.heading = wrap_angle(s.heading - s.side * who.speed / s.radius * seconds);
    return true;
}

}  // namespace flaneur
