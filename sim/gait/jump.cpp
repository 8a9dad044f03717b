#include "sim/gait/jump.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/gait/curves/norms.h"

namespace flaneur {

static constexpr float k_push_off = 0.6f;  // of the leading foot's swing, when the other foot leaves
static constexpr float k_follows = 0.2f,   // of the other foot's swing, when the leading foot lands,
    k_run_follows = 0.45f;                 // of one who runs
static constexpr float k_absorb = 0.45f;   // seconds of crouch after a jump,
static constexpr float k_runs_on = 0.2f;   // of one who runs on
static constexpr float k_bent = 0.04f;     // metres of crouch in which one lands
static constexpr float k_usual = 0.36f;    // seconds of flight,
static constexpr float k_runs = 0.3f;      // of a leap from a run
static constexpr float k_longest = 0.62f;
static constexpr float k_hop_steps = 1.5f;      // cycles/s, as which a hop plans its landing
static constexpr float k_forward_reach = 0.4f;  // metres, of the leading foot before the root
static constexpr float k_standing = 0.3f;       // m/s; slower walkers hop

void begin_jump(GaitBlock& g, int lane) {
    if (g.jump[lane] > 0) return;
    g.jump[lane] = 1e-4f;
    g.flight[lane] = 0;
}

static float follows(const GaitBlock& g, int lane) { return lerp(k_follows, k_run_follows, g.running[lane]); }

// Seconds from the leading foot's toe-off until the other one's.
static float push_seconds(const GaitBlock& g, int lane) {
    return k_push_off * (1 - g.duty[lane]) / g.frequency[lane];
}

static float flight_seconds(const GaitBlock& g, const Stepper& s) {
    float speed = std::max(length(s.velocity), k_standing), y = g.base[s.lane];
    Vec2 direction = normalize_or(s.velocity, s.facing);
    FarSide far = far_side(s.around, {s.root.x, y, s.root.z}, direction, k_longest_jump);
    if (far.distance <= 0) return lerp(k_usual, k_runs, g.running[s.lane]);
    float over = (far.distance + 0.15f - k_forward_reach) / speed - push_seconds(g, s.lane);
    return clamp(std::max(over, k_usual + 0.3f * std::max(far.height - y, 0.0f)), k_usual, k_longest);
}

void commit_leap(GaitBlock& g, const Stepper& s, Side side) {
    begin_jump(g, s.lane);
    g.flight[s.lane] = flight_seconds(g, s);
    g.first[s.lane] = side;
    // In a run the other foot is ahead already, and this one has pushed.
    Side other = side == k_left ? k_right : k_left;
    if (!g.feet[other].swinging[s.lane]) return;
    g.first[s.lane] = other;
    g.jump[s.lane] = k_jump_crouch;
}

// The crouch before and after a flight of `flight` seconds: cubic curves that meet the parabola of the flight
// at its speed. `share` runs from 0 to 1.
static float crouch_before(float flight, float seconds, float share) {
    return 0.5f * k_gravity * flight * seconds * share * share * (1 - share);
}
static float crouch_after(float flight, float seconds, float share) {
    return crouch_before(flight, seconds, 1 - share);
}

// Both feet of one who stands.
static bool advance_hop(GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    float share = std::min(g.jump[lane] / k_jump_crouch, 1.0f);
    g.crouch[lane] = crouch_before(k_usual, k_jump_crouch, share);
    g.standing[lane] = 1;
    if (share < 1) return true;
    g.jump[lane] = k_jump_crouch;
    g.flight[lane] = k_usual;
    g.standing[lane] = 0;
    g.first[lane] = -1;
    for (Side side : {k_left, k_right}) {
        g.feet[side].phase[lane] = g.duty[lane];
        lift_off(g, s, side, k_usual, k_hop_steps);
    }
    return true;
}

// From the leading foot's toe-off to the other's.
static void advance_push(GaitBlock& g, const Stepper& s, Side lead) {
    int lane = s.lane;
    float duty = g.duty[lane], f = g.frequency[lane], swings = 1 - duty, flight = g.flight[lane];
    float &phase = g.feet[lead].phase[lane], &other = g.feet[1 - lead].phase[lane];
    phase = std::max(phase, duty) + f * s.dt;
    float share = std::min((phase - duty) / (k_push_off * swings), 1.0f);
    float seconds = push_seconds(g, lane);
    g.crouch[lane] = crouch_before(flight, seconds, share);
    other = std::min(other + std::max(f, (duty - other) / std::max(seconds * (1 - share), s.dt)) * s.dt,
                     duty - 1e-4f);
    swing(g, s, lead, seconds * (1 - share) + flight, f);
    g.jump[lane] = 1e-4f;
    if (share < 1) return;
    g.jump[lane] = k_jump_crouch;
    other = duty;
    lift_off(g, s, lead == k_left ? k_right : k_left, flight + (1 - follows(g, lane)) * swings / f, f);
}

static void fly(GaitBlock& g, const Stepper& s, float up) {
    int lane = s.lane;
    float duty = g.duty[lane], flight = g.flight[lane];
    g.crouch[lane] = k_bent * smoothstep(0.4f, 1, up / flight);
    g.lift[lane] = 0.5f * k_gravity * up * (flight - up);
    float share = up / flight, moves = s.dt / (flight - up + s.dt);
    for (Side side : {k_left, k_right}) {
        bool hops = g.first[lane] < 0, leads = hops || side == g.first[lane];
        float &phase = g.feet[side].phase[lane], end = duty + (1 - duty) * (leads ? 1 : follows(g, lane));
        phase += (end - phase) * moves;
        g.feet[side].forefoot[lane] = std::max(g.feet[side].forefoot[lane], share);  // its ball comes first
        float after = leads ? 0 : (1 - follows(g, lane)) * (1 - duty) / g.frequency[lane];
        swing(g, s, side, flight - up + after, hops ? k_hop_steps : g.frequency[lane]);
    }
}

static void land(GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    g.lift[lane] = 0;
    for (Side side : {k_left, k_right}) {
        if (g.first[lane] >= 0 && side != g.first[lane]) continue;
        g.feet[side].phase[lane] = 0;
        touch_down(g, s, side);
    }
    if (g.first[lane] < 0) g.standing[lane] = 1;
    g.first[lane] = -1;
}

bool advance_jump(GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    float &t = g.jump[lane], &flight = g.flight[lane];
    if (t <= 0) return false;
    bool left = g.feet[k_left].swinging[lane] != 0, right = g.feet[k_right].swinging[lane] != 0;
    if (flight <= 0) {
        // Asked for: one who walks goes on to the next toe-off.
        bool hops = !left && !right && (length(s.velocity) < k_standing || t > 2 * s.dt);
        if (hops) t += s.dt;
        return hops && advance_hop(g, s);
    }
    if (t < k_jump_crouch) {
        advance_push(g, s, static_cast<Side>(g.first[lane]));
        return true;
    }
    t += s.dt;
    float up = t - k_jump_crouch;
    if (up < flight) {
        fly(g, s, up);
        return true;
    }
    if (up - s.dt < flight) land(g, s);
    float absorb = lerp(k_absorb, k_runs_on, g.running[lane]);
    float share = std::min((up - flight) / absorb, 1.0f);
    g.crouch[lane] = crouch_after(flight, absorb, share) + k_bent * (1 - smoothstep(0, 1, share));
    if (share >= 1) t = flight = 0;
    return g.standing[lane] && share > 0 && share < 0.2f;
}

}  // namespace flaneur
