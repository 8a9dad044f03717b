#include "sim/surface/leap.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_feet_leave = 0.1f;    // seconds in which the ground below is not landed on
constexpr float k_turns_after = 0.22f;  // seconds
constexpr float k_head = 0.85f;         // of the middle's height, over the middle
constexpr float k_upright = 0.985f;     // cosine of what one may lean on landing,
constexpr float k_most_aside = 1.4f;    // and how fast one may go along the ground, m/s
constexpr float k_most_crouch = 0.42f;  // of the leg
constexpr float k_cubic = 4.0f / 27;    // the most that x (1 - x)^2 is

Vec3 rotated(Vec3 v, Vec3 axis, float angle) {
    const SinCos s = sin_cos(angle);
    return v * s.cosine + cross(axis, v) * s.sine + axis * (dot(axis, v) * (1 - s.cosine));
}

// Up and ahead turned so that up comes nearer to `wanted`. Where that is straight below, head over heels
// forwards.
void turn_over(Flyer& f, Vec3 wanted, float& rate, float dt) {
    constexpr float k_opposite = 0.1f;
    const float angle = arccos(clamp(dot(f.up, wanted), -1, 1));
    rate =
        std::min({rate + k_flight_turn_gain * dt, k_flight_turn, std::sqrt(2 * k_flight_turn_gain * angle)});
    const float by = std::min(rate * dt, angle);
    if (by < 1e-5f) return;
    Vec3 axis = cross(f.up, wanted);
    const float size = length(axis);
    if (size > k_opposite)
        axis = axis / size;
    else if (dot(f.up, wanted) < 0)
        axis = normalize_or(cross(f.up, f.ahead), {1, 0, 0});
    else
        axis = normalize_or(axis, {});
    f.up = normalize_or(rotated(f.up, axis, by), f.up);
    const Vec3 ahead = rotated(f.ahead, axis, by);
    f.ahead = normalize_or(ahead - f.up * dot(ahead, f.up), f.ahead);
}

}  // namespace

bool fly_on(const Compound& c, const Gravity& g, Flyer& f, Leap& leap, float dt) {
    Vec3 middle = f.position + f.up * f.middle;
    leap.velocity += pull_at(g, middle).all * dt;
    middle += leap.velocity * dt;
    leap.seconds += dt;
    if (leap.seconds > k_turns_after)
        turn_over(f, normalize_or(-pull_of(g, leap.to, middle), f.up), leap.turn, dt);
    f.position = middle - f.up * f.middle;
    if (leap.seconds < k_feet_leave) return false;
    const auto hit = cast_ray(c, middle, -f.up, f.middle);
    if (!hit) return false;
    f.position = leap.place = hit->point;
    leap.normal = hit->normal;
    leap.landing = std::max(-dot(leap.velocity, hit->normal), 0.0f);
    return true;
}

bool is_good_landing(const Gravity& g, const Flyer& f, const Leap& leap) {
    const float down = dot(leap.velocity, leap.normal);
    const float aside = length(leap.velocity - leap.normal * down);
    return dot(f.up, leap.normal) > k_upright && aside < k_most_aside && -down < k_fastest_landing &&
           down < 0 && pull_at(g, f.position).body == leap.to;
}

bool is_clear_between(const Compound& c, const Flyer& before, const Flyer& after) {
    auto is_clear = [&](float high) {
        const Vec3 from = before.position + before.up * high, way = after.position + after.up * high - from;
        const float far = length(way);
        return far < 1e-5f || !cast_ray(c, from, way / far, far);
    };
    return is_clear(before.middle) && is_clear(before.middle * (1 + k_head));
}

std::optional<SurfaceHit> body_overhead(const Compound& c, const Gravity& g, const Flyer& f) {
    const auto hit = cast_ray(c, f.position + f.up * (f.middle * (1 + k_head)), f.up, k_leap_reach);
    if (!hit || pull_at(g, hit->point).body == pull_at(g, f.position).body) return std::nullopt;
    return hit;
}

float leap_crouch(const Leap& leap, float leg) {
    const bool lands = leap.stage == LeapStage::absorbs;
    if (!lands && leap.stage != LeapStage::crouches) return 0;
    const float speed = lands ? leap.landing : length(leap.velocity);
    const float whole = lands ? k_absorb_seconds : k_crouch_seconds;
    // In less time where legs are short, so that they do not fold up.
    const float seconds = std::min(whole, k_most_crouch * leg / std::max(speed * k_cubic, 1e-3f));
    const float x = clamp((lands ? leap.seconds : leap.seconds - (whole - seconds)) / seconds, 0, 1);
    return speed * seconds * (lands ? x * (1 - x) * (1 - x) : x * x * (1 - x));
}

}  // namespace flaneur
