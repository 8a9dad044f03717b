#include "sim/gait/pram.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/math.h"
#include "sim/gait/rows.h"
#include "sim/gait/steps.h"

namespace flaneur {

namespace {

constexpr float k_most_aside = 0.13f;               // radians
constexpr float k_rolls = 0.15f, k_goes_on = 0.6f;  // m/s, from where it faces where it goes, and quite
constexpr float k_follows = 9;                      // 1/s, critically damped
constexpr float k_lifts = 0.35f;                    // metres from an edge within which wheels rise or sink
constexpr float k_even = 0.006f;                    // metres off the plane of the ground beside it: an edge
constexpr float k_up = 0.5f, k_down = 1;            // metres in which ground is looked for
constexpr float k_back = 1.5f;                      // 1/s, at which it comes back to the middle
constexpr float k_most_off = 0.04f;                 // metres that it is off that
constexpr float k_settles = 3;                      // 1/s, of how the body follows its handle as it tips
constexpr float k_steepest = 0.5f;                  // radians

// Where the ground is asked along a line of wheels. The pieces between are searched for edges.
constexpr int k_points = 8, k_at_rear = 2, k_at_front = 5;

struct Line {
    Vec3 from;  // the ground's place of the rear wheel
    Vec2 way;
    float scale;
    float base;  // to the front wheel as it is pitched, for a scale of 1
    Vec3 at(float along) const { return from + at_height(way * (along * scale), 0); }
};

float plane_height(const GroundHit& hit, Vec2 by) {
    return hit.height - (hit.normal.x * by.x + hit.normal.z * by.z) / std::max(hit.normal.y, 0.2f);
}

// How much higher the ground at `b` is than the plane of that at `a` says.
float off_plane(const GroundHit& a, const GroundHit& b, Vec2 by) { return b.height - plane_height(a, by); }

// What an edge does to heights along the line.
struct Edge {
    float along, height;  // of the step, up ahead where positive
};

std::optional<Edge> find_edge(const Surroundings& around, const Line& line, float from, float to, GroundHit a,
                              GroundHit b) {
    auto by = [&](float begin, float end) { return line.way * ((end - begin) * line.scale); };
    if (std::fabs(off_plane(a, b, by(from, to))) < k_even ||
        std::fabs(off_plane(b, a, by(to, from))) < k_even)
        return std::nullopt;
    for (int i = 0; i < 7; ++i) {
        float middle = 0.5f * (from + to);
        auto hit = ground_at(around, line.at(middle), k_up, k_down);
        if (!hit) return std::nullopt;
        if (std::fabs(off_plane(a, *hit, by(from, middle))) < k_even)
            from = middle, a = *hit;
        else
            to = middle, b = *hit;
    }
    return Edge{0.5f * (from + to), off_plane(a, b, by(from, to))};
}

// Heights of the ground under a rear wheel and the one in front of it, smooth over edges.
struct Heights {
    float rear, front;
};
Heights heights_on(const Surroundings& around, const Line& line) {
    const float f = line.base;
    const float along[k_points] = {-k_lifts, -k_lifts / 2,    0,          f / 3, 2 * f / 3,
                                   f,        f + k_lifts / 2, f + k_lifts};
    Vec3 points[k_points];
    std::optional<GroundHit> hits[k_points];
    for (int i = 0; i < k_points; ++i) points[i] = line.at(along[i]);
    ground_at(around, points, k_up, k_down, hits);
    float rear = hits[k_at_rear] ? hits[k_at_rear]->height : line.from.y;
    float front = hits[k_at_front] ? hits[k_at_front]->height : rear;
    float rear_lift = 0, front_lift = 0;
    for (int i = 0; i + 1 < k_points; ++i) {
        if (!hits[i] || !hits[i + 1]) continue;
        auto edge = find_edge(around, line, along[i], along[i + 1], *hits[i], *hits[i + 1]);
        if (!edge) continue;
        auto lift = [&](float at) {
            float off = edge->height > 0 ? edge->along - at : at - edge->along;
            return off < 0 ? 0 : std::fabs(edge->height) * smoothstep(k_lifts, 0, off);
        };
        rear_lift = std::max(rear_lift, lift(0));
        front_lift = std::max(front_lift, lift(f));
    }
    return {rear + rear_lift, front + front_lift};
}

// Where the ground between the rear wheels is to be, for the handle to be right ahead of the body.
Vec2 wished_place(const Pram& pram, const Stepper& s, Vec2 way) {
    SinCos pitch = sin_cos(pram.slope);
    float behind = k_pram_behind * pram.scale * pitch.cosine + pram.handle.y * pitch.sine;
    return on_ground(s.root) + s.facing * pram.handle.z + way * behind;
}

// Which way it is to face aside from the heading: where the axle is to go, that is `lever` ahead of the root.
float wished_aside(const Pram& pram, const Stepper& s, float lever) {
    Vec2 left{s.facing.z, -s.facing.x};
    Vec2 goes = s.velocity + left * (s.turn_rate * lever + k_back * pram.off);
    float ahead = dot(goes, s.facing), speed = length(goes);
    if (ahead < k_rolls) return 0;
    return clamp(arctan2(dot(goes, left), ahead), -k_most_aside, k_most_aside) *
           smoothstep(k_rolls, k_goes_on, speed);
}

// One that `rolls` goes ahead and back from where it was, and aside only where the hands would not reach it.
void set_on_ground(Pram& pram, const Stepper& s, bool rolls) {
    float yaw = wrap_angle(s.heading + pram.aside);
    Vec2 way = heading_direction(yaw), left{way.z, -way.x};
    Vec2 at = wished_place(pram, s, way);
    if (rolls) {
        pram.off = dot(at - on_ground(pram.now.place), left);
        at += left * (clamp(pram.off, -k_most_off * pram.scale, k_most_off * pram.scale) * -1);
        pram.off = clamp(pram.off, -k_most_off * pram.scale, k_most_off * pram.scale);
    }
    const float base = k_pram_base * sin_cos(pram.now.pitch).cosine;
    Heights sides[2];
    for (int side : {k_left, k_right}) {
        float out = (side == k_left ? 0.5f : -0.5f) * k_pram_track * pram.scale;
        sides[side] = heights_on(s.around, {at_height(at + left * out, s.root.y), way, pram.scale, base});
    }
    float rear = 0.5f * (sides[k_left].rear + sides[k_right].rear);
    float front = 0.5f * (sides[k_left].front + sides[k_right].front);
    float higher =
        0.5f * (sides[k_left].rear + sides[k_left].front - sides[k_right].rear - sides[k_right].front);
    auto slope = [&](float rise, float run) {
        return clamp(arctan2(rise, run * pram.scale), -k_steepest, k_steepest);
    };
    pram.now = {at_height(at, rear), yaw, slope(front - rear, base), slope(higher, k_pram_track),
                pram.now.wheel};
}

}  // namespace

Quat pram_rotation(const PramPlace& p) {
    return rotation_y(p.yaw) * rotation_x(-p.pitch) * rotation_z(p.roll);
}

Vec3 pram_handle(const Pram& pram, const PramPlace& place, float side) {
    const float s = pram.scale;
    return place.place +
           rotate(pram_rotation(place), Vec3{side * k_pram_grip * s, pram.handle.y, -k_pram_behind * s});
}

PramPlace mixed_place(const PramPlace& a, const PramPlace& b, float t) {
    return {lerp(a.place, b.place, t), a.yaw + wrap_angle(b.yaw - a.yaw) * t, lerp(a.pitch, b.pitch, t),
            lerp(a.roll, b.roll, t), a.wheel + wrap_angle(b.wheel - a.wheel) * t};
}

void advance_pram(Pram& pram, const Stepper& s) {
    pram.before = pram.now;
    float aside = wished_aside(pram, s, pram.handle.z + k_pram_behind * pram.scale);
    const int steps = spring_steps(s.dt);
    const float dt = s.dt / static_cast<float>(steps);
    for (int k = 0; k < steps; ++k) {
        pram.aside_rate += ((aside - pram.aside) * k_follows - 2 * pram.aside_rate) * (k_follows * dt);
        pram.aside += pram.aside_rate * dt;
    }
    set_on_ground(pram, s, true);
    pram.slope += (pram.now.pitch - pram.slope) * std::min(k_settles * s.dt, 1.0f);
    Vec3 by = pram.now.place - pram.before.place;
    float rolled = dot(on_ground(by), heading_direction(pram.now.yaw)) / (k_pram_rear * pram.scale);
    float turned = wrap_angle(pram.now.wheel + rolled);
    pram.now.wheel = turned < 0 ? turned + 2 * k_pi : turned;
}

Span prams_of(const Gait& gait, size_t begin, size_t end) { return span_of(gait.prams, begin, end); }

void give_pram(Gait& gait, size_t walker, Vec3 handle, float scale, const Stepper& stepper) {
    auto at = take_away(gait.prams, walker);
    if (handle == Vec3{}) return;
    Pram pram;
    pram.walker = static_cast<uint32_t>(walker);
    pram.scale = scale;
    pram.handle = handle * scale;
    // As pitched as the ground is where it then stands.
    for (int i = 0; i < 4; ++i) {
        set_on_ground(pram, stepper, false);
        pram.slope = pram.now.pitch;
    }
    pram.before = pram.now;
    gait.prams.insert(at, pram);
}

}  // namespace flaneur
