#include "sim/stepper/own.h"

#include <algorithm>
#include <cmath>

#include "sim/gait/steps.h"

namespace flaneur {

namespace {

// The reach of a foot: of one whose point rests, legs; of one that goes, steps, the rest of a step being what
// the point goes while both are down.
constexpr float k_reach_still = 0.17f, k_reach_steps = 1.08f;
constexpr float k_quickest = 0.4f, k_slowest_step = 0.66f;  // seconds of a step, of a leg of 0.9 m
// Who is crowded in steps anywhere, at last between feet of others: seconds, metres.
constexpr float k_crowded = 3, k_squeezed = 0.1f;
constexpr float k_higher = 0.9f,
                k_farther = 0.25f;  // seconds more for each metre up or down, and of it at most

// Whoever was shoved steps wherever the point is.
bool is_led_back(const Own& o) {
    constexpr float k_behind = 0.15f;  // metres
    return o.b.reels > 0 || dot(o.b.point - o.b.body, o.b.ahead) < -k_behind;
}

}  // namespace

Own own_of(Bipeds& bipeds, size_t i, Gait& gait, const StandingOn& on) {
    const uint32_t walker = bipeds.walkers[i];
    const PersonBlock& p = gait.people[walker / k_block];
    const int lane = static_cast<int>(walker % k_block);
    return {bipeds, bipeds.all[i], i,  gait.blocks[walker / k_block],
            p,      lane,          on, p.joints[left_upper_leg][1][lane]};
}

float step_of(const Own& o, float speed) {
    return 0.5f * stride_length(std::max(speed, 0.05f), o.leg) * o.p.stride[o.lane];
}
float reach_of(const Own& o, float speed) {
    const float goes = smoothstep(0.04f, 0.35f, speed);
    return lerp(k_reach_still * o.leg, k_reach_steps * step_of(o, speed), goes);
}
float seconds_of(const Own& o, float speed, float rise) {
    const float slow = std::sqrt(o.scale());
    const float flat =
        clamp(0.8f * step_of(o, speed) / std::max(speed, 0.1f), k_quickest * slow, k_slowest_step * slow);
    return flat + std::min(k_higher * std::fabs(rise), k_farther);
}

Vec2 beside(const Own& o, Vec2 point, Side side) {
    const Vec2 facing = o.facing(), left{facing.z, -facing.x};
    const float width = o.bipeds.is_flat ? 0 : 0.5f * o.p.step_width[o.lane];
    return point + left * (outward(side) * width);
}
float yaw_of(const Own& o, Side side, float seconds) {
    const float out = o.bipeds.is_flat ? 0 : o.p.toe_out[o.lane];
    return wrap_angle(o.b.heading + o.b.turn_rate * 0.5f * seconds + outward(side) * out);
}

float off(const Own& o, Side side, Vec2 place) {
    const Foothold at = o.now(side);
    const float ball = foot_size(o.p, o.lane).ball;
    const Vec2 here = on_ground(at.place), ahead = heading_direction(at.yaw),
               wanted = heading_direction(yaw_of(o, side, 0));
    auto far = [&](Vec2 way) {
        return length(is_led_back(o) ? way : way - o.b.ahead * std::min(dot(way, o.b.ahead), 0.0f));
    };
    return std::max(far(place - here), far(place + wanted * ball - here - ahead * ball));
}

void write_feet(const Own& o) {
    const Movers& movers = *o.on.ground.movers;
    for (const Side side : {k_left, k_right}) {
        FootBlock& foot = o.g.feet[side];
        const Foothold from = o.now(side);
        Foothold to = from;
        if (o.b.swings == static_cast<uint32_t>(side)) {
            to = in_world(movers, o.b.target);
            to.yaw = from.yaw + wrap_angle(to.yaw - from.yaw);
        }
        set_place(foot.from, o.lane, {from.place, from.yaw, from.normal});
        for (FootPlaces* places : {&foot.to, &foot.goal})
            set_place(*places, o.lane, {to.place, to.yaw, to.normal});
        foot.wished_x[o.lane] = to.place.x, foot.wished_z[o.lane] = to.place.z;
        foot.wished_yaw[o.lane] = to.yaw;
        foot.swinging[o.lane] = o.b.swings == static_cast<uint32_t>(side);
    }
}

Seeker seeker(const Own& o, Side side) {
    Seeker who;
    who.side = side;
    who.leg = o.leg;
    who.size = foot_size(o.p, o.lane);
    who.ahead = o.b.ahead;
    who.facing = o.facing();
    who.at = o.now(side);
    who.other = o.b.feet[o.other(side)];
    who.other_now = o.now(o.other(side));
    who.is_flat = o.bipeds.is_flat;
    who.others = o.bipeds.was_feet;
    who.own = o.number;
    who.gathers = is_led_back(o) || o.b.kept > k_crowded;
    who.apart = lerp(who.apart, k_squeezed, smoothstep(k_crowded, 2 * k_crowded, o.b.kept));
    return who;
}

void look_for_places(const Own& o) {
    for (const Side side : {k_left, k_right}) {
        const Vec2 at = beside(o, o.b.point, side);
        const float height = o.now(o.other(side)).place.y;
        const auto met = ray_down(o.on, at, height, o.leg);
        o.b.meets[side] = met.has_value();
        o.b.wanted[side] = met.value_or(at_height(at, o.g.base[o.lane]));
    }
}

}  // namespace flaneur
