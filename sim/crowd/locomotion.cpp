#include "sim/crowd/locomotion.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_acceleration = 1.5f, k_braking = 2.6f;  // m/s2
static constexpr float k_quickening = 16, k_slowing = 6;         // 1/s, of the rest of a change of speed
static constexpr float k_turn_acceleration = 7;                  // rad/s2
static constexpr float k_spot_turn = 1.7f;                       // rad/s, of one who hardly goes,
static constexpr float k_walks = 0.4f;                           // m/s, slower than this; of one who walks
static constexpr float k_turn = 1.5f,
                       k_fastest_turn = 1.75f;  // so much times the root of the speed, and at most
// Shares of that while the inner, and while the outer foot swings: that lands in front of the inner one's
// toes and so has to wait in turns, radians, that are no bends.
static constexpr float k_opening = 1.4f, k_closing = 0.5f, k_bends = 0.3f, k_no_bends = 0.8f;
static constexpr float k_sideways = 2.2f;           // m/s2, turn rate times speed
static constexpr float k_turn_gain = 4;             // turn rate for each radian to turn, 1/s
static constexpr float k_turning_speed = 0.25f;     // m/s; slower wishes do not turn a body
static constexpr float k_forward = 24 * k_radians;  // velocity keeps this near the heading
static constexpr float k_any_way = 0.3f,
                       k_bound = 0.6f;         // m/s: so slow a step may go any way, and so fast not
static constexpr float k_pivot_speed = 0.15f;  // m/s, at least, of one who turns under way
static constexpr float k_some = 25 * k_radians,
                       k_far = 110 * k_radians;  // to turn, slows one down: begins, ends
static constexpr float k_eases = 0.45f;          // 1/s, of the speed, for a small turn
static constexpr float k_small_turn = 45 * k_radians, k_large_turn = 115 * k_radians;
static constexpr float k_climbs = 0.3f;  // of the speed, at least, however steep it is
static constexpr float k_runs = 2,
                       k_stair_run = 0.9f;  // m/s from which on one runs; and on stairs, of what is beyond
// 1/s, of the speed to lose, with which one brakes over a foot that has come down; m/s2, at least.
static constexpr float k_stops = 1.75f, k_gentlest = 1.2f;
// Of one with a pram: how nimble it is, 0..1; how fast at most the turn carries the pram's axle aside, of the
// speed and in m/s where that is slow; how far the body goes outward for that, of the speed, and as
// turned_forward bounds it.
static constexpr float k_pushing = 0.35f, k_rolls_on = 0.41f, k_round = 0.3f;
static constexpr float k_outward = 0.26f, k_most_outward = 0.63f;
static constexpr float k_bend = 0.4f;  // 1/m; narrower bends are taken slower
// Metres from the feet, and turn rates, between which one is more and more kept over them.
static constexpr float k_beside = 0.06f, k_far_beside = 0.14f, k_turns_0 = 0.6f, k_turns_1 = 1.2f;
// m/s, of speed to lose: one slows down; all at once. Seconds before a landing that are not worth a wait. The
// cosine of a way that is the same.
static constexpr float k_slows = 0.1f, k_at_once = 0.35f, k_about_down = 0.03f, k_same_way = 0.9f;

float stair_speed(float speed, float stair_pace) {
    float walk = clamp(0.42f * speed, 0.5f, 0.6f), run = clamp(k_stair_run * (speed - k_runs), 0.0f, 0.5f);
    if (stair_pace < 1) run = 0;  // with both feet on each
    return std::min(speed, stair_pace * (walk + run));
}

static float braking_over_a_foot(float speed_to_lose) {
    return clamp(k_stops * speed_to_lose, k_gentlest, k_braking);
}

float braking_way(float wished, float stair_pace) {
    constexpr float k_before = 0.25f, k_finishes = 0.25f;  // seconds; more, of one who finishes a step before
    const float slow = stair_speed(wished, stair_pace);
    if (wished <= slow) return 0;
    const bool runs = wished >= k_runs;
    const float brakes = runs ? k_braking : braking_over_a_foot(wished - slow);
    return (wished * wished - slow * slow) / (2 * brakes) +
           (runs ? k_before : k_before + k_finishes) * wished;
}

GroundHit slowing_ground(const Surroundings& around, const GroundHit& under, Vec3 place, Vec2 velocity,
                         float wished, float stair_pace) {
    float way = braking_way(wished, stair_pace);
    if (way <= 0 || under.kind == Surface::steps) return under;
    Vec2 ahead = normalize_or(velocity, {0, 0});
    for (float share : {1.0f, 0.5f}) {
        auto hit = ground_at(around, place + at_height(ahead * (share * way), 0), 3, 3);
        if (hit && hit->kind == Surface::steps) return *hit;
    }
    return under;
}

// How fast one may turn who goes at `speed` and would like to at `wished`.
static float fastest_turn(const Motion& motion, float to_turn, float speed, float wished) {
    const float inner = to_turn > 0 ? motion.feet.swings : -motion.feet.swings;
    const float waits = inner < 0 ? smoothstep(k_bends, k_no_bends, std::fabs(to_turn)) : 0;
    const float share = inner > 0 ? k_opening : lerp(1, k_closing, waits);
    const float walking = share * std::min(k_turn * std::sqrt(wished), k_fastest_turn);
    return lerp(k_spot_turn, walking, smoothstep(k_pivot_speed, k_walks, speed));
}

// Towards what is left to turn, without overshoot: a rate that can still be braked.
static float next_turn_rate(float rate, float fastest, float to_turn, float speed, float dt, float nimble) {
    float most = nimble * std::min(fastest, k_sideways / std::max(speed, 0.1f));
    float brake = std::sqrt(2 * 0.7f * (nimble * nimble * k_turn_acceleration) * std::fabs(to_turn));
    float wished = clamp(to_turn * k_turn_gain, -std::min(most, brake), std::min(most, brake));
    float change = nimble * nimble * k_turn_acceleration * dt;
    return clamp(wished, rate - change, rate + change);
}

// `v` turned about the shorter way until it is within `nimble` k_forward of the heading, `off` being its
// angle to it.
static Vec2 turned_forward(Vec2 v, float speed, float heading, float off, float nimble) {
    const float most = nimble * k_forward;
    if (std::fabs(off) <= most) return v;
    return heading_direction(heading + (off > 0 ? most : -most)) * speed;
}

Vec2 wish_on(const GroundHit& under, Vec2 wish, float stair_pace) {
    float speed = length(wish);
    if (speed < 1e-4f) return wish;
    if (under.kind == Surface::steps) return wish * (stair_speed(speed, stair_pace) / speed);
    if (under.normal.y > 0.99999f || under.normal.y < 0.1f) return wish;
    float rise = -dot(wish, {under.normal.x, under.normal.z}) / (speed * under.normal.y);
    // Tobler's hiking function, to where one climbs as on stairs.
    return wish * clamp(exponential(-3.5f * (std::fabs(rise + 0.05f) - 0.05f)), k_climbs, 1);
}

// How one slows down to a wish: whether one finishes the step before, and Motion::brakes.
struct Slowing {
    bool finishes_step = false;
    float brakes = 0;
};

static Slowing slowing_down(const Motion& motion, Vec2 wish) {
    const float speed = length(motion.velocity), wished = length(wish), to_lose = speed - wished;
    if (to_lose < k_slows) return {};
    if (motion.brakes > 0) return {false, motion.brakes};
    const bool was_asked = length(motion.aim) > speed - k_at_once;  // to go as fast; else it was pushed
    const bool same_way =
        wished < k_turning_speed || dot(wish, motion.velocity) > k_same_way * wished * speed;
    if (!was_asked || !same_way || to_lose < k_at_once || speed >= k_runs) return {false, k_braking};
    if (motion.feet.lands > k_about_down) return {true, 0};
    return {false, braking_over_a_foot(to_lose)};
}

// Of a velocity `v` that follows motion.velocity, what does not lead one who turns farther from the feet: a
// turn waits for the step.
static Vec2 kept_over_feet(const Motion& motion, Vec2 v) {
    const float off = length(motion.feet.beside);
    const float bound = smoothstep(k_beside, k_far_beside, off) *
                        smoothstep(k_turns_0, k_turns_1, std::fabs(motion.turn_rate));
    if (bound <= 0) return v;
    const Vec2 away = motion.feet.beside * (-1 / off);
    return v - away * (bound * std::max(dot(v - motion.velocity, away), 0.0f));
}

// How hard one who goes at `speed` brakes for a turn, m/s2: hardly for a small one, which is soon over.
static float turn_braking(float speed, float to_turn) {
    return lerp(k_eases * speed, k_braking, smoothstep(k_small_turn, k_large_turn, std::fabs(to_turn)));
}

Motion next_motion(const Motion& motion, Vec2 wish, float dt, Vec2 look, float lever) {
    const float nimble = lever > 0 ? k_pushing : 1;
    Vec2 v = motion.velocity;
    float wished = length(wish), speed = length(v);
    const Slowing slowing = slowing_down(motion, wish);
    if (slowing.finishes_step) wish = v, wished = speed;
    Vec2 aim = wish;
    const float least = std::min(speed, wished);

    bool turns = wished > k_turning_speed;
    bool looks = !turns && speed < k_turning_speed && length_squared(look) > 0;
    float to_turn = turns   ? wrap_angle(heading_of(wish) - motion.heading)
                    : looks ? wrap_angle(heading_of(look) - motion.heading)
                            : 0;
    float rate = next_turn_rate(motion.turn_rate, fastest_turn(motion, to_turn, speed, wished), to_turn,
                                speed, dt, nimble);
    if (lever > 0) {
        const float most = std::max(k_round, k_rolls_on * speed) / lever;
        rate = clamp(rate, -most, most);
    }
    float heading = wrap_angle(motion.heading + rate * dt);

    if (wished > k_any_way) {
        float off = wrap_angle(heading_of(wish) - heading);
        wish = turned_forward(wish, wished, heading, off, nimble);
        float turning = 1 - smoothstep(k_some, k_far, std::fabs(off));
        float bend = std::sqrt(std::min(1.0f, k_bend * wished / std::max(std::fabs(rate), 1e-3f)));
        float left = std::max(std::min(turning, bend), std::min(k_pivot_speed, speed) / wished);
        wish = wish * left;
        if (lever > 0) {
            const float most = std::max(k_round, k_outward * length(wish)),
                        out = clamp(rate * lever, -most, most);
            const Vec2 way = heading_direction(heading);
            wish = wish - Vec2{way.z, -way.x} * out;
            aim = wish;  // feet go where the body does
        } else {
            aim = aim * left;
        }
    }
    Vec2 change = wish - v;
    bool brakes = dot(change, v) < 0;
    float l = length(change), hardest = slowing.brakes > 0 ? slowing.brakes : k_braking;
    float step = std::min(l * (brakes ? k_slowing : k_quickening), brakes ? hardest : k_acceleration) * dt;
    if (l > 1e-6f) v += change * (std::min(step, l) / l);
    speed = length(v);
    const float keeps = least - turn_braking(least, to_turn) * dt;
    if (turns && lever == 0 && speed < keeps) {
        v = speed > 1e-3f ? v * (keeps / speed) : heading_direction(heading) * keeps;
        speed = keeps;
    }
    if (speed > k_any_way) {
        // Little by little, so that nobody who gets faster is thrown round.
        float bound = lever > 0 ? k_most_outward : nimble, any_way = k_pi / k_forward;
        v = turned_forward(v, speed, heading, wrap_angle(heading_of(v) - heading),
                           lerp(any_way, bound, smoothstep(k_any_way, k_bound, speed)));
    }
    if (lever == 0) v = kept_over_feet(motion, v);
    return {v, heading, rate, aim, slowing.brakes};
}

}  // namespace flaneur
