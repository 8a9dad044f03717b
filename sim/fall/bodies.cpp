#include "sim/fall/bodies.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/fall/lane.h"

namespace flaneur {

namespace {

// Balls that it is between, and which are as thick at their ends: trunk, neck, arms, legs.
struct Capsule {
    int from, to;
};
constexpr Capsule k_capsules[] = {{0, 1},   {0, 2},   {1, 2},   {2, 5},   {3, 4},   {3, 5},
                                  {4, 5},   {5, 6},   {3, 7},   {7, 9},   {4, 15},  {15, 17},
                                  {0, 10},  {10, 11}, {11, 12}, {12, 13}, {13, 14}, {1, 18},
                                  {18, 19}, {19, 20}, {20, 21}, {21, 22}};

}  // namespace

Nearest nearest_to(const BodyInTheWay& body, Vec3 ball, float radius) {
    Nearest nearest;
    for (const Capsule& c : k_capsules) {
        const auto i = static_cast<size_t>(c.from), j = static_cast<size_t>(c.to);
        const Vec3 along = body.balls[j] - body.balls[i];
        const float t =
            clamp(dot(ball - body.balls[i], along) / std::max(length_squared(along), 1e-8f), 0, 1);
        const Vec3 at = body.balls[i] + along * t, off = ball - at;
        const float thick = lerp(body.radius[i], body.radius[j], t), far = length(off);
        const float clear = far - thick - radius;
        if (clear >= nearest.clear) continue;
        nearest.clear = clear;
        nearest.normal = normalize_or(off, {0, 1, 0});
        nearest.touches = at + nearest.normal * thick;
    }
    return nearest;
}

void meet_body(TumblePlanes& planes, int lane, const TumbleBlock& block, const TumbleShapes& shapes,
               Vec3 origin, const BodyInTheWay& body) {
    constexpr float k_foreseen = 0.08f, k_spare = 0.1f, k_pressed = -0.3f;  // seconds, metres, of a normal
    for (int k = 0; k < k_ball_count; ++k) {
        const BallMotion ball = ball_motion(block, shapes, k, lane, origin);
        const float radius = shapes.radius[k][lane];
        const Nearest near = nearest_to(body, ball.place, radius);
        if (near.clear > k_spare + k_foreseen * length(ball.velocity) || near.normal.y < k_pressed) continue;
        const float has =
            dot(row_of(planes.wall[k], lane), ball.place - origin) - planes.wall_offset[k][lane] - radius;
        if (has < near.clear) continue;
        planes.has_walls = 1;
        set_row(planes.wall[k], lane, near.normal);
        planes.wall_offset[k][lane] = dot(near.normal, near.touches - origin);
    }
}

bool lies_on(const BodyInTheWay& upper, const BodyInTheWay& lower) {
    constexpr float k_touch = 0.03f, k_above = 0.5f;
    for (const size_t k : {0, 1, 2, 3, 4, 5, 6, 10, 18}) {
        const Nearest near = nearest_to(lower, upper.balls[k], upper.radius[k]);
        if (near.clear < k_touch && near.normal.y > k_above) return true;
    }
    return false;
}

}  // namespace flaneur
