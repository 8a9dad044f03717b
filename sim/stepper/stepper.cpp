#include "sim/stepper/stepper.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/gait/curves/norms.h"
#include "sim/gait/rows.h"
#include "sim/gait/states.h"
#include "sim/stepper/own.h"

namespace flaneur {

namespace {

constexpr float k_both_least = 0.22f;                 // of a step's time, that both are down at least
constexpr float k_both_reeling = 0.06f;               // seconds, the same of who was pushed
constexpr float k_lead = 0.62f, k_lead_eases = 0.2f;  // legs that the point is ahead of the body at most
constexpr float k_leads_most = 0.8f;                  // the same, wherever it has come to
constexpr float k_hangs = 0.07f;  // legs that it draws the body off the middle of the feet
constexpr float k_follows = 6;    // 1/s, of the body
constexpr float k_speeds_up = 0.9f, k_slows_down = 1.6f;             // m/s2, of the point
constexpr float k_turns = 1.5f, k_turns_in = 6, k_turn_gain = 3.5f;  // rad/s, rad/s2, 1/s
constexpr float k_apart = 0.56f, k_apart_eases = 0.9f;               // metres from who is ahead
constexpr float k_astray = 0.25f,
                k_astray_most = 1;    // metres off its way, from which it comes back; along it
constexpr float k_goes_aside = 0.4f;  // m/s, off its way and back
constexpr float k_brakes = 4;         // m/s2, of who finds no place
constexpr float k_just_below = 1e-4f, k_phase_rate = 4.5f;  // as the gait has them
constexpr float k_lifts_rate = 2, k_heel_down = 0.3f;       // of who stands
constexpr float k_stands_below = 0.07f;                     // m/s
constexpr uint32_t k_look_again = 5;                        // ticks, of one who waits
constexpr float k_astride = 0.33f;                          // legs, between feet of who stands
constexpr float k_careful = 0.02f;                          // metres that feet rise higher
constexpr float k_tread = 0.07f, k_lets_down = 0.07f;       // metres, from which on it is a step

// What moves under its feet takes it along.
void carry(const Own& o) {
    Vec3 by{};
    for (const Side side : {k_left, k_right}) {
        const FootPlaces& was = o.g.feet[side].from;
        const Vec3 moved = o.now(side).place - Vec3{was.x[o.lane], was.y[o.lane], was.z[o.lane]};
        by += moved * (side == k_left ? o.g.load[o.lane] : 1 - o.g.load[o.lane]);
    }
    o.b.body += on_ground(by);
    o.b.point += on_ground(by);
    o.b.along += dot(on_ground(by), o.b.ahead);
    o.g.base[o.lane] += by.y;
}

// Metres to who is ahead on the same way.
float gap_ahead(const Own& o) {
    const Bipeds& all = o.bipeds;
    const float whole = all.ways[o.b.way].along.back();
    float least = std::min(whole, all.room[o.number]);
    constexpr float k_side_by_side = 0.8f;  // metres
    auto middle = [&](size_t i) { return (all.was_feet[3 * i] + all.was_feet[3 * i + 1]) * 0.5f; };
    for (size_t i = 0; i < all.all.size(); ++i) {
        if (i == o.number || all.all[i].way != o.b.way || i == all.orders.driven || all.all[i].is_down)
            continue;
        float ahead = all.was_along[i] - all.was_along[o.number];
        // Of two in one place the first goes on.
        if (ahead == 0 && i > o.number) continue;
        ahead -= whole * std::floor(ahead / whole);
        // Of two side by side, as they may be who come back to the way, whoever's body is in front goes on.
        const Vec2 off = middle(i) - middle(o.number);
        if (length(off) < k_side_by_side && dot(off, o.b.ahead) < 0) continue;
        // From the point to the body ahead.
        const float gap = ahead - all.was_lead[i];
        least = std::min(least, gap);
    }
    return least;
}

// How fast the point would like to go along its way.
float wanted_speed(const Own& o) {
    const Biped& b = o.b;
    const float lead = dot(b.point - b.body, b.ahead);
    const float leads = clamp((k_lead * o.leg - lead) / (k_lead_eases * o.leg), 0, 1);
    const float turned = std::max(dot(o.facing(), b.ahead), 0.0f);
    const float climbs = std::fabs(o.g.rise[o.lane]);
    float speed =
        b.likes * std::sqrt(o.scale()) * turned * turned * (1 - 0.5f * smoothstep(0.08f, 0.4f, climbs));
    // It is slower where a step up or down lies ahead.
    const float high = std::max(b.wanted[0].y, b.wanted[1].y), low = std::min(b.wanted[0].y, b.wanted[1].y);
    const float step = std::max(high - o.g.base[o.lane], o.g.base[o.lane] - low);
    speed *= 1 - 0.4f * smoothstep(0.06f, 0.16f, step);
    if (!o.is_driven()) speed *= clamp((gap_ahead(o) - k_apart) / k_apart_eases, 0, 1);
    return b.waits > 1 ? 0 : speed * leads;
}

void move_point(const Own& o) {
    Biped& b = o.b;
    if (b.reels > 0) {
        b.reels -= k_tick;
        b.speed = 0;
        return;
    }
    // Where a throng shoves the body about, the point stays with it.
    const Vec2 off = b.point - b.body;
    const float far = length(off), leads = k_leads_most * o.leg;
    if (far > leads) b.point = b.body + off * (leads / far);
    const BipedOrders& orders = o.bipeds.orders;
    const BipedWay& way = o.bipeds.ways[b.way];
    float speed = wanted_speed(o);
    if (o.is_driven()) {
        if (orders.has_goal != 0) {
            const Vec2 to = on_ground(orders.goal) - b.point;
            constexpr float k_there = 0.3f, k_nears = 1.2f;
            if (length(to) > k_there) b.ahead = normalize_or(to, b.ahead);
            speed = length(to) > 0.05f ? std::min(speed, k_nears * length(to)) : 0;
        } else {
            b.ahead = normalize_or(orders.wish, b.ahead);
            speed = std::min(speed / std::max(b.likes, 0.1f), 1.0f) * length(orders.wish);
        }
    }
    b.speed +=
        clamp(speed - b.speed, -(b.waits > 1 ? k_brakes : k_slows_down) * k_tick, k_speeds_up * k_tick);
    const float lead = dot(b.point - b.body, b.ahead);
    if (lead > k_lead * o.leg) b.speed = 0;
    if (o.is_driven()) {
        b.point += b.ahead * (b.speed * k_tick);
        b.along = nearest_along(way, b.point);
        return;
    }
    // Who was driven off comes back to the way.
    approach(b.aside, o.bipeds.aside[o.number], k_goes_aside * k_tick);
    auto place_of = [&](const WayPoint& at) { return at.place + Vec2{at.ahead.z, -at.ahead.x} * b.aside; };
    float astray = length(place_of(point_on(way, b.along)) - b.point);
    if (astray > k_astray) {  // by a throng: it goes on from where it is by now
        b.along = nearest_along(way, b.body, b.along, k_astray_most);
        astray = length(place_of(point_on(way, b.along)) - b.point);
    }
    if (astray < k_astray) b.along += b.speed * k_tick;
    WayPoint next = point_on(way, b.along);
    next.place = place_of(next);
    const float most = b.speed * k_tick + 0.004f;
    const Vec2 to = next.place - b.point;
    const bool is_near = length(to) <= most;
    b.ahead = is_near || astray < k_astray ? next.ahead : normalize_or(to, next.ahead);
    b.point = is_near ? next.place : b.point + to * (most / length(to));
}

// Between both feet and the point, one in the air counting where it is over the ground.
void move_body(const Own& o) {
    Biped& b = o.b;
    Vec2 feet{};
    for (const Side side : {k_left, k_right}) {
        Vec2 at = on_ground(o.now(side).place);
        if (b.swings == static_cast<uint32_t>(side))
            at =
                lerp(at, on_ground(in_world(*o.on.ground.movers, b.target).place), smoothstep(0, 1, b.share));
        feet += at * 0.5f;
    }
    Vec2 hangs = (b.point - feet) / 3;
    const float far = length(hangs), most = k_hangs * o.leg;
    if (far > most) hangs = hangs * (most / far);
    const Vec2 target = feet + hangs, goes = b.ahead * b.speed;
    const Vec2 push = (target - b.body) * (k_follows * k_follows) + (goes - b.velocity) * (2 * k_follows);
    b.velocity += push * k_tick;
    b.body += b.velocity * k_tick;
    const float turn = b.reels > 0 ? 0 : wrap_angle(heading_of(b.ahead) - b.heading);
    const float rate = clamp(turn * k_turn_gain, -k_turns, k_turns);
    b.turn_rate += clamp(rate - b.turn_rate, -k_turns_in * k_tick, k_turns_in * k_tick);
    b.heading = wrap_angle(b.heading + b.turn_rate * k_tick);
}

void approach_phase(const Own& o, Side side, float target, float rate) {
    approach(o.g.feet[side].phase[o.lane], target, rate * k_tick);
}

// How it comes down, and how it passes what lies between.
void shape_swing(const Own& o, Side side, const Foothold& to) {
    FootBlock& foot = o.g.feet[side];
    const Foothold from = o.now(side), stands = o.now(o.other(side));
    FootPlace a{from.place, from.yaw, from.normal}, b{to.place, to.yaw, to.normal};
    b.yaw = a.yaw + wrap_angle(b.yaw - a.yaw);
    const Clearing clearing =
        clear_ground(o.on.around, a, b, foot_size(o.p, o.lane), 0, o.g.pace[o.lane], sets_both_feet(o.leg));
    foot.obstacle[o.lane] = std::min(clearing.obstacle + k_careful * o.scale(), 0.35f);
    foot.edge[o.lane] = clearing.edge;
    foot.round[o.lane] = foot.goal_round[o.lane] = 0;
    const float rise = to.place.y - stands.place.y, drop = from.place.y - to.place.y;
    const bool is_tread = std::fabs(rise) > k_tread;
    o.g.tread[o.lane] = is_tread ? std::max(length(on_ground(to.place - stands.place)), 0.2f) : 0;
    foot.forefoot[o.lane] = is_tread || drop > k_lets_down ? 1.0f : 0.0f;
}

void set_off(const Own& o, Side side, const Foothold& hold) {
    Biped& b = o.b;
    const Foothold to = in_world(*o.on.ground.movers, hold);
    b.waits = 0;
    b.kept = 0;
    b.target = hold;
    b.swings = static_cast<uint32_t>(side);
    b.share = 0;
    b.lasts = seconds_of(o, b.speed, to.place.y - o.now(side).place.y);
    shape_swing(o, side, to);
}

bool lift_off(const Own& o, Side side) {
    Biped& b = o.b;
    if (b.waits % k_look_again != 0) {
        ++b.waits;
        return false;
    }
    const Vec2 now = beside(o, b.point, side);
    float seconds = seconds_of(o, b.speed, 0);
    const Vec2 then = now + b.ahead * (b.speed * seconds);
    const auto hold = foothold_near(o.on, seeker(o, side), then, yaw_of(o, side, seconds));
    if (!hold) {
        ++b.waits;
        return false;
    }
    set_off(o, side, *hold);
    return true;
}

void touch_down(const Own& o, Side side) {
    Biped& b = o.b;
    b.feet[side] = b.target;
    b.swings = k_both_down;
    b.due = 0;
    FootBlock& foot = o.g.feet[side];
    foot.phase[o.lane] = 0;
    foot.obstacle[o.lane] = 0;
}

// Shares of its step a second: it waits for a body that is still to come down.
float swing_rate(const Own& o) {
    const Biped& b = o.b;
    constexpr float k_comes_down = 0.025f, k_effort = 5, k_least = 0.25f;  // metres, m/s2, of the usual rate
    const Foothold to = in_world(*o.on.ground.movers, b.target);
    const float by = o.g.base[o.lane] - to.place.y, falls = -o.g.base_velocity[o.lane];
    // It does not come down where the body cannot be yet: legs, from the body to where it lands.
    constexpr float k_reaches = 0.47f, k_beyond = 0.1f, k_comes_near = 0.6f;  // and of the step
    const float far = length(on_ground(to.place) - b.body) / o.leg;
    const float waits = smoothstep(k_comes_near, 0.9f, b.share) * clamp((far - k_reaches) / k_beyond, 0, 1);
    const float usual = lerp(1, k_least, waits) / b.lasts;
    if (by < k_comes_down) return usual;
    const float seconds = (std::sqrt(4 * falls * falls + 6 * k_effort * by) - 2 * falls) / k_effort;
    return clamp((1 - b.share) / std::max(seconds, 0.02f), k_least * usual, usual);
}

void swing(const Own& o, Side side) {
    Biped& b = o.b;
    const float duty = o.g.duty[o.lane];
    b.share = std::min(b.share + swing_rate(o) * k_tick, 1.0f);
    o.g.feet[side].rate[o.lane] = (1 - duty) / b.lasts;
    if (b.share >= 1) {
        touch_down(o, side);
        const Side last = o.other(side);
        const float apart = off(o, last, beside(o, b.point, last));
        b.apart = std::min(apart, 0.9f * b.reach);
        return;
    }
    o.g.feet[side].phase[o.lane] = duty + (1 - duty) * b.share;
    approach_phase(o, o.other(side), duty - 0.5f + (1 - duty) * b.share, k_phase_rate);
}

// Whether what both feet stand on parts: then the one behind is fetched to the other.
bool parts(const Own& o) {
    const Biped& b = o.b;
    return b.feet[k_left].mover != b.feet[k_right].mover &&
           are_parting(o.on, b.feet[k_left], b.feet[k_right], o.leg);
}

Side behind(const Own& o) {
    const Vec2 left = on_ground(o.now(k_left).place), right = on_ground(o.now(k_right).place);
    return dot(left - right, o.b.ahead) < 0 ? k_left : k_right;
}

// To the other foot, or nearer to it.
bool fetch(const Own& o, Side side) {
    constexpr float k_nearer = 0.05f;  // metres
    const Side other = o.other(side);
    Seeker who = seeker(o, side);
    who.gathers = true;
    const Vec2 facing = o.facing(), beside_it = Vec2{facing.z, -facing.x} * outward(side);
    const Vec2 place =
        on_ground(o.now(other).place) + beside_it * (o.bipeds.is_flat ? 0 : o.p.step_width[o.lane]);
    const auto hold = foothold_near(o.on, who, place, yaw_of(o, side, 0));
    if (!hold) return false;
    const Vec2 stands = on_ground(o.now(other).place);
    const float comes = length(on_ground(in_world(*o.on.ground.movers, *hold).place) - stands);
    if (comes > length(on_ground(o.now(side).place) - stands) - k_nearer) return false;
    set_off(o, side, *hold);
    return true;
}

// The document's rule, while both are down.
void check_range(const Own& o) {
    Biped& b = o.b;
    GaitBlock& g = o.g;
    const int lane = o.lane;
    if (parts(o)) {
        const Side side = behind(o);
        approach_phase(o, side, g.duty[lane] - k_just_below, k_lifts_rate);
        if (g.feet[side].phase[lane] < g.duty[lane] - 2 * k_just_below) return;
        if (fetch(o, side)) {
            g.standing[lane] = 0;
            g.first[lane] = -1;
            return;
        }
    }
    float away[2];
    for (const Side side : {k_left, k_right}) away[side] = off(o, side, beside(o, b.point, side));
    // The one that stood longer where neither is clearly farther.
    constexpr float k_clearly = 0.03f;
    const bool left_stood = g.feet[k_left].phase[lane] >= g.feet[k_right].phase[lane];
    const float bias = g.standing[lane] ? 0 : left_stood ? k_clearly : -k_clearly;
    Side side = away[k_left] + bias >= away[k_right] ? k_left : k_right;
    // Who stands and finds no place for that one tries the other.
    if (g.standing[lane] && b.waits / k_look_again % 2 == 1) side = o.other(side);
    const float duty = g.duty[lane];
    const bool is_out = away[side] > b.reach && b.waits < 2 * k_look_again;
    const bool rests = b.speed < k_stands_below && length(b.velocity) < 2 * k_stands_below;
    if (!is_out && rests) g.standing[lane] = 1;
    // Who found no place looks again after a while.
    auto rest = [&] { b.waits = away[side] <= b.reach || b.waits + 1 >= 4 * k_look_again ? 0 : b.waits + 1; };
    if (g.standing[lane]) {
        g.first[lane] = is_out ? static_cast<int32_t>(side) : -1;
        for (const Side each : {k_left, k_right})
            approach_phase(o, each, is_out && each == side ? duty - k_just_below : k_rest,
                           is_out && each == side ? k_lifts_rate : 1.5f);
        if (!is_out) return rest();
        const float carried = side == k_left ? g.load[lane] : 1 - g.load[lane];
        if (carried > 0.2f || g.feet[side].phase[lane] < duty - 2 * k_just_below) return;
        // The other one's heel is down.
        if (g.feet[o.other(side)].phase[lane] > duty - k_heel_down) return;
        if (!lift_off(o, side)) return;
        g.standing[lane] = 0;
        g.first[lane] = -1;
        return;
    }
    g.first[lane] = -1;
    const float share = clamp((away[side] - b.apart) / std::max(b.reach - b.apart, 0.02f), 0, 1);
    const float most = k_tick / (b.reels > 0 ? k_both_reeling : k_both_least * b.lasts);
    b.due = std::min(b.due + most, std::max(share, b.due));
    approach_phase(o, side, std::min(lerp(0.5f, duty, b.due), duty - k_just_below), k_phase_rate);
    approach_phase(o, o.other(side), lerp(0, duty - 0.5f, b.due), k_phase_rate);
    if (!is_out) return rest();
    if (b.due < 1 || g.feet[side].phase[lane] < duty - 2 * k_just_below || lift_off(o, side)) return;
    // Who finds no place ahead sets the foot beside the other, or else that one beside it, and stands.
    const float astride = length(on_ground(o.now(k_left).place - o.now(k_right).place));
    if (astride <= k_astride * o.leg) return;
    const Side last = b.waits / k_look_again % 2 == 0 ? behind(o) : o.other(behind(o));
    approach_phase(o, last, duty - k_just_below, k_phase_rate + k_lifts_rate);  // against what is above
    if (g.feet[last].phase[lane] >= duty - 2 * k_just_below && b.waits % k_look_again == 1) fetch(o, last);
}

void step_feet(const Own& o) {
    Biped& b = o.b;
    b.reach = reach_of(o, b.speed);
    look_for_places(o);
    if (b.waits > 0) b.kept += k_tick;
    if (b.swings == k_both_down)
        check_range(o);
    else
        swing(o, static_cast<Side>(b.swings));
    write_feet(o);
}

// The head turns to what is looked at, as far as necks do.
void turn_gaze(const Own& o) {
    constexpr float k_most_yaw = 1.25f, k_most_down = 0.7f, k_most_up = 0.6f, k_behind = 2.2f;  // radians
    constexpr float k_stiff = 7;                                                                // 1/s
    Vec2 wanted{};
    const BipedOrders& orders = o.bipeds.orders;
    if (orders.looks != 0) {
        const Vec3 eyes{o.b.body.x, o.g.base[o.lane] + 0.94f * o.p.height[o.lane], o.b.body.z};
        const Vec3 to = orders.looked_at - eyes;
        const float yaw = wrap_angle(heading_of(on_ground(to)) - o.b.heading);
        const float up = arctan2(to.y, length(on_ground(to)));
        if (std::fabs(yaw) < k_behind && length(to) > 0.3f)
            wanted = {clamp(yaw, -k_most_yaw, k_most_yaw), clamp(up, -k_most_down, k_most_up)};
    }
    const Vec2 push = (wanted - o.b.gaze) * (k_stiff * k_stiff) - o.b.gaze_rate * (2 * k_stiff);
    o.b.gaze_rate += push * k_tick;
    o.b.gaze += o.b.gaze_rate * k_tick;
}

Stepper stepper_of(const Own& o, uint64_t seed, uint32_t tick) {
    return {.person = o.p,
            .lane = o.lane,
            .around = o.on.around,
            .root = at_height(o.b.body, o.g.base[o.lane]),
            .velocity = o.b.velocity,
            .wish = o.b.ahead * o.b.speed,
            .heading = o.b.heading,
            .turn_rate = o.b.turn_rate,
            .facing = o.facing(),
            .leg_length = o.leg,
            .dt = k_tick,
            .chance = {seed, static_cast<uint32_t>(o.number), tick, Purpose::step}};
}

void fill_rows(const Own& o, StepperRows& rows) {
    const auto lane = static_cast<size_t>(o.lane);
    const Vec2 wish = o.b.ahead * o.b.speed;
    rows.moves[lane] = 1;
    rows.x[lane] = o.b.body.x, rows.z[lane] = o.b.body.z;
    // Of the point: the body hastens and tarries with each step.
    rows.velocity_x[lane] = wish.x, rows.velocity_z[lane] = wish.z;
    rows.wish_x[lane] = wish.x, rows.wish_z[lane] = wish.z;
    rows.heading[lane] = o.b.heading, rows.turn_rate[lane] = o.b.turn_rate;
    set_feet(rows, o.g, o.lane);
}

void step_block(Bipeds& bipeds, const StandingOn& on, Gait& gait, size_t first, size_t last, uint64_t seed,
                uint32_t tick) {
    const size_t block = bipeds.walkers[first] / k_block;
    GaitBlock& g = gait.blocks[block];
    const PersonBlock& p = gait.people[block];
    StepperRows rows{};
    for (size_t i = first; i < last; ++i) {
        if (bipeds.all[i].is_down != 0) continue;
        const Own o = own_of(bipeds, i, gait, on);
        carry(o);
        move_point(o);
        move_body(o);
        g.x[o.lane] = o.b.body.x, g.z[o.lane] = o.b.body.z;
        g.heading[o.lane] = o.b.heading;
        const float cycles = o.b.speed / std::max(2 * step_of(o, o.b.speed), 0.1f);
        approach(g.frequency[o.lane], clamp(cycles, 0.55f, 1.3f), 2 * k_tick);
        write_feet(o);
        fill_rows(o, rows);
    }
    find_misfits(g, p, rows);
    advance_paces(g, p, rows, k_tick);
    for (size_t i = first; i < last; ++i) {
        if (bipeds.all[i].is_down != 0) continue;
        const Own o = own_of(bipeds, i, gait, on);
        step_feet(o);
        hold_rails(o);
        turn_gaze(o);
        g.interest[o.lane] = 0;
        const RandomKey look{seed, static_cast<uint32_t>(i), tick / 240, Purpose::look};
        advance_bearing(g, stepper_of(o, seed, tick), look);
        set_feet(rows, g, o.lane);
    }
    advance_heights(g, p, rows, k_tick);
}

}  // namespace

float off_wanted(const Bipeds& bipeds, const Gait& gait, size_t biped, Side side) {
    const Biped& b = bipeds.all[biped];
    const uint32_t walker = bipeds.walkers[biped];
    const FootPlaces& at = gait.blocks[walker / k_block].feet[side].from;
    const size_t lane = walker % k_block;
    return length(on_ground(b.wanted[side]) - Vec2{at.x[lane], at.z[lane]});
}

void step_bipeds(Bipeds& bipeds, const MovingGround& ground, Gait& gait, Workers& workers, uint64_t seed,
                 uint32_t tick) {
    const size_t count = bipeds.all.size();
    for (size_t i = 0; i < count; ++i) {
        const Biped& b = bipeds.all[i];
        bipeds.was_along[i] = b.along;
        bipeds.was_lead[i] = dot(b.point - b.body, b.ahead);
        const Movers& movers = *ground.movers;
        for (const Side side : {k_left, k_right})
            bipeds.was_feet[3 * i + side] = on_ground(in_world(movers, b.feet[side]).place);
        bipeds.was_feet[3 * i + 2] =
            b.swings == k_both_down ? bipeds.was_feet[3 * i] : on_ground(in_world(movers, b.target).place);
    }
    const Surroundings around = surroundings_of(ground);
    const StandingOn on{ground, around, tick + 1};
    const size_t blocks = count == 0 ? 0 : bipeds.walkers.back() / k_block + 1;
    parallel_for(workers, blocks, 1, [&](size_t begin, size_t end, int) {
        for (size_t block = begin; block < end; ++block) {
            auto first = [&](size_t walker) {
                return static_cast<size_t>(std::ranges::lower_bound(bipeds.walkers, walker) -
                                           bipeds.walkers.begin());
            };
            const size_t from = first(block * k_block), to = first((block + 1) * k_block);
            if (from < to) step_block(bipeds, on, gait, from, to, seed, tick);
        }
    });
}

}  // namespace flaneur
