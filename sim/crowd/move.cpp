// What legs can do with the chosen velocity: bounded acceleration and turning, forward walking, and never off
// the mesh.
#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"

namespace flaneur {

static constexpr float k_acceleration = 1.8f, k_braking = 2.6f;  // metres a second squared
static constexpr float k_turn_acceleration = 9;                  // radians a second squared
static constexpr float k_fastest_turn = 2.5f;                    // radians a second
static constexpr float k_sideways = 2.2f;  // of a turning walker, metres a second squared: turn rate * speed
static constexpr float k_turn_gain = 4;    // turn rate for each radian to turn, 1/s
static constexpr float k_turning_speed = 0.25f;     // slower wishes do not turn a body, metres a second
static constexpr float k_forward = 24 * k_radians;  // velocity keeps this near the heading
static constexpr float k_any_way = 0.3f;            // metres a second: so slow a step may go any way
static constexpr float k_overlap = 0.015f;          // metres that bodies may press into each other
static constexpr float k_push = 0.008f;             // metres that they are parted by in a tick, at most
static constexpr int k_pushers = 6;                 // the nearest neighbours that can press

// Turns the heading towards the wished direction, without overshoot: the turn rate is one that can still be
// braked.
static float next_turn_rate(float rate, float to_turn, float speed) {
    float most = std::min(k_fastest_turn, k_sideways / std::max(speed, 0.1f));
    float brake = std::sqrt(2 * 0.7f * k_turn_acceleration * std::fabs(to_turn));
    float wished = clamp(to_turn * k_turn_gain, -std::min(most, brake), std::min(most, brake));
    float change = k_turn_acceleration * k_tick;
    return clamp(wished, rate - change, rate + change);
}

// `v` turned about the shorter way until it is within k_forward of the heading.
static Vec2 turned_forward(Vec2 v, float speed, float heading, float off) {
    if (std::fabs(off) <= k_forward) return v;
    return heading_direction(heading + (off > 0 ? k_forward : -k_forward)) * speed;
}

static Vec2 push_apart(const Crowd& c, uint32_t i) {
    Vec2 push{0, 0};
    const uint32_t* ids = &c.neighbours[size_t{i} * k_neighbours];
    for (int k = 0; k < std::min<int>(c.neighbour_count[i], k_pushers); ++k) {
        uint32_t j = ids[k];
        Vec2 away = on_ground(c.position[i] - c.position[j]);
        float touching = c.radius[i] + c.radius[j] - k_overlap, d2 = length_squared(away);
        if (d2 >= touching * touching) continue;
        float d = std::sqrt(d2);
        Vec2 direction = d > 1e-5f ? away / d : Vec2{i < j ? 1.0f : -1.0f, 0};
        push += direction * ((touching - d) * 0.5f);
    }
    float l = length(push);
    return l > k_push ? push * (k_push / l) : push;
}

static void move_walker(Crowd& c, const City& city, const Navmesh& mesh, int thread, uint32_t i) {
    Vec2 wish = c.chosen[i], v = c.velocity[i];
    float wished_speed = length(wish), speed = length(v);

    float to_turn = wished_speed > k_turning_speed ? wrap_angle(heading_of(wish) - c.heading[i]) : 0;
    float rate = next_turn_rate(c.turn_rate[i], to_turn, speed);
    float heading = wrap_angle(c.heading[i] + rate * k_tick);
    c.turn_rate[i] = rate;
    c.heading[i] = heading;

    // One who must turn far slows down for it, at last to turning on the spot.
    if (wished_speed > k_any_way) {
        float off = wrap_angle(heading_of(wish) - heading);
        float keep = 1 - smoothstep(25 * k_radians, 95 * k_radians, std::fabs(off));
        wish = turned_forward(wish, wished_speed, heading, off) * keep;
    }
    Vec2 change = wish - v;
    float most = (dot(change, v) < 0 ? k_braking : k_acceleration) * k_tick, l = length(change);
    v += l > most ? change * (most / l) : change;
    speed = length(v);
    if (speed > k_any_way) v = turned_forward(v, speed, heading, wrap_angle(heading_of(v) - heading));

    Vec3 from = c.position[i];
    Vec2 step = v * k_tick + push_apart(c, i);
    NavPoint to = move_along(mesh, thread, {from, c.polygon[i]}, from + at_height(step, 0));
    Vec2 moved = on_ground(to.position - from);
    // Stopped or turned aside by the border: velocity is what became of it.
    if (length_squared(moved - step) > 1e-8f) {
        Vec2 real = moved / k_tick;
        float r = length(real);
        v = r > speed ? real * (speed / r) : real;
    }
    to.position.y = from.y;
    if (auto hit = ground(city, to.position, 0.5f, 1.5f)) to.position.y = hit->height;
    c.next_position[i] = to.position;
    c.next_velocity[i] = v;
    c.next_polygon[i] = to.polygon;
}

void move(Crowd& c, const City& city, const Navmesh& mesh, Workers& workers) {
    // In the order of places, so that walkers who share ground and mesh find them in the cache.
    auto move_some = [&](size_t begin, size_t end, int thread) {
        for (size_t k = begin; k < end; ++k) move_walker(c, city, mesh, thread, c.sorted[k].id);
    };
    parallel_for(workers, c.count, 256, std::ref(move_some));
    c.position.swap(c.next_position);
    c.velocity.swap(c.next_velocity);
    c.polygon.swap(c.next_polygon);
}

}  // namespace flaneur
