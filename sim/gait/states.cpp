#include "sim/gait/states.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/body/body.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/curves/norms.h"
#include "sim/gait/jump.h"
#include "sim/gait/rest.h"

namespace flaneur {

static constexpr float k_slack = 0.13f, k_stopping_slack = 0.08f;  // metres that a standing foot may be off
static constexpr float
    k_steep_steps = 0.8f,
    k_steep_from = 0.14f;  // and by so many more for each metre climbed or come down in one walked beyond
static constexpr float k_quickest_before = 1.3f,
                       k_quickest_on_stairs = 2.4f;  // cycles/s, where the way rises or falls
static constexpr float k_climbs = 0.15f;             // so much for each metre
static constexpr float k_shuffle = 0.95f;            // cycles/s of stepping on the spot, aside and back
static constexpr float k_starts = 0.25f;             // seconds ahead, for whose speed a start is quick,
static constexpr float k_started = 1.1f;             // m/s, at most
static constexpr float k_hasty = 1.5f;               // cycles/s of catching a push
static constexpr float k_out_of_reach = 0.74f;       // legs; a foot farther from home leaves at once
static constexpr float k_lost = 1.3f;                // legs; one farther than this is set down anew
static constexpr float k_inner_first = 1;  // steps off, that the inner foot of a turn counts as farther
static constexpr float k_early =
    0.009562f;  // of the cycle, by which the body trusts a foot before it is down
static constexpr float k_hurry =
    25;  // 1/s for each leg that a foot is too far behind, added to its phase's rate
static constexpr float k_just_landed = 0.25f;  // of the cycle, in which one does not leave again
static constexpr float k_aside = 0.5f;         // of the metres aside, that a foot counts as farther from home
static constexpr float k_late = 0.06f, k_hasty_swing = 1.8f;  // metres, behind time; of the frequency
static constexpr float k_quicken = 10;                        // 1/s2, of the rate of a swing
static constexpr float k_rise = 4.5f;                         // 1/s, of the phase of a foot that begins
static constexpr float k_close = 2;                           // 1/s, the least such rate when standing
static constexpr float k_comes_down = 0.05f, k_effort = 8;    // metres, m/s2; see time_to_come_down
static constexpr float k_shift = 16, k_shift_starting = 32, k_shift_walking = 1e6f;  // 1/s2, of the load
static constexpr float k_drop = 0.07f;  // metres down, from which on a foot lands on its ball
static constexpr float k_steep_0 = 0.2f, k_steep_1 = 0.36f;            // rise of the ground, likewise
static constexpr float k_just_below = 1e-4f;                           // of the phase
static constexpr float k_farthest_look = 0.6f, k_fastest_look = 3.0f;  // rad ahead of the body, rad/s

namespace {

// Most are within already.
float wrap_phase(float p) { return p >= 0 && p < 1 ? p : p - std::floor(p); }
// In [-1/2, 1/2).
float wrap_difference(float d) { return d >= -0.5f && d < 0.5f ? d : d - std::floor(d + 0.5f); }

float wanted_frequency(const GaitBlock& g, const Stepper& s, float speed, const Misfit (&off)[2]) {
    int lane = s.lane;
    float stride = stride_length(std::max(speed, 0.05f), s.leg_length) * s.person.stride[lane];
    stride *= lerp(k_short_stride, 1.0f, std::max(g.course[lane], 0.0f));
    if (g.tread[lane] > 0) {
        stride = sets_both_feet(s.leg_length) ? g.tread[lane] : 2 * g.tread[lane];
        bool climbs = std::fabs(g.rise[lane]) > k_climbs;
        if (speed > (climbs ? k_quickest_on_stairs : k_quickest_before) * stride) stride *= 2;
    }
    // A place that lies farther than the foot would go is reached later.
    for (const FootBlock& foot : g.feet) {
        Vec2 beyond{foot.goal.x[lane] - foot.wished_x[lane], foot.goal.z[lane] - foot.wished_z[lane]};
        if (!foot.swinging[lane] || (beyond.x == 0 && beyond.z == 0)) continue;
        float farther = dot(beyond, normalize_or(s.velocity, s.facing));
        stride *= 1 + clamp(1.5f * farther / stride, -0.25f, 0.25f);
    }
    float f =
        lerp(speed / stride, run_frequency(speed, s.leg_length), g.running[lane]) * (1 + g.quicker[lane]);
    float twist = std::max(off[k_left].twist, off[k_right].twist);
    // Steep ways are taken in short steps.
    float steep = 0;
    for (const FootBlock& foot : g.feet)
        steep = std::max(
            steep, std::fabs(foot.to.normal_x[lane] * s.facing.x + foot.to.normal_z[lane] * s.facing.z));
    float slowest = k_slowest + k_steep_steps * std::max(steep - k_steep_from, 0.0f);
    f = std::max(f, twist > 0.5f || speed < 0.12f || g.course[lane] < 0.5f ? k_shuffle : slowest);
    // A foot left behind, by a push say, is fetched sooner.
    float behind = 0;
    for (Side side : {k_left, k_right}) {
        if (!g.feet[side].swinging[lane]) behind = std::max(behind, off[side].distance);
    }
    bool pushed =
        behind > k_out_of_reach * s.leg_length || (g.amplitude[lane] < 0.3f && behind > 2 * k_slack);
    return pushed ? std::max(f, k_hasty) : f;
}

// Who starts takes the first step as quickly as the next.
float speed_soon(const Stepper& s) {
    float speed = length(s.velocity);
    if (speed >= k_started) return speed;
    return std::max(speed, std::min(length(expected_velocity(s, k_starts)), k_started));
}

// The foot that begins: the one left behind, the inner one of a turn, the one on the side of a step aside.
Side first_foot(const Stepper& s, const Misfit (&off)[2], float slack) {
    Vec2 left{s.facing.z, -s.facing.x};
    Vec2 motion = length_squared(s.velocity) > length_squared(s.wish) ? s.velocity : s.wish;
    float bias = 0.15f * dot(normalize_or(motion, {0, 0}), left) + 0.05f * clamp(s.turn_rate, -1, 1);
    float l = off[k_left].behind, r = off[k_right].behind;
    if (length_squared(motion) < 0.01f) {
        l = off[k_left].amount(slack), r = off[k_right].amount(slack);
        bias += k_inner_first * clamp(s.turn_rate, -1, 1);
    }
    return l - r + bias >= 0 ? k_left : k_right;
}

bool may_leave(const GaitBlock& g, const Stepper& s, Side side) {
    const FootBlock& other = g.feet[1 - side];
    if (g.running[s.lane] > 0.5f) return true;
    return !other.swinging[s.lane] && other.phase[s.lane] > 0;
}

void leave(GaitBlock& g, const Stepper& s, Side side, float rate) {
    float duty = g.duty[s.lane], f = g.frequency[s.lane];
    float& phase = g.feet[side].phase[s.lane];
    // However quickly it was called, and however long the tick, its swing begins at the beginning.
    phase = clamp(phase, duty, std::min(duty + rate * s.dt, (1 + duty) / 2));
    if (g.jump[s.lane] > 0 && g.flight[s.lane] <= 0) commit_leap(g, s, side);
    g.feet[side].rate[s.lane] = rate;
    g.quicker[s.lane] = s.person.unevenness[s.lane] * random_normal(s.chance, 1) +
                        (side == k_left ? s.person.limp[s.lane] : -s.person.limp[s.lane]);
    if (lift_off(g, s, side, (1 - phase) / rate, f)) return;
    commit_leap(g, s, side);
    lift_off(g, s, side, (1 - phase) / f, f);
}

// Stands, with the weight wandering, until a foot is wanted elsewhere; then gives the body to the other leg.
void stand(GaitBlock& g, const Stepper& s, bool wants_step, bool in_haste, const Misfit (&off)[2],
           float slack) {
    int lane = s.lane;
    for (Side side : {k_left, k_right}) {
        // The heel of the foot that begins rises while the load leaves it.
        bool begins = wants_step && side == g.first[lane];
        approach(g.feet[side].phase[lane], begins ? g.duty[lane] - k_just_below : k_rest,
                 (begins ? (in_haste ? 3 : 1) * k_rise : 1.5f) * s.dt);
    }
    if (!wants_step) {
        g.first[lane] = -1;
        return;
    }
    if (g.first[lane] < 0)
        g.first[lane] =
            g.restless[lane] >= 0 ? g.restless[lane] : static_cast<int32_t>(first_foot(s, off, slack));
    Side side = static_cast<Side>(g.first[lane]);
    float carried = side == k_left ? g.load[lane] : 1 - g.load[lane];
    if ((carried > 0.15f && !in_haste) || g.feet[side].phase[lane] < g.duty[lane] - 1e-3f) return;
    g.first[lane] = g.restless[lane] = -1;
    if (length(s.velocity) < k_standing_speed && !astride(g, s) && stays(g, s, side)) return;
    g.standing[lane] = 0;
    g.frequency[lane] = wanted_frequency(g, s, speed_soon(s), off);
    leave(g, s, side, g.frequency[lane]);
}

// How far a foot comes down on its ball: on stairs, off a kerb and up a steep slope.
float lands_on_ball(const GaitBlock& g, Side side, const Stepper& s) {
    int lane = s.lane;
    const FootBlock &foot = g.feet[side], &other = g.feet[1 - side];
    if (g.tread[lane] > 0) return 1;
    FootPlace goal = get_place(foot.goal, lane);
    bool is_down = step_between(get_place(other.to, lane), goal) > -k_drop;  // the body already
    if (!is_down && step_between(get_place(foot.from, lane), goal) < -k_drop) return 1;
    Vec3 n = goal.normal;
    float grade = -(n.x * s.facing.x + n.z * s.facing.z) / std::max(n.y, 0.2f);
    return smoothstep(k_steep_0, k_steep_1, grade);
}

// Seconds in which least_effort (height-inl.h) lets a body down to the landing of a foot if it begins with
// k_effort: the root of (6 by / t - 4 falls) / t = k_effort, all downward. 0: it is there, or runs.
float time_to_come_down(const GaitBlock& g, const FootBlock& foot, const Stepper& s) {
    int lane = s.lane;
    if (g.running[lane] > 0) return 0;
    float by = g.base[lane] - height_on(foot.goal, lane, on_ground(s.root)), falls = -g.base_velocity[lane];
    if (by < k_comes_down) return 0;
    return (std::sqrt(4 * falls * falls + 6 * k_effort * by) - 2 * falls) / k_effort;
}

void advance_feet(GaitBlock& g, const Stepper& s, bool wants_step, bool slow, const Misfit (&off)[2],
                  float slack) {
    int lane = s.lane;
    float duty = g.duty[lane], f = g.frequency[lane], speed = length(s.velocity);
    // A foot is left this far behind by a steady walk or run; farther, the walker is stopping or was pushed.
    float soon = std::min(speed, lerp(speed, length(s.wish), 0.25f));
    float stride = std::max(soon, 0.05f) / f;
    float reach = std::min(k_out_of_reach * s.leg_length, 0.08f + 0.7f * duty * stride);
    // And this far when the other one lands, at most.
    float behind_at_contact = (0.5f - k_lead * k_norm_duty) * stride + k_late;
    const float phases[2] = {g.feet[k_left].phase[lane], g.feet[k_right].phase[lane]};
    // A swing hurries to be down by then.
    auto swing_rate = [&](Side side, float phase) {
        if (g.running[lane] > 0) {
            // Half a cycle from the other foot's contact, and just with a tick.
            float behind = wrap_difference(phases[1 - side] + 0.5f - phases[side]), rest = 1.1f - phase;
            float rate = f * clamp(rest / std::max(rest - behind, 0.02f), k_least_swing, k_hasty_swing);
            float ticks = std::max(std::ceil((1 - phase) / (rate * s.dt) - 0.35f), 1.0f);
            return 1.0001f * (1 - phase) / (ticks * s.dt);
        }
        if (g.feet[1 - side].swinging[lane]) return f;
        float left = std::max(behind_at_contact - off[1 - side].behind, 0.01f);
        return clamp((1 - phase) * speed / left, f, k_hasty_swing * f);
    };
    // The body of one who walks comes to a foot ahead.
    auto left_behind = [&](Side side) {
        return slow || off[side].behind > 0 ? off[side].distance : off[side].aside();
    };
    for (Side side : {k_left, k_right}) {
        FootBlock& foot = g.feet[side];
        float& phase = foot.phase[lane];
        if (foot.swinging[lane]) {
            float forefoot = lands_on_ball(g, side, s);
            approach(foot.forefoot[lane], forefoot, 5 * s.dt);
            float& rate = foot.rate[lane];
            float wanted = swing_rate(side, phase), down = time_to_come_down(g, foot, s);
            if (down > 0) wanted = std::max(std::min(wanted, (1 - phase) / down), k_least_swing * k_slowest);
            approach(rate, wanted, k_quicken * s.dt);
            phase = std::max(phase + rate * s.dt, duty);
            if (phase >= 1) {
                phase = std::min(phase - 1, duty - k_just_below);  // however long the tick
                touch_down(g, s, side);
            } else {
                swing(g, s, side, (1 - phase) / rate, f);
            }
            continue;
        }
        // In time with the other foot, at once where the body has left it behind.
        bool worse = left_behind(side) >= left_behind(static_cast<Side>(1 - side));
        float ahead = wrap_difference(phases[1 - side] + 0.5f - phase);
        float rate = f * (1 + clamp(4 * ahead, -0.7f, 0.7f));
        const bool just_landed =
            phase < phases[1 - side] && phase < k_just_landed && !g.feet[1 - side].swinging[lane];
        if (worse && !just_landed && may_leave(g, s, side)) {
            rate += std::max(left_behind(side) + k_aside * off[side].aside() - reach, 0.0f) *
                    (k_hurry / s.leg_length);
            if (slow && off[side].amount(slack) > 1) rate = std::max(rate, k_close);
            // A child does not linger on the step that it has left.
            bool left_above = g.tread[lane] > 0 && sets_both_feet(s.leg_length) &&
                              foot.to.y[lane] > g.feet[1 - side].to.y[lane] + k_drop;
            if (left_above) rate = std::max(rate, k_close);
        }
        if (wants_step) {
            phase += rate * s.dt;
        } else {
            approach(phase, k_rest, 1.5f * s.dt);
        }
        bool due = phase >= duty && (!slow || off[side].amount(slack) > 0.5f);
        if (wants_step && due && may_leave(g, s, side) && !(slow && stays(g, s, side))) {
            leave(g, s, side, swing_rate(side, duty));
        } else {
            phase = std::min(phase, duty - k_just_below);
            pivot(g, s, side);
        }
    }
    if (!wants_step && !g.feet[k_left].swinging[lane] && !g.feet[k_right].swinging[lane])
        g.standing[lane] = 1;
}

// Pelvis and arms go with the feet, evenly.
void advance_phase(GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    float l = g.feet[k_left].phase[lane], r = g.feet[k_right].phase[lane];
    float both = l + wrap_difference(r - 0.5f - l) * 0.5f;
    float phase = g.phase[lane] + g.frequency[lane] * s.dt;
    float most = (1 + 2 * (1 - g.amplitude[lane])) * s.dt;
    phase += clamp(wrap_difference(both - phase), -most, most);
    g.phase[lane] = wrap_phase(phase);
}

// The share of the body that a foot carries since it landed: all when the other one has left. `phase` is its
// own.
float taken_over(float phase, float duty) {
    return smoothstep(0, std::max((duty - 0.5f) * k_shift_width, 0.02f), phase + k_early);
}

void advance_load(GaitBlock& g, const Stepper& s, RandomKey chance) {
    int lane = s.lane;
    const FootBlock &l = g.feet[k_left], &r = g.feet[k_right];
    float target = 0.5f, rate = lerp(5.0f, 25.0f, g.amplitude[lane]), duty = g.duty[lane];
    if (g.standing[lane]) {
        target = resting_load(g, lane, chance);
        rate = 0.35f;
        if (g.first[lane] >= 0) target = g.first[lane] == k_left ? 0.0f : 1.0f;
        if (g.first[lane] >= 0 && g.restless[lane] < 0) rate = 3.5f;
    } else if (l.swinging[lane] && r.swinging[lane]) {
        // In flight: whichever comes down next.
        target = l.phase[lane] > r.phase[lane] ? 1.0f : 0.0f;
        rate = lerp(6.0f, 25.0f, g.running[lane]);
    } else {
        // The foot that landed last takes over; the body begins to trust one just before it is down.
        bool left = r.swinging[lane] || (!l.swinging[lane] && l.phase[lane] < r.phase[lane]);
        const FootBlock &last = left ? l : r, &other = left ? r : l;
        float share = taken_over(last.phase[lane], duty);
        if (other.swinging[lane]) share -= taken_over(std::min(other.phase[lane] - 1, 0.0f), duty);
        share = lerp(share, 1, g.running[lane]);
        if (g.jump[lane] > 0 && other.swinging[lane]) share = 1;  // the other one is still in flight
        target = left ? share : 1 - share;
    }
    // Who walks hands the body over as the feet do; else it is moved gently, and comes to rest.
    float& load = g.load[lane];
    float shift = g.standing[lane] && g.first[lane] >= 0 && g.restless[lane] < 0 ? k_shift_starting : k_shift;
    float gentle = lerp(shift, k_shift_walking, smoothstep(0.4f, 0.6f, g.amplitude[lane]));
    float rest = target - load,
          most = std::min({rate, std::sqrt(2 * gentle * std::fabs(rest)), std::fabs(rest) / s.dt});
    float was = load;
    approach(g.load_rate[lane], rest > 0 ? most : -most, gentle * s.dt);
    load = clamp(load + g.load_rate[lane] * s.dt, 0, 1);
    g.load_rate[lane] = (load - was) / s.dt;
}

// Heads turn to where the body is about to turn, some 200 ms before it (Grasso et al. 1996): as far ahead of
// the body as that is at the rate of its turns. And now and then to something of interest.
void advance_look(GaitBlock& g, const Stepper& s, RandomKey chance) {
    float coming = s.turn_rate * 0.2f;
    const float off = wrap_angle(heading_of(s.wish) - s.heading);
    // Who goes aside as he turns a pram looks where it turns to.
    if (wishes_to_go(s) && off * s.turn_rate >= 0) coming = off;
    coming = clamp(coming, -k_farthest_look, k_farthest_look);
    float turns = smoothstep(0.03f, 0.25f, std::fabs(coming));
    float& interest = g.interest[s.lane];
    if (s.glances)
        interest =
            random_unit(chance) < s.person.curiosity[s.lane] ? random_between(chance, -0.55f, 0.55f, 1) : 0;
    float& look = g.look[s.lane];
    float change = (coming + interest * (1 - turns) - look) * lerp(3.5f, 9.0f, turns);
    look += clamp(change, -k_fastest_look, k_fastest_look) * s.dt;
}

}  // namespace

void advance_walker(GaitBlock& g, const StepperRows& rows, const Stepper& s, RandomKey chance) {
    int lane = s.lane;
    g.x[lane] = s.root.x;
    g.z[lane] = s.root.z;
    g.heading[lane] = s.heading;
    float speed = length(s.velocity);
    advance_stance(g, s, chance);

    Misfit off[2];
    for (Side side : {k_left, k_right}) {
        off[side] = {rows.distance[side][lane], rows.twist[side][lane], rows.behind[side][lane],
                     rows.unasked[side][lane]};
        if (g.feet[side].swinging[lane] || off[side].distance < k_lost * s.leg_length) continue;
        replant(g, s, side);
        off[side] = misfit(g, s.person, rows, side, lane);
    }
    float slack = g.standing[lane] ? k_slack : k_stopping_slack;
    float worst = std::max(off[k_left].amount(slack), off[k_right].amount(slack));
    bool slow = speed < k_standing_speed;
    if (!slow || worst > 1) g.restless[lane] = -1;
    // Who turns begins to step before legs are wrung.
    float twist = std::max(off[k_left].twist, off[k_right].twist) + std::fabs(s.turn_rate) * k_turn_ahead;
    const std::optional<Side> gathers = slow && g.standing[lane] ? astride(g, s) : std::nullopt;
    if (gathers) g.first[lane] = *gathers, g.restless[lane] = -1;
    bool wants_step = !slow || gathers || worst > 1 || twist > k_home_twist || g.restless[lane] >= 0;
    if (advance_jump(g, s)) {
        // The jump has moved the feet.
    } else if (g.standing[lane]) {
        stand(g, s, wants_step, worst > 2.2f || speed > 0.45f, off, slack);
    } else {
        // Steps stay quick while one slows down.
        float f = wanted_frequency(g, s, speed_soon(s), off);
        approach(g.frequency[lane], f, (f > g.frequency[lane] ? 6 : 2) * s.dt);
        advance_feet(g, s, wants_step, slow, off, slack);
    }
    advance_bearing(g, s, chance);
}

void advance_bearing(GaitBlock& g, const Stepper& s, RandomKey chance) {
    if (!g.standing[s.lane]) advance_phase(g, s);
    advance_load(g, s, chance);
    advance_rest(g, s);
    advance_look(g, s, chance);
}

}  // namespace flaneur
