#include "sim/ball/ball.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_bounce = 0.4f, k_off_people = 0.25f;  // of the speed, from ground and from bodies
constexpr float k_least_bounce = 0.6f;                  // m/s, slower ones stay on the ground
constexpr float k_slips = 0.25f;                        // of the speed along it, lost in a bounce
constexpr float k_rolls = 0.35f;                        // m/s2, lost in rolling
constexpr float k_air = 0.02f;                          // 1/s
constexpr float k_steps_up = 0.05f;                     // metres below its middle that it rolls over

void bounce(Ball& b, Vec3 normal) {
    const float in = dot(b.velocity, normal);
    if (in >= 0) return;
    const bool stays = -in < k_least_bounce;
    const Vec3 along = b.velocity - normal * in;
    b.velocity = along * (stays ? 1.0f : 1 - k_slips) + normal * (stays ? 0.0f : -in * k_bounce);
}

// Up to what it hits first, and on from there, a few times.
void fly(Ball& b, const Ground& ground, float dt) {
    constexpr int k_most_hits = 3;
    float left = dt;
    for (int hits = 0; hits < k_most_hits; ++hits) {
        const float speed = length(b.velocity), far = speed * left;
        if (far < 1e-5f) return;
        const Vec3 along = b.velocity / speed;
        const auto met = raycast(ground, b.place, along, far + b.radius);
        if (!met) {
            b.place += along * far;
            return;
        }
        const Vec3 normal = dot(met->normal, along) > 0 ? -met->normal : met->normal;
        const float goes = clamp(met->distance - b.radius, 0, far);
        b.place += along * goes;
        left -= goes / speed;
        bounce(b, normal);
    }
}

void touch(Ball& b, const Ground& ground, const Surroundings& around, float dt) {
    if (const auto wall = closest_wall(ground, b.place, b.radius)) {
        const Vec3 off = b.place - wall->point;
        // Out of it, should the middle be behind.
        const Vec3 normal = dot(off, wall->normal) > 0 ? normalize_or(off, wall->normal) : wall->normal;
        b.place = wall->point + normal * b.radius;
        bounce(b, normal);
    }
    const auto under = ground_at(around, b.place, -k_steps_up, 2);
    if (!under || b.place.y - b.radius > under->height + 1e-3f) return;
    b.place.y = std::max(b.place.y, under->height + b.radius);
    bounce(b, under->normal);
    const float speed = length(b.velocity);
    if (speed > 1e-4f) b.velocity = b.velocity * (std::max(speed - k_rolls * dt, 0.0f) / speed);
}

// It turns as if it rolled wherever it goes.
void roll(Ball& b, float dt) {
    const Vec2 flat = on_ground(b.velocity);
    const float angle = length(flat) * dt / b.radius;
    if (angle < 1e-6f) return;
    const Vec2 way = flat / length(flat);
    b.turn = normalize(rotation_about({way.z, 0, -way.x}, angle) * b.turn);
}

void part(Ball& a, Ball& b) {
    const Vec3 off = a.place - b.place;
    const float far = length(off), touching = a.radius + b.radius;
    if (far >= touching || far < 1e-5f) return;
    const Vec3 normal = off / far;
    a.place += normal * (0.5f * (touching - far));
    b.place -= normal * (0.5f * (touching - far));
    const float gives = hit(a, normal, b.velocity, b.mass);
    b.velocity -= normal * (gives / b.mass);
}

}  // namespace

Ball thrown(const PlannedThrow& how) {
    Ball ball{.place = how.from, .mass = how.mass};
    const Vec3 way = how.at - how.from;
    const float far = length(on_ground(way)), v2 = how.speed * how.speed;
    if (far < 0.05f) {
        ball.velocity = normalize_or(way, {0, 1, 0}) * how.speed;
        return ball;
    }
    // The flatter of both parabolas.
    const float under = v2 * v2 - k_gravity * (k_gravity * far * far + 2 * way.y * v2);
    const float slope = under < 0 ? 1 : (v2 - std::sqrt(under)) / (k_gravity * far);
    const Vec2 ahead = on_ground(way) / far;
    const float level = how.speed / std::sqrt(1 + slope * slope);
    ball.velocity = {ahead.x * level, slope * level, ahead.z * level};
    return ball;
}

void step_balls(std::span<Ball> balls, const Ground& ground, const Surroundings& around, float dt) {
    for (Ball& b : balls) {
        b.velocity.y -= k_gravity * dt;
        b.velocity = b.velocity * (1 - k_air * dt);
        fly(b, ground, dt);
        touch(b, ground, around, dt);
        roll(b, dt);
    }
    for (size_t i = 0; i < balls.size(); ++i)
        for (size_t k = i + 1; k < balls.size(); ++k) part(balls[i], balls[k]);
}

float hit(Ball& b, Vec3 normal, Vec3 other, float mass) {
    const float nears = dot(b.velocity - other, normal);
    if (nears >= 0) return 0;
    const float gives = -(1 + k_off_people) * nears / (1 / b.mass + 1 / mass);
    b.velocity += normal * (gives / b.mass);
    return gives;
}

}  // namespace flaneur
